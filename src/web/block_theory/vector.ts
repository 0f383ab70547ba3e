// 3-vectors, with the operations in the order of src/base/vector.hpp: then sums round alike.
export type Vec3 = readonly [number, number, number];

export const zero: Vec3 = [0, 0, 0];

export function add(a: Vec3, b: Vec3): Vec3 {
  return [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
}
export function sub(a: Vec3, b: Vec3): Vec3 {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}
export function scale(s: number, a: Vec3): Vec3 {
  return [s * a[0], s * a[1], s * a[2]];
}
export function dot(a: Vec3, b: Vec3): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
export function cross(a: Vec3, b: Vec3): Vec3 {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}
export function norm(a: Vec3): number {
  return Math.sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}
export function normalized(a: Vec3): Vec3 {
  return scale(1 / norm(a), a);
}
/// v/|v|, divided: exactly an axis where v is along one; nothing of nothing.
export function unit(a: Vec3): Vec3 {
  const length = norm(a);
  return length > 0 ? [a[0] / length, a[1] / length, a[2] / length] : a;
}
/// −0 as 0.
export function withoutNegativeZero(a: Vec3): Vec3 {
  return [a[0] + 0, a[1] + 0, a[2] + 0];
}

/// Two directions closer than this (radians) are one, as in host/keyblock/motions/pyramid.hpp.
export const directionTolerance = 1e-9;

/// b with b·n = 1, b·m = 0 in the plane of n and m: N = r·b is the normal force on the plane of n, of two.
export function reciprocalNormal(n: Vec3, m: Vec3): Vec3 {
  const line = cross(n, m);
  return scale(1 / dot(line, line), cross(m, line));
}
