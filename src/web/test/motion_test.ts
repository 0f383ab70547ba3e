import assert from 'node:assert/strict';
import { test } from 'node:test';
import { makeFields, rangeOf, vonMises } from '../fields';
import { firstMagnification } from '../first_view';
import { historyAt, Motion, placeAt } from '../motion';
import { readSurface } from '../scene/surface';
import { sampleData, sampleMotion } from './sample';

const near = (a: ArrayLike<number>, b: number[], tolerance = 1e-6): void =>
  b.forEach((x, i) => assert.ok(Math.abs(a[i]! - x) <= tolerance, `${Array.from(a)} is not ${b}`));

test('a place lies between two states', () => {
  assert.deepEqual(placeAt(1.25, 4), { from: 1, to: 2, share: 0.25 });
  assert.deepEqual(placeAt(9, 4), { from: 3, to: 3, share: 0 });
  assert.deepEqual(placeAt(-1, 4), { from: 0, to: 0, share: 0 });
});

test('points go with their block, by hand', () => {
  const data = sampleData(sampleMotion());
  const surface = readSurface(data.arrays);
  const motion = new Motion(surface, data.arrays);
  const u = motion.displacement(1);
  // Point (2, 0, 0): arm (1.5, −0.75, −0.25); d + G arm = (1 + 0.075, 0.15, 0).
  near(u.subarray(3, 6), [1.075, 0.15, 0]);
  near(u.subarray(12, 15), [0, 0, 0]);
  near(motion.displacement(0.5).subarray(3, 6), [0.5375, 0.075, 0]);
  near(motion.ofBlock(0, 1).mean, [1, 0, 0]);
  assert.equal(motion.timeAt(0.5), 0.25);
  assert.equal(motion.placeOfTime(0.25), 0.5);
});

test('motions of points are in units, one axis after the other', () => {
  const points = new Int16Array(2 * 3 * 12);
  points[36 + 2] = 7; // state 1, x of point 2
  points[36 + 12 + 2] = -9; // y
  const data = sampleData({ state_time: Float64Array.of(0, 1), state_step: Float64Array.of(0, 1), displacement_unit: Float32Array.of(1, 0.5), point_displacement: points });
  const motion = new Motion(readSurface(data.arrays), data.arrays);
  near(motion.displacement(1).subarray(6, 9), [3.5, -4.5, 0]);
});

test('a history is linear between its entries', () => {
  near(historyAt([0, 1, 3], [[0, 0, 0], [2, 0, 0], [4, 2, 0]], 2), [3, 1, 0]);
  near(historyAt([0, 1, 3], [[0, 0, 0], [2, 0, 0], [4, 2, 0]], 9), [4, 2, 0]);
});

test('fields have the values of blocks, and limits that hold them', () => {
  const data = sampleData(sampleMotion());
  const surface = readSurface(data.arrays);
  const motion = new Motion(surface, data.arrays);
  const fields = makeFields(data, surface, motion);
  const field = (key: string) => fields.find((f) => f.key === key)!;
  assert.deepEqual([...field('volume').values(0)], [1, 8]);
  assert.deepEqual(rangeOf(field('volume'), 2), [0, 8]);
  // A block that falls has nothing that resists: its factor is 0; of others there is none.
  assert.deepEqual([...field('factor_of_safety').values(0)], [0, NaN]);
  assert.ok(Number.isNaN(field('support_force').values(0)[1]!));
  const length = field('displacement').values(1);
  near(length, [Math.hypot(1.075, -0.05, 0)]);
  assert.equal(rangeOf(field('displacement'), 2)[0], 0);
  assert.ok(rangeOf(field('displacement'), 2)[1] >= Math.max(...length) - 1e-6);
});

test('von Mises of uniaxial stress and of shear', () => {
  assert.ok(Math.abs(vonMises([5, 0, 0, 0, 0, 0]) - 5) < 1e-12);
  assert.ok(Math.abs(vonMises([0, 0, 0, 2, 0, 0]) - 2 * Math.sqrt(3)) < 1e-12);
  assert.ok(vonMises([7, 7, 7, 0, 0, 0]) < 1e-12);
});

test('displacements are magnified by the largest of all states, not by what rounding leaves in the last', () => {
  const moved = (x: number): number[] => [x, ...new Array<number>(11).fill(0), ...new Array<number>(12).fill(0)];
  const of = (...states: number[]): number => {
    const data = sampleData({ state_time: Float64Array.from(states, (_, s) => s), state_step: Float64Array.from(states, (_, s) => s),
      block_middle: Float32Array.of(0.5, 0.75, 0.25, 4, 0.5, 2), block_motion: Float32Array.from(states.flatMap(moved)) });
    const surface = readSurface(data.arrays);
    return firstMagnification(surface, new Motion(surface, data.arrays));
  };
  assert.equal(of(0, 1e-3, 1e-17), of(0, 1e-3));
  assert.ok(of(0, 1e-3) > 10);
  assert.equal(of(0, 1e-17), 1);
  assert.equal(of(0, 1), 1);
});
