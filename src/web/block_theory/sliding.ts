// The translation that a resultant starts and what joints hold against it: host/keyblock/motions/sliding.cpp again, operation by
// operation, so that both give the same numbers.
import { cross, directionTolerance, dot, norm, reciprocalNormal, scale, sub, unit, type Vec3 } from './vector';

/// Faces of one block that lie against rock that stays and share one outward normal.
export interface ContactPlane {
  normal: Vec3;
  friction: number; // tan φ
  cohesion: number; // N
  face: number; // the one with the largest contact
}

export type Mode = 'lifting' | 'single_plane' | 'two_planes' | 'rotation';

export interface Movement {
  mode: Mode;
  planes: number[]; // into the contact planes: 0, 1 or 2
  direction: Vec3;
  driving: number; // N
  normalForce: number[]; // N, of each of `planes`
  resisting: number; // N
}

/// Rounding of a component of r, over |r|.
const forceRounding = 1e-15;

function isAdmissible(planes: ContactPlane[], s: Vec3, rLength: number): boolean {
  const limit = directionTolerance * norm(s) + forceRounding * rLength;
  return planes.every((p) => dot(p.normal, s) <= limit);
}

function singlePlane(planes: ContactPlane[], i: number, r: Vec3, length: number): Movement | undefined {
  const plane = planes[i]!;
  const force = dot(r, plane.normal);
  if (force <= directionTolerance * length) return undefined;
  const s = sub(r, scale(force, plane.normal));
  const driving = norm(s);
  if (driving <= directionTolerance * length || !isAdmissible(planes, s, length)) return undefined;
  return { mode: 'single_plane', planes: [i], direction: unit(s), driving, normalForce: [force], resisting: force * plane.friction + plane.cohesion };
}

function twoPlanes(planes: ContactPlane[], i: number, j: number, r: Vec3, length: number): Movement | undefined {
  const [a, b] = [planes[i]!, planes[j]!];
  const line = cross(a.normal, b.normal);
  if (norm(line) <= directionTolerance) return undefined;
  const s = scale(dot(line, r) < 0 ? -1 : 1, unit(line));
  const driving = dot(r, s);
  if (driving <= directionTolerance * length) return undefined;
  const onA = dot(r, reciprocalNormal(a.normal, b.normal));
  const onB = dot(r, reciprocalNormal(b.normal, a.normal));
  if (Math.min(onA, onB) < -forceRounding * length || !isAdmissible(planes, s, 1)) return undefined;
  const normalForce = [Math.max(onA, 0), Math.max(onB, 0)];
  return { mode: 'two_planes', planes: [i, j], direction: s, driving, normalForce,
    resisting: normalForce[0]! * a.friction + a.cohesion + normalForce[1]! * b.friction + b.cohesion };
}

function possibleMovements(planes: ContactPlane[], r: Vec3): Movement[] {
  const length = norm(r);
  if (!(length > 0)) return [];
  if (isAdmissible(planes, r, length))
    return [{ mode: 'lifting', planes: [], direction: unit(r), driving: length, normalForce: [], resisting: 0 }];
  const found: Movement[] = [];
  const keep = (m: Movement | undefined): void => { if (m) found.push(m); };
  for (let i = 0; i < planes.length; ++i) keep(singlePlane(planes, i, r, length));
  if (found.length > 0) return found;
  for (let i = 0; i < planes.length; ++i) for (let j = i + 1; j < planes.length; ++j) keep(twoPlanes(planes, i, j, r, length));
  return found;
}

/// The movement with the largest sliding force, of equals (to rounding) the first; undefined at rest.
export function findMovement(planes: ContactPlane[], r: Vec3): Movement | undefined {
  let worst: Movement | undefined;
  for (const m of possibleMovements(planes, r))
    if (!worst || m.driving - m.resisting > worst.driving - worst.resisting + 1e-12 * norm(r)) worst = m;
  return worst;
}
