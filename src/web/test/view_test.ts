import assert from 'node:assert/strict';
import { test } from 'node:test';
import { makeFields, paintMaterials, repainted } from '../fields';
import { Motion } from '../motion';
import { readSurface } from '../scene/surface';
import { digits, dipText, niceStep, quantity, reductionText, stabilityText, ticks, unitFor } from '../ui/format';
import { greatCircle, meanNormal, project } from '../ui/stereonet';
import { thinned } from '../ui/plots';
import { blockFlags } from '../visibility';
import { decodeState, encodeState, initialState } from '../view_state';
import { sampleData } from './sample';

test('a view comes back from its address', () => {
  const state = { ...initialState(), field: 'factor_of_safety', paint: '_c0c0c0', at: 2.5, selected: 12, hidden: [3, 4], edges: false, low: -1.5, fly: true,
    camera: [1, -2.25, 3, 0, 0, 0.125], clip: [{ on: true, at: 0.25, flip: true }, { on: false, at: 0.5, flip: false }, { on: true, at: 1, flip: false }] } as ReturnType<typeof initialState>;
  assert.deepEqual(decodeState('#' + encodeState(state)), state);
  assert.equal(encodeState(initialState()), '');
});

test('nonsense in an address is passed over', () => {
  const state = decodeState('#at=x&show=everything&clip=a_b&selected=7&__proto__=1&field=%E0%A4%A&camera=1_2&theme=dark');
  assert.deepEqual(state, { ...initialState(), selected: 7, camera: [1, 2], theme: 'dark' });
});

test('materials are painted as the view says, and have their own colours again', () => {
  const data = sampleData();
  const surface = readSurface(data.arrays);
  const fields = makeFields(data, surface, new Motion(surface, data.arrays));
  const colours = (paint: string): number[][] => {
    paintMaterials(fields, paint);
    return fields.find((f) => f.key === 'material')!.categories!.map((c) => [...c.colour]);
  };
  const own = colours('');
  assert.equal(repainted('', 1, '#ff0000'), '_ff0000');
  assert.deepEqual(colours('_ff0000'), [own[0], [1, 0, 0]]);
  assert.deepEqual(colours('red_#ff000'), own);
});

test('flags: stages, filters, hidden and picked blocks', () => {
  const data = sampleData();
  const surface = readSurface(data.arrays);
  const flags = (change: object): number[] => [...blockFlags({ ...initialState(), ...change }, surface, data.arrays)];
  assert.deepEqual(flags({}), [0, 1]); // the second goes at stage 2
  assert.deepEqual(flags({ stage: 1 }), [0, 0]);
  assert.deepEqual(flags({ stage: 0, show: 'key' }), [0, 2]);
  assert.deepEqual(flags({ stage: 0, show: 'key', rest: 'hidden' }), [0, 1]);
  assert.deepEqual(flags({ stage: 0, opacity: 0.5, selected: 9 }), [2, 4]);
  assert.deepEqual(flags({ stage: 0, hidden: [4] }), [1, 0]);
  assert.deepEqual(flags({ stage: 0, show: 'chosen', chosen: [9] }), [2, 0]);
});

test('numbers and units', () => {
  assert.deepEqual(unitFor(2.5e6, 'Pa'), [1e6, 'MPa']);
  assert.deepEqual(unitFor(0.004, 'm'), [1e-3, 'mm']);
  assert.deepEqual(unitFor(0, 'N'), [1, 'N']);
  assert.equal(quantity(129700, 'N'), '129.7 kN');
  assert.equal(quantity(null, 'N'), '–');
  assert.equal(digits(-12345), '−12 345');
  assert.equal(niceStep(10, 4), 5);
  assert.deepEqual(ticks(0, 1, 5), [0, 0.2, 0.4, 0.6, 0.8, 1]);
  assert.deepEqual(ticks(-49.84, 49.34, 4), [-40, -20, 0, 20, 40]); // steps of 50 would leave 0 alone
  assert.equal(dipText([Math.sin(0.5), 0, Math.cos(0.5)]), '29°/090°');
});

test('the net: vertical lines at the rim, the mean of a set, circles through its dip', () => {
  assert.deepEqual(project([0, 1, 0]).map(Math.round), [0, -100]);
  assert.deepEqual(project([0, 0, -1]).map((x) => Math.round(x) + 0), [0, 0]);
  const mean = meanNormal([{ origin: 0, normal: [0.1, 0, 0.995], area: 1 }, { origin: 0, normal: [-0.1, 0, 0.995], area: 1 }]);
  assert.ok(Math.abs(mean[0]) < 1e-9 && mean[2] > 0.999);
  const circle = greatCircle([Math.SQRT1_2, 0, Math.SQRT1_2]); // dips 45° to the east
  const [x, y] = circle[24]!;
  assert.ok(Math.abs(y) < 1e-9 && Math.abs(x - 100 * Math.sqrt(2) * Math.sin(((90 - 45) / 2) * (Math.PI / 180))) < 1e-6);
});

test('long curves keep their peaks', () => {
  const time = Array.from({ length: 10000 }, (_, i) => i);
  const values = time.map((t) => (t === 4321 ? 50 : Math.sin(t)));
  const thin = thinned(time, values, 0, 9999, 100);
  assert.ok(thin.length <= 200 && thin.some(([t, v]) => t === 4321 && v === 50));
});

test('what limit analysis found of the whole mass is said, with whose motion the arrows show', () => {
  const moving = [{ block: 3, velocity: [0, 0, -1] as [number, number, number] }];
  const bound = { factor: 1.2, mechanism: moving };
  const in_words = 'stands: factor of safety 1.05: block 3 slides on bed';
  const found = stabilityText({ in_words, bound, sliding: { factor: 1.0512, answer: 'fails', mechanism: moving } });
  assert.equal(found.factor, 'Whole mass: factor of safety 1.051');
  assert.equal(found.more, 'By limit analysis: stands: factor of safety 1.05: block 3 slides on bed. Arrows: how fast blocks move, beside each other.');
  const none = { factor: null, mechanism: [] };
  assert.equal(stabilityText({ in_words, bound, sliding: { ...none, answer: 'not found' } }).factor, 'Whole mass: factor of safety at most 1.2');
  assert.equal(stabilityText({ in_words, bound: none, sliding: { ...none, answer: 'stands' } }).factor, 'Whole mass: stands at any strength');
  assert.equal(stabilityText({ in_words, bound, sliding: { factor: 0, answer: 'falls', mechanism: moving } }).factor, 'Whole mass: fails at any strength');
});

test('what a strength reduction found is said with what it bounds', () => {
  const found = reductionText({ factor: 1.2862, stands: 1.281, fails: 1.2914, shown: 1.2914, blocks: [3, 4] });
  assert.equal(found.factor, 'Factor of safety 1.286');
  assert.equal(found.more, 'By strength reduction: the mass stands at 1.281, fails at 1.291 (2 blocks). The motion shown is that with tan(friction) and cohesion divided by 1.291.');
  assert.equal(reductionText({ factor: null, stands: 5, fails: null, shown: 5, blocks: [] }).factor, 'Factor of safety at least 5');
  assert.equal(reductionText({ factor: null, stands: null, fails: 0.2, shown: 0.2, blocks: [1] }).factor, 'Factor of safety below 0.2');
});
