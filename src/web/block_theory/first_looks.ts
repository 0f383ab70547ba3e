// Block theory again, in the page: the removable blocks of each stage as the program first looked at them, with other friction,
// cohesion, water, earthquake and target. What `rockfold support --set support.batches=1 --set …` answers, to rounding
// (tests/page/what_if_test.py). What cannot be known here is left to the program: `byProgram`.
import type { Arrays, PageDocument } from '../data';
import { leastSupport, rotationCondition, supportAlong, supportConditions } from './least_support';
import { type ContactPatch, type Rotation, RotationSearch } from './rotation';
import { type ContactPlane, findMovement, type Mode, type Movement } from './sliding';
import { add, cross, directionTolerance, norm, normalized, scale, sub, type Vec3, withoutNegativeZero } from './vector';
import { jointPressures, type JointOutline } from './joint_pressure';
import { linearPressure, pressureForce, type Water, waterOf } from './water';

/// What can be changed.
export interface Settings {
  friction: number[]; // deg, of each joint material
  cohesion: number[]; // Pa
  waters: Water[];
  waterPressure: number; // Pa, in joints without a [[water]]
  seismic: Vec3; // fraction of g
  target: number;
}

/// What block theory says of a block that moves, or would without friction and cohesion; units and names as in the program's JSON.
export interface Verdict {
  block: number; // id, from 1
  stage: number;
  key: boolean;
  batch: number; // 0: it stays
  mode: Mode;
  motion?: string; // of a block that nothing holds, as the program calls it
  planes: string[];
  direction: Vec3;
  sliding_force: number;
  factor_of_safety: number | null;
  free_area: number;
  support_force: number;
  support_pressure: number;
  support_direction: Vec3;
  volume: number;
  weight: number;
}

export interface Outcome {
  keyblocks: Verdict[]; // by batch, then block
  stable: Verdict[]; // by block
  byProgram: Set<number>; // ids: what they do follows from blocks that moved at an earlier stage, or from groups
  groups: boolean; // whether groups of blocks may move, which is for the program to say
}

interface Face {
  origin: number;
  normal: Vec3;
  planeNormal: Vec3; // of a facet of a mesh that of its mean plane
  area: number; // m², in contact
  share: number;
  loops: Vec3[][];
  outline: JointOutline | undefined; // none in results of older programs
  plane: number; // into the look's planes
}

interface Leaning {
  block: number; // id
  stage: number;
  neighbours: number[]; // ids
}

interface Look extends Leaning {
  volume: number;
  mass: number;
  freeArea: number;
  centroid: Vec3;
  load: Vec3;
  moment: Vec3;
  freeCentre: Vec3;
  faces: Face[];
  planes: { normal: Vec3; area: number; face: number }[];
  patches: ContactPatch[];
  rotations: RotationSearch;
  water: { key: string; push: Vec3[]; moment: Vec3 }; // as last computed: N of each plane, against the block, N m
}

/// A block whose resistance and driving force differ by less than this share of |r| is stable.
const equilibriumTolerance = 1e-9;

export class FirstLooks {
  readonly initial: Settings;
  private readonly looks: Look[][]; // by stage
  private readonly held: Leaning[][]; // by stage: not removable as long as all that they lean on is there
  private readonly stages: number[];
  private readonly groupsMayMove: boolean[];
  readonly gravity: Vec3;
  private readonly rotation: boolean;
  private readonly supportDirection: Vec3 | null;

  constructor(private readonly document: PageDocument, arrays: Arrays) {
    const setup = document.answer!.setup!;
    const support = setup.support!;
    this.gravity = setup.gravity;
    this.rotation = support.rotation;
    this.supportDirection = support.support_direction;
    this.initial = { friction: setup.joint_materials.map((m) => m.friction_angle), cohesion: setup.joint_materials.map((m) => m.cohesion),
      waters: support.water, waterPressure: support.water_pressure, seismic: support.seismic_coefficient, target: support.target_factor_of_safety };
    this.stages = Array.from(arrays.get('look_looked_at_stage'));
    this.groupsMayMove = Array.from(arrays.get('look_groups_may_move'), (g) => g === 1);
    const looks = readLooks(arrays);
    const held = readHeld(arrays);
    const atStage = <T extends Leaning>(list: T[]): T[][] => this.stages.map((stage) => list.filter((one) => one.stage === stage));
    this.looks = atStage(looks);
    this.held = atStage(held);
  }

