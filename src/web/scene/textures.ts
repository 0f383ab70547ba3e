// Textures that hold numbers of points, blocks and motions, fetched by their index.
import * as THREE from 'three';
import type { Motion } from '../motion';
import type { Surface } from './surface';
import { rowLength } from './shaders';

type Numbers = Float32Array | Int16Array;

/// A texture with room for `count` texels.
export function numberTexture<T extends Numbers>(make: (length: number) => T, channels: 1 | 4, count: number): THREE.DataTexture {
  const rows = Math.max(1, Math.ceil(count / rowLength));
  const data = make(channels * rows * rowLength);
  const whole = data instanceof Int16Array;
  const format = whole ? THREE.RGBAIntegerFormat : channels === 1 ? THREE.RedFormat : THREE.RGBAFormat;
  const texture = new THREE.DataTexture(data, rowLength, rows, format, whole ? THREE.ShortType : THREE.FloatType);
  texture.internalFormat = whole ? 'RGBA16I' : channels === 1 ? 'R32F' : 'RGBA32F';
  texture.minFilter = texture.magFilter = THREE.NearestFilter;
  texture.generateMipmaps = false;
  texture.unpackAlignment = 1;
  texture.needsUpdate = true;
  return texture;
}

export function floats(texture: THREE.DataTexture): Float32Array {
  return texture.image.data as unknown as Float32Array;
}

export function pointTexture(surface: Surface): THREE.DataTexture {
  const texture = numberTexture((n) => new Float32Array(n), 4, surface.blockOfPoint.length);
  const data = floats(texture);
  for (let p = 0; p < surface.blockOfPoint.length; ++p) {
    for (let d = 0; d < 3; ++d) data[4 * p + d] = surface.point[3 * p + d]!;
    data[4 * p + 3] = surface.blockOfPoint[p]!;
  }
  return texture;
}

/// The motion of one state, as the shader reads it; filled anew when another state is shown.
export class MotionTexture {
  readonly texture: THREE.DataTexture;
  state = -1;

  constructor(private readonly motion: Motion, private readonly surface: Surface) {
    this.texture = motion.pointMotion
      ? numberTexture((n) => new Int16Array(n), 4, surface.blockOfPoint.length)
      : numberTexture((n) => new Float32Array(n), 4, 3 * surface.blockId.length);
  }

  show(state: number): void {
    if (state === this.state) return;
    this.state = state;
    const { pointMotion, blockMotion } = this.motion;
    if (pointMotion) {
      const data = this.texture.image.data as unknown as Int16Array;
      const points = this.surface.blockOfPoint.length;
      for (let d = 0; d < 3; ++d)
        for (let p = 0, i = (3 * state + d) * points; p < points; ++p, ++i) data[4 * p + d] = pointMotion[i]!;
    } else if (blockMotion) {
      const length = 12 * this.surface.blockId.length;
      floats(this.texture).set(blockMotion.subarray(state * length, (state + 1) * length));
    }
    this.texture.needsUpdate = true;
  }
}
