// Block theory in the page, against closed forms. That it answers as the program does, is tests/page/what_if_test.py's.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { leastSupport, supportConditions } from '../block_theory/least_support';
import { RotationSearch } from '../block_theory/rotation';
import { type ContactPlane, findMovement } from '../block_theory/sliding';
import type { Vec3 } from '../block_theory/vector';
import { type DrainedCorner, jointPressures } from '../block_theory/joint_pressure';
import { linearPressure, pressureForce, type Water } from '../block_theory/water';

const near = (a: number, b: number, share = 1e-12): void => assert.ok(Math.abs(a - b) <= share * Math.max(Math.abs(a), Math.abs(b)), `${a} is not ${b}`);
const rad = Math.PI / 180;

/// A plane under a block, dipping to the east.
function slope(dip: number, friction: number, cohesion = 0): ContactPlane {
  return { normal: [-Math.sin(dip * rad), 0, -Math.cos(dip * rad)], friction: Math.tan(friction * rad), cohesion, face: 0 };
}

test('on one plane the factor of safety is tan φ / tan dip, and cohesion adds c A / (W sin dip)', () => {
  const plane = slope(40, 30, 25e3);
  const m = findMovement([plane], [0, 0, -1e5])!;
  assert.equal(m.mode, 'single_plane');
  near(m.resisting / m.driving, Math.tan(30 * rad) / Math.tan(40 * rad) + 25e3 / (1e5 * Math.sin(40 * rad)));
  near(m.direction[0], Math.cos(40 * rad));
});

test('a symmetric wedge has the factor that Hoek & Bray give: K tan φ / tan plunge', () => {
  // Planes dip 45° to the south-east and south-west; their line plunges atan(√½) south.
  const s = Math.SQRT1_2;
  const planes = [[-0.5, 0.5, -s], [0.5, 0.5, -s]].map((n) => ({ normal: n as unknown as Vec3, friction: Math.tan(30 * rad), cohesion: 0, face: 0 }));
  const m = findMovement(planes, [0, 0, -1])!;
  assert.equal(m.mode, 'two_planes');
  const plunge = Math.atan(Math.SQRT1_2);
  const half = 60 * rad; // between the planes: 120°, K = 1 / sin 60°
  near(m.resisting / m.driving, Math.tan(30 * rad) / (Math.tan(plunge) * Math.sin(half)), 1e-9);
});

test('without any plane below, a block falls; on a plane that the load leaves, it lifts', () => {
  assert.equal(findMovement([], [0, 0, -5])!.mode, 'lifting');
  assert.equal(findMovement([slope(40, 30)], [0, 0, 5])!.mode, 'lifting');
  assert.equal(findMovement([slope(0, 30)], [0, 0, -5]), undefined); // level: at rest
});

test('the least support of a block on a plane acts at the friction angle to it', () => {
  const plane = slope(50, 20);
  const m = findMovement([plane], [0, 0, -1e5])!;
  const { force, direction } = leastSupport(supportConditions([plane], m, 1));
  near(force, 1e5 * Math.sin(30 * rad) , 1e-9); // W sin(dip − φ)
  near(direction[2], Math.sin((50 - 20) * rad), 1e-9);
});

test('a slender column on a slope turns over its lower edge before it slides', () => {
  // 1 m × 1 m × 4 m across a plane of 30°, in the plane's own axes: x down the slope, z up.
  const corners: Vec3[] = [[-0.5, -0.5, 0], [-0.5, 0.5, 0], [0.5, 0.5, 0], [0.5, -0.5, 0]];
  const g = 1e4;
  const force: Vec3 = [g * Math.sin(30 * rad), 0, -g * Math.cos(30 * rad)];
  const inertia: [Vec3, Vec3, Vec3] = [[1.42e3, 0, 0], [0, 1.42e3, 0], [0, 0, 170]];
  const search = new RotationSearch([{ normal: [0, 0, -1], corners, face: 0 }], [0, 0, 2], 1e3, inertia);
  const turns = search.find({ force, moment: [0, 0, 0], friction: [Math.tan(40 * rad)] });
  assert.equal(turns[0]!.face, 0);
  near(turns[0]!.point[0], 0.5);
  // Driving: W sin 30° × 2 m; resisting: W cos 30° × 0.5 m.
  near(turns[0]!.safety, (0.5 * Math.cos(30 * rad)) / (2 * Math.sin(30 * rad)));
  assert.equal(search.find({ force: [0, 0, -g], moment: [0, 0, 0], friction: [1] }).length, 0);
});

test('water below a table presses on the wet part of a wall by ρ g h² b / 2', () => {
  const wall: Vec3[] = [[0, 0, 0], [0, 3, 0], [0, 3, 5], [0, 0, 5]];
  const p = linearPressure({ joints: [], density: 1000, table: { point: [7, 7, 4], normal: [0, 0, 1] } }, [0, 0, -10]);
  const { force, firstMoment } = pressureForce([wall], [1, 0, 0], [p]);
  near(force, (1e4 * 4 * 4 * 3) / 2);
  near(firstMoment[2] / force, 4 / 3);
  near(firstMoment[1] / force, 1.5);
});

test('water in a plane that daylights at both ends has its peak at mid-height, below a crack at its foot', () => {
  const [height, gamma] = [6, 1e4];
  const [toe, length] = [[0, 0, 0] as Vec3, height / Math.sin(30 * rad)];
  const top: Vec3 = [-length * Math.cos(30 * rad), 0, height];
  const corners = (drainsAbove: number): DrainedCorner[] => [
    { at: toe, share: 1, edgeShare: 1, pond: 0 }, { at: [0, 3, 0], share: 1, edgeShare: 0, pond: 0 },
    { at: [top[0], 3, height], share: drainsAbove, edgeShare: drainsAbove, pond: 0 }, { at: top, share: drainsAbove, edgeShare: 0, pond: 0 }];
  const normal: Vec3 = [Math.sin(30 * rad), 0, Math.cos(30 * rad)];
  const force = (water: Water, drainsAbove: number): number =>
    pressureForce([corners(drainsAbove).map((c) => c.at)], normal, jointPressures(water, [0, 0, -10], { corners: corners(drainsAbove), normal })).force;
  const water: Water = { joints: [], density: 1000, head: height, law: 'mid_height' };
  near(force(water, 1), 0.25 * gamma * height * length * 3);
  near(force({ ...water, head: height + 2, law: 'drained' }, 0), 0.5 * gamma * 2 * length * 3);
  near(force({ ...water, law: 'hydrostatic' }, 1), 0.5 * gamma * height * length * 3);
});