  /// None where the result lacks what is needed: of `cut`, of an older program, or with in-situ stress on joints.
  static read(document: PageDocument, arrays: Arrays): FirstLooks | undefined {
    const support = document.answer?.setup?.support;
    return support?.water && arrays.has('look_block') ? new FirstLooks(document, arrays) : undefined;
  }

  /// Blocks that are looked at.
  get count(): number {
    return this.looks.reduce((n, list) => n + list.length, 0);
  }

  get stageCount(): number {
    return this.stages.length;
  }

  /// Their ids.
  blocks(): Set<number> {
    return new Set(this.looks.flat().map((look) => look.block));
  }

  /// The joint materials on which removable blocks lean.
  materials(): number[] {
    const used = new Set<number>();
    for (const look of this.looks.flat()) for (const face of look.faces) used.add(this.document.origins[face.origin]!.material);
    return [...used].filter((m) => m >= 0).sort((a, b) => a - b);
  }

  /// m, of all corners of faces in contact.
  levels(): [number, number] {
    let [low, high] = [Infinity, -Infinity];
    for (const look of this.looks.flat())
      for (const face of look.faces) for (const x of face.loops.flat()) [low, high] = [Math.min(low, x[2]), Math.max(high, x[2])];
    return [low, high];
  }

  evaluate(settings: Settings): Outcome {
    const tan = settings.friction.map((angle) => Math.tan((angle * Math.PI) / 180));
    const waterKey = JSON.stringify([settings.waters, settings.waterPressure]);
    const moved = new Set<number>();
    const byProgram = new Set<number>();
    const stable = new Map<number, Verdict>();
    const outcome: Outcome = { keyblocks: [], stable: [], byProgram, groups: false };
    let batch = 0;
    this.looks.forEach((looks, s) => {
      const known = (look: Leaning): boolean => !outcome.groups && ![look.block, ...look.neighbours].some((b) => byProgram.has(b) || moved.has(b));
      const left: number[] = [];
      const keys: Verdict[] = [];
      for (const look of looks) {
        if (moved.has(look.block)) continue;
        stable.delete(look.block);
        const verdict = known(look) ? this.judge(look, settings, tan, waterKey) : null;
        if (verdict === null) left.push(look.block);
        else if (verdict?.key) keys.push(verdict);
        else if (verdict) stable.set(look.block, verdict);
      }
      for (const one of this.held[s]!) if (!moved.has(one.block) && !known(one)) left.push(one.block);
      for (const block of left) byProgram.add(block);
      if (keys.length > 0) ++batch;
      for (const key of keys) {
        key.batch = batch;
        moved.add(key.block);
      }
      outcome.keyblocks.push(...keys);
      if (keys.length === 0 && this.groupsMayMove[s]) outcome.groups = true;
    });
    outcome.stable = [...stable.values()].sort((a, b) => a.block - b.block);
    return outcome;
  }

  /// Pushes of water on the planes of a block, and their moment; kept until the water changes.
  private water(look: Look, { waters, waterPressure }: Settings, key: string): Look['water'] {
    if (look.water.key === key) return look.water;
    const push = look.planes.map((): Vec3 => [0, 0, 0]);
    let moment: Vec3 = [0, 0, 0];
    for (const face of look.faces) {
      const origin = this.document.origins[face.origin]!;
      const water = origin.kind === 1 ? undefined : waterOf(waters, origin.name);
      const p = water ? linearPressure(water, this.gravity) : { atOrigin: waterPressure, gradient: [0, 0, 0] as Vec3 };
      if (p.atOrigin === 0 && norm(p.gradient) === 0) continue;
      const pressures = water && face.outline ? jointPressures(water, this.gravity, face.outline) : [p];
      const { force, firstMoment } = pressureForce(face.loops, face.normal, pressures);
      push[face.plane] = add(push[face.plane]!, scale(face.share * force, face.normal));
      moment = sub(moment, scale(face.share, cross(sub(firstMoment, scale(force, look.centroid)), face.normal)));
    }
    return (look.water = { key, push, moment });
  }

