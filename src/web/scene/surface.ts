// The surfaces of the blocks as one list of triangles.
import type { Arrays } from '../data';

/// N blocks with P points and T triangles, in the order of the blocks. Coordinates are relative to the model's middle.
export interface Surface {
  blockId: Uint32Array; // [N] as in reports, from 1, ascending
  pointBegin: Uint32Array; // [N+1]
  point: Float32Array; // [P][3] m
  blockOfPoint: Uint32Array; // [P] 0 … N-1
  triangleBegin: Uint32Array; // [N+1]
  corner: Uint32Array; // [T][3] point · 8 + which sides of the triangle are edges: 1 first, 2 second, 4 third
  origin: Uint16Array; // [T] into PageDocument.origins
  low: [number, number, number];
  high: [number, number, number];
}

export function sums(counts: ArrayLike<number>): Uint32Array {
  const begin = new Uint32Array(counts.length + 1);
  for (let i = 0; i < counts.length; ++i) begin[i + 1] = begin[i]! + counts[i]!;
  return begin;
}

export function readSurface(arrays: Arrays): Surface {
  const pointBegin = sums(arrays.get('point_count'));
  const polygonBegin = sums(arrays.get('polygon_count'));
  const point = arrays.get('point_xyz') as Float32Array;
  const corners = arrays.get('corner_count');
  const blocks = pointBegin.length - 1;
  let triangles = 0;
  for (let q = 0; q < corners.length; ++q) triangles += corners[q]! - 2;
  const surface: Surface = {
    blockId: arrays.get('block_id') as Uint32Array,
    pointBegin,
    point,
    blockOfPoint: new Uint32Array(point.length / 3),
    triangleBegin: new Uint32Array(blocks + 1),
    corner: new Uint32Array(3 * triangles),
    origin: new Uint16Array(triangles),
    low: [Infinity, Infinity, Infinity],
    high: [-Infinity, -Infinity, -Infinity],
  };
  for (let b = 0; b < blocks; ++b) surface.blockOfPoint.fill(b, pointBegin[b], pointBegin[b + 1]);
  for (let i = 0; i < point.length; ++i) {
    const d = i % 3;
    surface.low[d] = Math.min(surface.low[d]!, point[i]!);
    surface.high[d] = Math.max(surface.high[d]!, point[i]!);
  }
  fan(surface, arrays, polygonBegin, corners);
  return surface;
}

/// Convex polygons become fans about their first corner; the diagonals are no edges.
function fan(s: Surface, arrays: Arrays, polygonBegin: Uint32Array, corners: ArrayLike<number>): void {
  const cornerPoint = arrays.get('corner_point');
  const cornerEdge = arrays.get('corner_edge');
  const polygonOrigin = arrays.get('polygon_origin');
  let c = 0;
  let t = 0;
  for (let b = 0; b + 1 < polygonBegin.length; ++b) {
    const base = s.pointBegin[b]!;
    for (let q = polygonBegin[b]!; q < polygonBegin[b + 1]!; ++q) {
      const n = corners[q]!;
      for (let i = 1; i + 1 < n; ++i, ++t) {
        const first = i === 1 ? cornerEdge[c]! : 0;
        const last = i === n - 2 ? cornerEdge[c + n - 1]! : 0;
        const sides = first + 2 * cornerEdge[c + i]! + 4 * last;
        s.corner[3 * t] = (base + cornerPoint[c]!) * 8 + sides;
        s.corner[3 * t + 1] = (base + cornerPoint[c + i]!) * 8 + sides;
        s.corner[3 * t + 2] = (base + cornerPoint[c + i + 1]!) * 8 + sides;
        s.origin[t] = polygonOrigin[q]!;
      }
      c += n;
    }
    s.triangleBegin[b + 1] = t;
  }
}

/// Half the diagonal of the box around the model, m.
export function radius(s: Surface): number {
  return 0.5 * Math.hypot(s.high[0] - s.low[0], s.high[1] - s.low[1], s.high[2] - s.low[2]) || 1;
}

/// Area vector of a triangle: its normal times twice its area.
export function areaVector(s: Surface, t: number, out: number[]): void {
  const p = s.point;
  const a = 3 * (s.corner[3 * t]! >>> 3);
  const b = 3 * (s.corner[3 * t + 1]! >>> 3);
  const c = 3 * (s.corner[3 * t + 2]! >>> 3);
  const ux = p[b]! - p[a]!, uy = p[b + 1]! - p[a + 1]!, uz = p[b + 2]! - p[a + 2]!;
  const vx = p[c]! - p[a]!, vy = p[c + 1]! - p[a + 1]!, vz = p[c + 2]! - p[a + 2]!;
  out[0] = uy * vz - uz * vy;
  out[1] = uz * vx - ux * vz;
  out[2] = ux * vy - uy * vx;
}

/// [N] m: the sides of each block's triangles that are edges.
export function edgeLengths(s: Surface): Float32Array {
  const sum = new Float32Array(s.blockId.length);
  const p = s.point;
  for (let i = 0; i < s.corner.length; ++i) {
    if (!((s.corner[i]! >>> (i % 3)) & 1)) continue;
    const a = 3 * (s.corner[i]! >>> 3);
    const b = 3 * (s.corner[i % 3 === 2 ? i - 2 : i + 1]! >>> 3);
    const block = s.blockOfPoint[a / 3]!;
    sum[block] = sum[block]! + Math.hypot(p[b]! - p[a]!, p[b + 1]! - p[a + 1]!, p[b + 2]! - p[a + 2]!);
  }
  return sum;
}
