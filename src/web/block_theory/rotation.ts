// Rotation of a block about an edge or a corner where it stays in touch with the rock: host/keyblock/motions/rotation.cpp again.
// Which axes move no corner into the rock follows from geometry alone, so that it is found once.
import { add, cross, directionTolerance, dot, norm, normalized, reciprocalNormal, scale, sub, type Vec3 } from './vector';

export interface ContactPatch {
  normal: Vec3;
  corners: Vec3[];
  face: number; // among the block's faces in contact
}

export interface Rotation {
  face: number;
  point: Vec3;
  axis: Vec3;
  driving: number; // N m
  resisting: number; // N m
  safety: number; // about a corner without the twist about the plane's normal
  pressed: number; // N
  velocity: Vec3; // m, of the centroid at 1 rad/s
}

/// What a rotation depends on beside the contacts.
export interface Loads {
  force: Vec3; // N
  moment: Vec3; // N m about the centroid
  friction: number[]; // tan φ of each patch
}

const coordinateRounding = 1e-14;
const mostPlanesForLines = 64;

/// An axis that geometry allows, or a corner whose free rotation is looked at under each load; in the order of the search.
interface Candidate {
  first: number; // patches of the hinge
  second: number;
  point: Vec3;
  axis?: Vec3; // none: the free rotation about `point`
}

export class RotationSearch {
  private readonly candidates: Candidate[] = [];

  /// `inertia`: rows, kg m² about the centroid.
  constructor(private readonly patches: ContactPatch[], private readonly centroid: Vec3, private readonly mass: number,
    private readonly inertia: readonly [Vec3, Vec3, Vec3]) {
    patches.forEach((patch, p) => {
      patch.corners.forEach((corner, k) => {
        this.addAxis(p, p, corner, edgeAxis(patch, k));
        this.candidates.push({ first: p, second: p, point: corner });
      });
      if (patches.length > mostPlanesForLines) return;
      for (let q = p + 1; q < patches.length; ++q) this.addLines(p, q);
    });
  }

  private addAxis(first: number, second: number, point: Vec3, axis: Vec3): void {
    if (this.isPossible(first, second, point, axis)) this.candidates.push({ first, second, point, axis });
  }

  private addLines(first: number, second: number): void {
    for (const from of this.patches[first]!.corners)
      for (const to of this.patches[second]!.corners) {
        const along = sub(to, from);
        if (norm(along) <= coordinateRounding * norm(to)) continue;
        const axis = normalized(along);
        this.addAxis(first, second, from, axis);
        this.addAxis(first, second, from, scale(-1, axis));
      }
  }

  private isPossible(first: number, second: number, point: Vec3, axis: Vec3): boolean {
    return isAdmissible(this.patches, point, axis) && lifts(this.patches[first]!, point, axis) && lifts(this.patches[second]!, point, axis);
  }

  /// Those that the loads start, the least safe one first.
  find(loads: Loads): Rotation[] {
    const found: Rotation[] = [];
    let [first, second] = [-1, -1];
    let pressing: Vec3 | undefined;
    for (const c of this.candidates) {
      if (first !== c.first || second !== c.second) {
        [first, second] = [c.first, c.second];
        pressing = this.pressingPart(c.first, c.second, loads.force);
      }
      if (!pressing) continue;
      const rotation = c.axis ? this.turn(c, c.axis, pressing, loads) : this.turnFreely(c, pressing, loads);
      if (rotation) found.push(rotation);
    }
    return this.sorted(found);
  }

  private pressingPart(i: number, j: number, force: Vec3): Vec3 | undefined {
    const [n, m] = [this.patches[i]!.normal, this.patches[j]!.normal];
    const least = directionTolerance * norm(force);
    if (i === j) return dot(force, n) <= least ? undefined : scale(dot(force, n), n);
    if (norm(cross(n, m)) <= directionTolerance) return undefined;
    const [a, b] = [dot(force, reciprocalNormal(n, m)), dot(force, reciprocalNormal(m, n))];
    return a <= least || b <= least ? undefined : add(scale(a, n), scale(b, m));
  }

  private momentsAbout(axis: Vec3, point: Vec3, loads: Loads, pressing: Vec3): { driving: number; resisting: number } {
    const velocity = cross(axis, sub(this.centroid, point));
    let driving = 0;
    let resisting = 0;
    for (const moment of [dot(pressing, velocity), dot(sub(loads.force, pressing), velocity), dot(loads.moment, axis)])
      if (moment > 0) driving += Math.abs(moment);
      else resisting += Math.abs(moment);
    return { driving, resisting };
  }

  private turn(c: Candidate, axis: Vec3, pressing: Vec3, loads: Loads): Rotation | undefined {
    const moments = this.momentsAbout(axis, c.point, loads, pressing);
    const arm = sub(this.centroid, c.point);
    const velocity = cross(axis, arm);
    const rounding = 1e-9 * (norm(loads.force) * norm(arm) + norm(loads.moment));
    if (moments.driving <= rounding || !(norm(velocity) > 0)) return undefined;
    const resisting = moments.resisting + this.frictionMoment(c.point, axis, loads);
    const on = (patch: number): number => dot(loads.force, this.patches[patch]!.normal);
    const more = on(c.second) > on(c.first) ? c.second : c.first;
    return { face: this.patches[more]!.face, point: c.point, axis, driving: moments.driving, resisting, safety: resisting / moments.driving,
      pressed: on(more), velocity };
  }