  /// Undefined: nothing drives it.
  private judge(look: Look, settings: Settings, tan: number[], waterKey: string): Verdict | undefined {
    const water = this.water(look, settings, waterKey);
    const planes = this.planes(look, settings, tan);
    const load = add(look.load, scale(look.mass * norm(this.gravity), settings.seismic));
    let r = load;
    let size = norm(load);
    for (const push of water.push) {
      r = sub(r, push);
      size += norm(push);
    }
    if (norm(r) <= 1e-12 * size) r = [0, 0, 0];
    const movement = findMovement(planes, r);
    const slides = !!movement && movement.driving - movement.resisting > equilibriumTolerance * norm(r);
    const falls = movement?.mode === 'lifting';
    const rotations = this.rotation && !falls
      ? look.rotations.find({ force: r, moment: add(look.moment, water.moment), friction: look.patches.map((p) => tan[this.materialOf(look, p.face)] ?? 0) })
      : [];
    if (!movement && rotations.length === 0) return undefined;
    const key = slides || (rotations.length > 0 && rotations[0]!.safety < 1 - equilibriumTolerance);
    return this.describe(look, planes, movement, rotations, settings, key);
  }

  /// The rule of mode_words in src/report/summaries, with the limit that the document carries.
  private motionOf({ mode, direction }: Movement): string | undefined {
    const within = this.document.answer!.setup!.support!.pushed_out_within;
    if (mode !== 'lifting' || within === undefined) return undefined;
    return direction[2] > within ? 'pushed up' : direction[2] > -within ? 'pushed out' : 'falls';
  }

  private materialOf(look: Look, face: number): number {
    return this.document.origins[look.faces[face]!.origin]!.material;
  }

  private planes(look: Look, settings: Settings, tan: number[]): ContactPlane[] {
    const planes: ContactPlane[] = look.planes.map(({ normal, face }) => ({ normal, face, friction: 0, cohesion: 0 }));
    look.faces.forEach((face, f) => {
      const material = this.materialOf(look, f);
      const plane = planes[face.plane]!;
      plane.friction += face.area * (tan[material] ?? 0);
      plane.cohesion += face.area * (settings.cohesion[material] ?? 0);
    });
    planes.forEach((plane, k) => { plane.friction /= look.planes[k]!.area; });
    return planes;
  }

  private describe(look: Look, planes: ContactPlane[], movement: Movement | undefined, rotations: Rotation[], settings: Settings, key: boolean): Verdict {
    const turn = rotations[0];
    const turns = turn && (!movement || turn.safety * movement.driving < movement.resisting);
    const name = (face: number): string => this.document.origins[look.faces[face]!.origin]!.name;
    const conditions = [
      ...(movement ? supportConditions(planes, movement, settings.target) : []),
      ...rotations.map((r) => rotationCondition(r, look.freeCentre, settings.target)),
    ];
    const support = this.supportDirection ? supportAlong(conditions, this.supportDirection) : leastSupport(conditions);
    const common = { block: look.block, stage: look.stage, key, batch: 0, volume: look.volume, weight: look.mass * norm(this.gravity),
      free_area: look.freeArea, support_force: support.force, support_direction: withoutNegativeZero(support.direction),
      support_pressure: look.freeArea > 0 ? support.force / look.freeArea : 0 };
    if (turns)
      return { ...common, mode: 'rotation', planes: [name(turn.face)], direction: withoutNegativeZero(normalized(turn.velocity)),
        sliding_force: (turn.driving - turn.resisting) / norm(turn.velocity), factor_of_safety: turn.resisting > 0 ? turn.safety : null };
    const m = movement!;
    return { ...common, mode: m.mode, motion: this.motionOf(m), planes: m.planes.map((k) => name(planes[k]!.face)), direction: withoutNegativeZero(m.direction),
      sliding_force: m.driving - m.resisting, factor_of_safety: m.mode === 'lifting' && m.resisting === 0 ? null : m.resisting / m.driving };
  }
}

/// The faces with one outward normal together, in the order of the faces.
function planesOf(faces: Face[]): Look['planes'] {
  const planes: Look['planes'] = [];
  faces.forEach((face, f) => {
    let k = planes.findIndex((p) => norm(sub(p.normal, face.planeNormal)) <= directionTolerance);
    if (k < 0) k = planes.push({ normal: face.planeNormal, area: 0, face: -1 }) - 1;
    const plane = planes[k]!;
    if (plane.face < 0 || face.area > faces[plane.face]!.area) plane.face = f;
    plane.area += face.area;
    face.plane = k;
  });
  return planes;
}

