// The pressure of water in a joint whose edges drain in part: host/keyblock/water/joint_pressure.cpp again.
import { add, cross, dot, norm, scale, sub, type Vec3 } from './vector';
import { type LinearPressure, linearPressure, pressureForce, sideOf, type Water } from './water';

interface LeastValue {
  at: Vec3; // from the outline's first corner
  value: number; // Pa
}

const [leastArea, valueRounding] = [1e-12, 1e-9];

/// A corner of a joint's outline, and how far water leaves the joint there and along the edge to the next one.
export interface DrainedCorner {
  at: Vec3;
  share: number; // 0 to 1
  edgeShare: number;
  pond: number; // Pa, of water before it
}

/// Of a face, or of several that are one joint.
export interface JointOutline {
  corners: DrainedCorner[];
  normal: Vec3;
}

/// Linear functions whose least is the pressure: the hydrostatic one first.
export function jointPressures(water: Water, gravity: Vec3, { corners, normal }: JointOutline): LinearPressure[] {
  const hydrostatic = linearPressure(water, gravity);
  if ((water.law ?? 'hydrostatic') === 'hydrostatic' || !corners.some((c) => c.share > 0 || c.edgeShare > 0)) return [hydrostatic];
  const first = corners[0]!.at;
  return [hydrostatic, ...concavePieces(leastValues(water, hydrostatic, corners, normal))
    .map(({ atOrigin, gradient }) => ({ atOrigin: atOrigin - dot(gradient, first), gradient }))];
}

function pressureAt(p: LinearPressure, x: Vec3): number {
  return p.atOrigin + dot(p.gradient, x);
}

function leastValues(water: Water, hydrostatic: LinearPressure, outline: DrainedCorner[], normal: Vec3): LeastValue[] {
  const peak = water.pressure !== undefined ? 1 : 0.5;
  const first = outline[0]!.at;
  const values = outline.map(({ at, share, pond }): LeastValue => {
    const full = Math.max(0, pressureAt(hydrostatic, at));
    return { at: sub(at, first), value: (1 - share) * full + share * Math.min(full, pond) };
  });
  outline.forEach((corner, i) => {
    let [deep, high] = [corner, outline[(i + 1) % outline.length]!];
    const held = 1 - corner.edgeShare;
    let [below, above] = [pressureAt(hydrostatic, deep.at), pressureAt(hydrostatic, high.at)];
    if (below < above) [deep, high, below, above] = [high, deep, above, below];
    if (!(held > 0 && below > 0)) return;
    const weight = held * (water.law === 'drained' ? deep.share * high.share : 1);
    const from = sub(deep.at, first);
    const along = sub(sub(high.at, first), from);
    if (above > 0) values.push({ at: add(from, scale(0.5, along)), value: weight * high.share * peak * below });
    if (above <= 0.5 * below)
      values.push({ at: add(from, scale((0.5 * below) / (below - above), along)), value: weight * (above > 0 ? 1 - high.share : 1) * 0.5 * below });
  });
  return [...values, ...middleOf(hydrostatic, outline, normal, peak)];
}

/// Of a face that drains all round.
function middleOf(hydrostatic: LinearPressure, outline: DrainedCorner[], normal: Vec3, peak: number): LeastValue[] {
  const drained = Math.min(1, ...outline.map((c) => c.edgeShare));
  const deepest = Math.max(0, ...outline.map((c) => pressureAt(hydrostatic, c.at)));
  if (!(drained > 0 && deepest > 0)) return [];
  const middle = wetMiddle(outline.map((c) => c.at), normal, hydrostatic);
  return [{ at: sub(middle, outline[0]!.at), value: drained * Math.min(Math.max(0, pressureAt(hydrostatic, middle)), peak * deepest) }];
}

function wetMiddle(corners: Vec3[], normal: Vec3, hydrostatic: LinearPressure): Vec3 {
  let [area, moment]: [number, Vec3] = [0, [0, 0, 0]];
  for (let k = 2; k < corners.length; ++k) {
    const wet = sideOf([corners[0]!, corners[k - 1]!, corners[k]!], hydrostatic, true, 0);
    const part = pressureForce([wet], normal, [{ atOrigin: 1, gradient: [0, 0, 0] }]);
    area += part.force;
    moment = add(moment, part.firstMoment);
  }
  return area > 0 ? scale(1 / area, moment) : corners[0]!;
}

/// The linear function in a plane with these values at three points, if they span one.
function planeThrough(a: LeastValue, b: LeastValue, c: LeastValue, smallest: number): LinearPressure | undefined {
  const [e, f] = [sub(b.at, a.at), sub(c.at, a.at)];
  const n = cross(e, f);
  if (!(norm(n) > smallest)) return undefined;
  const gradient = scale(1 / dot(n, n), add(scale(b.value - a.value, cross(f, n)), scale(c.value - a.value, cross(n, e))));
  return { atOrigin: a.value - dot(gradient, a.at), gradient };
}

/// The pieces of the least concave function above the values.
function concavePieces(values: LeastValue[]): LinearPressure[] {
  const size = Math.max(...values.map((v) => norm(sub(v.at, values[0]!.at))));
  const rounding = valueRounding * Math.max(...values.map((v) => v.value));
  const pieces: LinearPressure[] = [];
  const isNew = (piece: LinearPressure): boolean =>
    !pieces.some((known) => values.every((v) => Math.abs(pressureAt(known, v.at) - pressureAt(piece, v.at)) <= rounding));
  for (let i = 0; i < values.length; ++i)
    for (let j = i + 1; j < values.length; ++j)
      for (let k = j + 1; k < values.length; ++k) {
        const piece = planeThrough(values[i]!, values[j]!, values[k]!, leastArea * size * size);
        if (piece && values.every((v) => pressureAt(piece, v.at) >= v.value - rounding) && isNew(piece)) pieces.push(piece);
      }
  return pieces;
}
