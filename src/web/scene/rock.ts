// The grain of rock: a tileable picture of noise, made once.
import * as THREE from 'three';

/// A whole number of 32 bits from three, evenly spread (integer hash after C. Wellons' lowbias32).
function hash(x: number, y: number, seed: number): number {
  let h = Math.imul(x, 0x1f123bb5) ^ Math.imul(y, 0x5bd1e995) ^ Math.imul(seed, 0x2545f491);
  h = Math.imul(h ^ (h >>> 16), 0x7feb352d);
  h = Math.imul(h ^ (h >>> 15), 0x846ca68b);
  return ((h ^ (h >>> 16)) >>> 0) / 4294967296;
}

/// Smooth noise on a grid of `cells` × `cells` that repeats.
function noise(u: number, v: number, cells: number, seed: number): number {
  const x = u * cells;
  const y = v * cells;
  const i = Math.floor(x);
  const j = Math.floor(y);
  const sx = (x - i) ** 2 * (3 - 2 * (x - i));
  const sy = (y - j) ** 2 * (3 - 2 * (y - j));
  const at = (a: number, b: number): number => hash((i + a) % cells, (j + b) % cells, seed);
  const low = at(0, 0) + sx * (at(1, 0) - at(0, 0));
  const high = at(0, 1) + sx * (at(1, 1) - at(0, 1));
  return low + sy * (high - low);
}

/// [size][size] 0 … 255 about 128: five octaves, with dark specks as of mica.
export function rockGrain(size: number): Uint8Array {
  const out = new Uint8Array(size * size);
  for (let y = 0; y < size; ++y)
    for (let x = 0; x < size; ++x) {
      let sum = 0;
      let weight = 0;
      for (let octave = 0; octave < 5; ++octave) {
        const w = 0.62 ** octave;
        sum += w * noise(x / size, y / size, 4 << octave, octave);
        weight += w;
      }
      const speck = noise(x / size, y / size, 64, 9) > 0.86 ? -0.16 : 0;
      out[y * size + x] = Math.round(255 * Math.min(1, Math.max(0, 0.5 + 1.7 * (sum / weight - 0.5) + speck)));
    }
  return out;
}

export function rockTexture(): THREE.DataTexture {
  const size = 256;
  const texture = new THREE.DataTexture(rockGrain(size), size, size, THREE.RedFormat, THREE.UnsignedByteType);
  texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
  texture.minFilter = THREE.LinearMipmapLinearFilter;
  texture.magFilter = THREE.LinearFilter;
  texture.generateMipmaps = true;
  texture.anisotropy = 4;
  texture.needsUpdate = true;
  return texture;
}