function readHeld(arrays: Arrays): Leaning[] {
  const [block, stage, begin, neighbour] = ['block', 'stage', 'neighbour_begin', 'neighbour'].map((name) => arrays.get(`look_held_${name}`));
  return Array.from(block!, (b, i) => ({ block: b + 1, stage: stage![i]!, neighbours: Array.from(neighbour!.subarray(begin![i]!, begin![i + 1]!), (n) => n + 1) }));
}

type VectorsOf = (name: string) => (i: number) => Vec3;

function readOutlines(arrays: Arrays, vec: VectorsOf, range: (begin: ArrayLike<number>, i: number) => number[]): JointOutline[] {
  if (!arrays.has('look_outline')) return [];
  const [normal, corner] = [vec('outline_normal'), vec('outline_corner')];
  const get = (name: string): ArrayLike<number> => arrays.get(`look_outline_${name}`);
  const [begin, drains, edgeDrains, pond] = [get('begin'), get('drains'), get('edge_drains'), get('pond')];
  return Array.from({ length: begin.length - 1 }, (_, u) => ({ normal: normal(u),
    corners: range(begin, u).map((c) => ({ at: corner(c), share: drains[c]!, edgeShare: edgeDrains[c]!, pond: pond[c]! })) }));
}

function readLooks(arrays: Arrays): Look[] {
  const get = (name: string): ArrayLike<number> => arrays.get(`look_${name}`);
  const vec = (name: string): ((i: number) => Vec3) => {
    const list = get(name);
    return (i) => [list[3 * i]!, list[3 * i + 1]!, list[3 * i + 2]!];
  };
  const range = (begin: ArrayLike<number>, i: number): number[] => Array.from({ length: begin[i + 1]! - begin[i]! }, (_, k) => begin[i]! + k);
  const [block, stage, volume, mass, freeArea] = [get('block'), get('stage'), get('volume'), get('mass'), get('free_area')];
  const [centroid, load, moment, freeCentre, inertia] = [vec('centroid'), vec('load'), vec('moment'), vec('free_centre'), vec('inertia')];
  const [origin, area, share, normal, planeNormal, corner] =
    [get('origin'), get('contact_area'), get('share'), vec('normal'), vec('plane_normal'), vec('corner')];
  const [patchFace, patchNormal, patchCorner] = [get('patch_face'), vec('patch_normal'), vec('patch_corner')];
  const outlines = readOutlines(arrays, vec, range);
  const outlineOf = arrays.find('look_outline');
  const [faceBegin, loopBegin, cornerBegin, patchBegin, patchCornerBegin] =
    ['face_begin', 'loop_begin', 'corner_begin', 'patch_begin', 'patch_corner_begin'].map(get) as [ArrayLike<number>, ArrayLike<number>, ArrayLike<number>, ArrayLike<number>, ArrayLike<number>];
  const neighbours = get('neighbour');
  return Array.from(block, (b, i) => {
    const faces: Face[] = range(faceBegin, i).map((f) => ({ origin: origin[f]!, normal: normal(f), planeNormal: planeNormal(f), area: area[f]!, share: share[f]!,
      loops: range(loopBegin, f).map((loop) => range(cornerBegin, loop).map(corner)), outline: outlines[outlineOf?.[f] ?? -1], plane: 0 }));
    const patches = range(patchBegin, i).map((p) => ({ normal: patchNormal(p), corners: range(patchCornerBegin, p).map(patchCorner),
      face: patchFace[p]! - faceBegin[i]! }));
    return { block: b + 1, stage: stage[i]!, volume: volume[i]!, mass: mass[i]!, freeArea: freeArea[i]!, centroid: centroid(i), load: load(i),
      moment: moment(i), freeCentre: freeCentre(i), neighbours: range(get('neighbour_begin'), i).map((n) => neighbours[n]! + 1), faces,
      planes: planesOf(faces), patches, rotations: new RotationSearch(patches, centroid(i), mass[i]!, [inertia(3 * i), inertia(3 * i + 1), inertia(3 * i + 2)]),
      water: { key: '', push: [], moment: [0, 0, 0] } };
  });
}