  private frictionMoment(point: Vec3, axis: Vec3, loads: Loads): number {
    let sum = 0;
    this.patches.forEach((patch, p) => {
      const pressed = dot(loads.force, patch.normal);
      if (!(pressed > 0) || loads.friction[p] === 0 || patch.corners.length === 0 || lifts(patch, point, axis)) return;
      const foot = add(this.centroid, scale(dot(sub(patch.corners[0]!, this.centroid), patch.normal), patch.normal));
      sum += loads.friction[p]! * pressed * norm(cross(axis, sub(foot, point)));
    });
    return sum;
  }

  /// The free rotation about a corner, of a block that is turned over and not only twisted.
  private turnFreely(c: Candidate, pressing: Vec3, loads: Loads): Rotation | undefined {
    const arm = sub(this.centroid, c.point);
    const acceleration = solution(this.inertiaAbout(arm), add(cross(arm, loads.force), loads.moment));
    if (!(norm(acceleration) > 0)) return undefined;
    const axis = normalized(acceleration);
    const n = this.patches[c.first]!.normal;
    const over = sub(axis, scale(dot(axis, n), n));
    const turning = this.momentsAbout(over, c.point, loads, pressing);
    if (turning.driving <= turning.resisting || !this.isPossible(c.first, c.second, c.point, axis)) return undefined;
    const rotation = this.turn(c, axis, pressing, loads);
    if (!rotation || rotation.driving <= rotation.resisting) return undefined;
    return { ...rotation, safety: turning.resisting / turning.driving };
  }

  private inertiaAbout(arm: Vec3): [Vec3, Vec3, Vec3] {
    const square = this.mass * dot(arm, arm);
    return this.inertia.map((row, i) =>
      row.map((j, k) => (i === k ? j + square : j) - this.mass * arm[i]! * arm[k]!)) as unknown as [Vec3, Vec3, Vec3];
  }

  private vigour(r: Rotation): number {
    const inertia = this.inertiaAbout(sub(this.centroid, r.point));
    const net = r.driving - r.resisting;
    return (net * net) / dot(r.axis, [dot(inertia[0], r.axis), dot(inertia[1], r.axis), dot(inertia[2], r.axis)]);
  }

  /// The least safe first; of equals the more vigorous one, then the one that r presses on more.
  private sorted(found: Rotation[]): Rotation[] {
    const rounding = 1e-10;
    if (found.length < 2) return found;
    const least = Math.min(...found.map((r) => r.safety));
    const [equals, others] = partition(found, (r) => r.safety <= least + rounding * (1 + least));
    const keepMost = (list: Rotation[], value: (r: Rotation) => number): [Rotation[], Rotation[]] => {
      const most = list.reduce((m, r) => Math.max(m, value(r)), 0);
      return partition(list, (r) => value(r) >= (1 - rounding) * most);
    };
    const [vigorous, rest] = keepMost(equals, (r) => this.vigour(r));
    return [...keepMost(vigorous, (r) => r.pressed).flat(), ...rest, ...others.sort((a, b) => a.safety - b.safety)];
  }
}

function partition<T>(list: T[], test: (t: T) => boolean): [T[], T[]] {
  const yes: T[] = [];
  const no: T[] = [];
  for (const t of list) (test(t) ? yes : no).push(t);
  return [yes, no];
}

/// About the edge from corner k to the next, in the sense that lifts the patch's inside.
function edgeAxis(patch: ContactPatch, k: number): Vec3 {
  const from = patch.corners[k]!;
  const axis = normalized(sub(patch.corners[(k + 1) % patch.corners.length]!, from));
  let middle: Vec3 = [0, 0, 0];
  for (const x of patch.corners) middle = add(middle, scale(1 / patch.corners.length, sub(x, from)));
  return dot(cross(axis, middle), patch.normal) > 0 ? scale(-1, axis) : axis;
}

/// Whether turning about the axis through `point` moves no corner of a contact into the rock.
function isAdmissible(patches: ContactPatch[], point: Vec3, axis: Vec3): boolean {
  for (const patch of patches)
    for (const x of patch.corners)
      if (rise(axis, point, x, patch.normal) > directionTolerance * distance(x, point) + coordinateRounding * norm(x)) return false;
  return true;
}

/// Whether some corner of the patch leaves its plane.
function lifts(patch: ContactPatch, point: Vec3, axis: Vec3): boolean {
  for (const x of patch.corners) if (rise(axis, point, x, patch.normal) < -1e-6 * distance(x, point)) return true;
  return false;
}

/// (axis × (x − point))·n and |x − point|, without vectors in between: most of the time is spent here.
function rise(axis: Vec3, point: Vec3, x: Vec3, n: Vec3): number {
  const a = x[0] - point[0];
  const b = x[1] - point[1];
  const c = x[2] - point[2];
  return (axis[1] * c - axis[2] * b) * n[0] + (axis[2] * a - axis[0] * c) * n[1] + (axis[0] * b - axis[1] * a) * n[2];
}
function distance(x: Vec3, point: Vec3): number {
  const a = x[0] - point[0];
  const b = x[1] - point[1];
  const c = x[2] - point[2];
  return Math.sqrt(a * a + b * b + c * c);
}

/// m⁻¹ v of a symmetric, positive definite matrix.
function solution(m: readonly [Vec3, Vec3, Vec3], v: Vec3): Vec3 {
  const [a, b, c] = [cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])];
  return scale(1 / dot(m[0], a), add(add(scale(v[0], a), scale(v[1], b)), scale(v[2], c)));
}
