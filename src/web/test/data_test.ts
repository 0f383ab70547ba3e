import assert from 'node:assert/strict';
import { test } from 'node:test';
import { deflateSync } from 'node:zlib';
import { fromBase64, inflated, unshuffled } from '../data';

test('numbers come back from shuffled, deflated base64', async () => {
  const numbers = Float32Array.of(1.5, -2.25, 1e-20, NaN, 12345.678);
  const bytes = new Uint8Array(numbers.buffer);
  const shuffled = new Uint8Array(bytes.length);
  for (let i = 0; i < numbers.length; ++i) for (let k = 0; k < 4; ++k) shuffled[k * numbers.length + i] = bytes[4 * i + k]!;
  const text = deflateSync(shuffled).toString('base64');
  const read = unshuffled(await inflated(fromBase64(text)), { name: 'x', type: 'float32', count: 5 });
  assert.deepEqual([...read], [...numbers]);
});

test('differences are summed, past the ends of their type', () => {
  // 40000 − 0, 10 − 40000 modulo 65536
  const differences = Uint16Array.of(40000, 25546);
  const b = new Uint8Array(differences.buffer);
  const read = unshuffled(Uint8Array.of(b[0]!, b[2]!, b[1]!, b[3]!), { name: 'x', type: 'uint16', count: 2, differences: true });
  assert.deepEqual([...read], [40000, 10]);
});

test('an array that is cut short is refused by its name', () => {
  assert.throws(() => unshuffled(new Uint8Array(7), { name: 'volume', type: 'float64', count: 1 }), /volume is cut short/);
});
