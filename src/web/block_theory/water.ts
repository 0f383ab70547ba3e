// Water on faces: host/keyblock/water and the integrals of host/keyblock/face_shape.cpp again.
import { add, cross, dot, norm, scale, sub, type Vec3 } from './vector';

/// A [[water]] of the model.
export interface Water {
  joints: string[]; // none: all that no other names
  density: number; // kg/m³
  pressure?: number; // Pa
  head?: number; // m
  table?: { point: Vec3; normal: Vec3 };
  law?: 'hydrostatic' | 'drained' | 'mid_height'; // none of older programs, which knew the first alone
}

/// max(0, at_origin + gradient·x), Pa.
export interface LinearPressure {
  atOrigin: number;
  gradient: Vec3;
}

/// Which of the waters is in a joint.
export function waterOf(waters: Water[], joint: string): Water | undefined {
  return waters.find((w) => w.joints.includes(joint)) ?? waters.find((w) => w.joints.length === 0);
}

export function linearPressure(water: Water, gravity: Vec3): LinearPressure {
  if (water.pressure !== undefined) return { atOrigin: water.pressure, gradient: [0, 0, 0] };
  const weight = water.density * norm(gravity);
  const up = scale(-1, scale(1 / norm(gravity), gravity));
  if (water.head !== undefined) return { atOrigin: weight * water.head, gradient: scale(-weight, up) };
  const { point, normal } = water.table!;
  const rise = weight / dot(normal, up); // per m along the normal, below the table
  return { atOrigin: rise * dot(point, normal), gradient: scale(-rise, normal) };
}

export interface PressureForce {
  force: number; // N
  firstMoment: Vec3; // N m
}

/// ∫ p dA and ∫ p x dA over a face given by its loops; p is the least of these pressures, no less than zero.
export function pressureForce(loops: Vec3[][], normal: Vec3, pressures: LinearPressure[]): PressureForce {
  const sum = { force: 0, firstMoment: [0, 0, 0] as Vec3 };
  const apex = loops[0]?.[0];
  if (!apex) return sum;
  const rounding = 1e-9 * Math.max(...loops[0]!.map((x) => Math.abs(unclipped(pressures[0]!, x))));
  for (const loop of loops)
    for (let c = 0; c < loop.length; ++c) addLeast(sum, normal, [apex, loop[c]!, loop[(c + 1) % loop.length]!], pressures, rounding, 0, 1);
  return sum;
}

/// Over a convex part, on which pressures[least] is the least of those before `next`.
function addLeast(sum: PressureForce, normal: Vec3, part: Vec3[], pressures: LinearPressure[], rounding: number, least: number, next: number): void {
  if (part.length < 3) return;
  const [other, now] = [pressures[next], pressures[least]!];
  if (!other) {
    for (let k = 2; k < part.length; ++k) addWetPart(sum, normal, [part[0]!, part[k - 1]!, part[k]!], now);
    return;
  }
  const more = { atOrigin: other.atOrigin - now.atOrigin, gradient: sub(other.gradient, now.gradient) };
  addLeast(sum, normal, sideOf(part, more, true, rounding), pressures, rounding, least, next + 1);
  addLeast(sum, normal, sideOf(part, more, false, rounding), pressures, rounding, next, next + 1);
}

/// Where f ≥ 0, or the rest. Values up to `rounding` count as 0.
export function sideOf(polygon: Vec3[], f: LinearPressure, positive: boolean, rounding: number): Vec3[] {
  const value = polygon.map((x) => {
    const v = unclipped(f, x);
    return Math.abs(v) <= rounding ? 0 : v;
  });
  const part: Vec3[] = [];
  polygon.forEach((a, i) => {
    const j = (i + 1) % polygon.length;
    const [fa, fb] = [value[i]!, value[j]!];
    if (fa >= 0 === positive) part.push(a);
    if (fa >= 0 !== fb >= 0) part.push(add(a, scale(fa / (fa - fb), sub(polygon[j]!, a))));
  });
  return part;
}

function unclipped(p: LinearPressure, x: Vec3): number {
  return p.atOrigin + dot(p.gradient, x);
}

/// The part of the triangle where the pressure is ≥ 0.
function addWetPart(sum: PressureForce, normal: Vec3, x: [Vec3, Vec3, Vec3], pressure: LinearPressure): void {
  const p = x.map((at) => unclipped(pressure, at));
  const corners: Vec3[] = [];
  const values: number[] = [];
  for (let i = 0; i < 3; ++i) {
    const j = (i + 1) % 3;
    if (p[i]! >= 0) {
      corners.push(x[i]!);
      values.push(p[i]!);
    }
    if (p[i]! >= 0 === p[j]! >= 0) continue;
    const share = p[i]! / (p[i]! - p[j]!);
    corners.push(add(x[i]!, scale(share, sub(x[j]!, x[i]!))));
    values.push(0);
  }
  for (let i = 2; i < corners.length; ++i)
    addTriangle(sum, normal, [corners[0]!, corners[i - 1]!, corners[i]!], [values[0]!, values[i - 1]!, values[i]!]);
}

function addTriangle(sum: PressureForce, normal: Vec3, x: [Vec3, Vec3, Vec3], p: [number, number, number]): void {
  const area = 0.5 * dot(normal, cross(sub(x[1], x[0]), sub(x[2], x[0])));
  const total = p[0] + p[1] + p[2];
  sum.force += (area * total) / 3;
  for (let i = 0; i < 3; ++i) sum.firstMoment = add(sum.firstMoment, scale((area * (total + p[i]!)) / 12, x[i]!));
}
