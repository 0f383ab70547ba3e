// Water on faces: host/keyblock/water.cpp and the integrals of host/keyblock/face_shape.cpp again.
import { add, cross, dot, norm, scale, sub, type Vec3 } from './vector';

/// A [[water]] of the model.
export interface Water {
  joints: string[]; // none: all that no other names
  density: number; // kg/m³
  pressure?: number; // Pa
  head?: number; // m
  table?: { point: Vec3; normal: Vec3 };
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

/// ∫ p dA and ∫ p x dA over a face given by its loops.
export function pressureForce(loops: Vec3[][], normal: Vec3, p: LinearPressure): PressureForce {
  const sum = { force: 0, firstMoment: [0, 0, 0] as Vec3 };
  const apex = loops[0]?.[0];
  if (!apex) return sum;
  for (const loop of loops)
    for (let c = 0; c < loop.length; ++c) addWetPart(sum, normal, [apex, loop[c]!, loop[(c + 1) % loop.length]!], p);
  return sum;
}

/// The part of the triangle where the pressure is ≥ 0.
function addWetPart(sum: PressureForce, normal: Vec3, x: [Vec3, Vec3, Vec3], pressure: LinearPressure): void {
  const p = x.map((at) => pressure.atOrigin + dot(pressure.gradient, at));
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
