// Where planes cut the blocks: the outlines that are drawn on the caps.
import type { Surface } from './surface';

/// n · x = d, with what lies beyond (n · x > d) cut away.
export interface ClipPlane {
  normal: [number, number, number];
  distance: number;
}

/// Segments [..][2][3] in which the plane meets the triangles of blocks that `drawn` holds, counter-clockwise about the block
/// as seen from what is cut away. `position` [P][3] is where the points are now.
export function sectionLines(surface: Surface, position: Float32Array, plane: ClipPlane, drawn: (block: number) => boolean): Float32Array {
  const [nx, ny, nz] = plane.normal;
  const height = new Float32Array(position.length / 3);
  for (let p = 0, i = 0; p < height.length; ++p, i += 3)
    height[p] = nx * position[i]! + ny * position[i + 1]! + nz * position[i + 2]! - plane.distance;
  const out: number[] = [];
  const ends = [0, 0, 0, 0, 0, 0];
  for (let b = 0; b + 1 < surface.triangleBegin.length; ++b) {
    if (!drawn(b)) continue;
    for (let t = 3 * surface.triangleBegin[b]!; t < 3 * surface.triangleBegin[b + 1]!; t += 3) {
      let met = false;
      for (let c = 0; c < 3; ++c) {
        const p = surface.corner[t + c]! >>> 3;
        const q = surface.corner[t + ((c + 1) % 3)]! >>> 3;
        const hp = height[p]!;
        const hq = height[q]!;
        if (hp > 0 === hq > 0) continue;
        const share = hp / (hp - hq);
        for (let d = 0; d < 3; ++d)
          ends[(hp > 0 ? 0 : 3) + d] = position[3 * p + d]! + share * (position[3 * q + d]! - position[3 * p + d]!);
        met = true;
      }
      if (met) out.push(...ends);
    }
  }
  return Float32Array.from(out);
}
