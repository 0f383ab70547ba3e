// The force that brings a moving block to a target factor of safety: host/keyblock/motions/least_support.cpp again.
import type { Rotation } from './rotation';
import type { ContactPlane, Movement } from './sliding';
import { add, cross, dot, norm, reciprocalNormal, scale, sub, unit, type Vec3, zero } from './vector';

/// What a motion asks of the support P: gain·P ≥ deficit.
export interface SupportCondition {
  gain: Vec3;
  deficit: number;
}
export interface SupportForce {
  force: number; // N; Infinity where none suffices
  direction: Vec3;
}

const rounding = 1e-10;

export function supportConditions(planes: ContactPlane[], m: Movement, target: number): SupportCondition[] {
  const deficit = target * m.driving - m.resisting;
  if (m.mode === 'lifting') return [{ gain: scale(-1, m.direction), deficit }];
  let gain = scale(-target, m.direction);
  const others: SupportCondition[] = [];
  m.planes.forEach((index, k) => {
    const plane = planes[index]!;
    const b = m.planes.length === 1 ? plane.normal : reciprocalNormal(plane.normal, planes[m.planes[1 - k]!]!.normal);
    gain = add(gain, scale(plane.friction, b));
    others.push({ gain: b, deficit: -m.normalForce[k]! });
  });
  return [{ gain, deficit }, ...others];
}

export function rotationCondition(rotation: Rotation, at: Vec3, target: number): SupportCondition {
  return { gain: scale(-target, cross(rotation.axis, sub(at, rotation.point))), deficit: target * rotation.driving - rotation.resisting };
}

function meets(c: SupportCondition, p: Vec3): boolean {
  const size = Math.abs(c.deficit) + norm(c.gain) * norm(p);
  return dot(c.gain, p) - c.deficit >= -rounding * size;
}

/// The shortest P that meets two conditions exactly.
function shortest(a: SupportCondition, b: SupportCondition): Vec3 | undefined {
  const [aa, ab, bb] = [dot(a.gain, a.gain), dot(a.gain, b.gain), dot(b.gain, b.gain)];
  const determinant = aa * bb - ab * ab;
  if (determinant <= rounding * rounding * aa * bb) return undefined;
  return add(scale((a.deficit * bb - b.deficit * ab) / determinant, a.gain), scale((b.deficit * aa - a.deficit * ab) / determinant, b.gain));
}

/// The P that meets three conditions exactly.
function corner(a: SupportCondition, b: SupportCondition, c: SupportCondition): Vec3 | undefined {
  const ab = cross(a.gain, b.gain);
  const determinant = dot(ab, c.gain);
  if (Math.abs(determinant) <= rounding * norm(a.gain) * norm(b.gain) * norm(c.gain)) return undefined;
  return scale(1 / determinant, add(add(scale(a.deficit, cross(b.gain, c.gain)), scale(b.deficit, cross(c.gain, a.gain))), scale(c.deficit, ab)));
}

interface Tight {
  p: Vec3;
  conditions: SupportCondition[];
}

function shortestOfFew(few: SupportCondition[]): Tight | undefined {
  let best: Tight | undefined;
  const lookAt = (p: Vec3 | undefined, conditions: SupportCondition[]): void => {
    if (!p || (best && norm(p) >= norm(best.p))) return;
    if (few.every((c) => meets(c, p))) best = { p, conditions };
  };
  few.forEach((a, i) => {
    lookAt(scale(a.deficit / dot(a.gain, a.gain), a.gain), [a]);
    for (let j = i + 1; j < few.length; ++j) {
      lookAt(shortest(a, few[j]!), [a, few[j]!]);
      for (let k = j + 1; k < few.length; ++k) lookAt(corner(a, few[j]!, few[k]!), [a, few[j]!, few[k]!]);
    }
  });
  return best;
}

function mostMissed(conditions: SupportCondition[], p: Vec3): SupportCondition | undefined {
  let most: SupportCondition | undefined;
  let by = 0;
  for (const c of conditions) {
    if (meets(c, p)) continue;
    const distance = norm(c.gain) > 0 ? (c.deficit - dot(c.gain, p)) / norm(c.gain) : Infinity;
    if (!most || distance > by) [most, by] = [c, distance];
  }
  return most;
}

/// The least force, over all directions, that meets all conditions.
export function leastSupport(conditions: SupportCondition[]): SupportForce {
  const first = conditions[0]!;
  let least: Tight = { p: zero, conditions: [] };
  for (let step = 0; step < 100 + 10 * conditions.length; ++step) {
    const missed = mostMissed(conditions, least.p);
    if (!missed) break;
    const next = norm(missed.gain) > 0 ? shortestOfFew([...least.conditions, missed]) : undefined;
    if (!next) return { force: Infinity, direction: unit(first.gain) };
    least = next;
  }
  return { force: norm(least.p), direction: unit(norm(least.p) > 0 ? least.p : first.gain) };
}

/// The least force along a unit direction.
export function supportAlong(conditions: SupportCondition[], direction: Vec3): SupportForce {
  let least = 0;
  let most = Infinity;
  for (const c of conditions) {
    const share = dot(c.gain, direction);
    if (Math.abs(share) <= rounding * norm(c.gain)) {
      if (c.deficit > 0) return { force: Infinity, direction };
    } else if (share > 0) least = Math.max(least, c.deficit / share);
    else if (c.deficit > 0) return { force: Infinity, direction };
    else most = Math.min(most, c.deficit / share);
  }
  return { force: least <= (1 + rounding) * most ? least : Infinity, direction };
}
