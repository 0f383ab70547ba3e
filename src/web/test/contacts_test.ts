import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Contacts } from '../contacts';
import { makeFields } from '../fields';
import { Motion } from '../motion';
import { readSurface } from '../scene/surface';
import { blockFlags } from '../visibility';
import { initialState } from '../view_state';
import { sampleData, sampleMotion } from './sample';

/// One point in the first state, two in the second: the wedge's corner (2, 0, 0), which has gone to (3.075, 0.15, 0), and one of the slab.
const points = {
  contact_count: Uint32Array.of(1, 2),
  contact_place: Float32Array.of(2, 0, 0, 3.075, 0.15, 0, 3, 0, 0),
  contact_block: Uint32Array.of(4, 4, 9),
  contact_joint: Uint16Array.of(1, 1, 0),
  contact_state: Uint8Array.of(1, 2, 0),
  contact_normal: Uint16Array.of(0, 1000, 500),
  contact_normal_range: Float32Array.of(-2e6, 0),
  contact_slip: Uint16Array.of(0, 1000, 250),
  contact_slip_range: Float32Array.of(0, 0.2),
};

function sample(): { fields: ReturnType<typeof makeFields>; contacts: Contacts } {
  const data = sampleData({ ...sampleMotion(), ...points });
  const surface = readSurface(data.arrays);
  const motion = new Motion(surface, data.arrays);
  return { fields: makeFields(data, surface, motion), contacts: Contacts.read(data.arrays, surface, motion)! };
}

test('contact points have the values of the nearer stored state', () => {
  const { fields } = sample();
  const field = (key: string) => fields.find((f) => f.key === key)!;
  assert.deepEqual([...field('contact_state').values(0.4)], [1]);
  assert.deepEqual([...field('contact_state').values(0.6)], [2, 0]);
  assert.deepEqual([...field('contact_slip').values(1)].map((v) => Number(v.toFixed(6))), [0.2, 0.05]);
  const normal = [...field('contact_normal').values(1)];
  assert.equal(normal[0], 0);
  assert.ok(Number.isNaN(normal[1]), 'an open point bears nothing');
  assert.ok(!fields.some((f) => f.key === 'contact_gap'), 'what the result lacks is not offered');
});

test('one joint alone is shown where it is chosen', () => {
  const { contacts } = sample();
  assert.deepEqual(contacts.shown(1, 0), [true, false]); // the second point belongs to faces that met
  assert.deepEqual(contacts.shown(1, -1), [true, true]);
});

test('contact points are drawn with their block, whose displacement is magnified', () => {
  const { contacts } = sample();
  const near = (found: Float32Array, wanted: number[]): void => wanted.forEach((v, i) => assert.ok(Math.abs(found[i]! - v) < 1e-5, `${[...found]}`));
  near(contacts.positions(1, 1, () => [0, 0, 0]), [3.075, 0.15, 0, 3, 0, 0]);
  // Twice the way from (2, 0, 0); the slab stays, and is pulled aside by 5.
  near(contacts.positions(1, 2, (b) => [5 * b, 0, 0]), [4.15, 0.3, 0, 8, 0, 0]);
});

test('blocks that moved are those displaced by more than a hundredth of their size', () => {
  const data = sampleData(sampleMotion());
  const surface = readSurface(data.arrays);
  const motion = new Motion(surface, data.arrays);
  const volume = data.arrays.get('volume');
  assert.deepEqual([...motion.moved(0, volume)], [0, 0]);
  assert.deepEqual([...motion.moved(0.02, volume)], [1, 0]); // 0.02 m of 1 m
  assert.deepEqual([...motion.moved(0.005, volume)], [0, 0]);
  const flags = blockFlags({ ...initialState(), stage: 0, show: 'moved', rest: 'hidden' }, surface, data.arrays, { moved: motion.moved(1, volume) });
  assert.deepEqual([...flags], [0, 1]);
});
