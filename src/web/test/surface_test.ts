import assert from 'node:assert/strict';
import { test } from 'node:test';
import { poles } from '../fields';
import { sectionLines } from '../scene/section';
import { edgeLengths, radius, readSurface } from '../scene/surface';
import { sampleData } from './sample';

test('polygons become triangles whose diagonals are no edges', () => {
  const s = readSurface(sampleData().arrays);
  assert.deepEqual([...s.triangleBegin], [0, 4, 16]);
  assert.equal(s.corner.length, 3 * 16);
  assert.equal(s.corner[0]! & 7, 7); // a triangle's own sides
  assert.equal(s.corner[3 * 4]! & 7, 3); // 0 3 2: the side from 2 back to 0 is a diagonal
  assert.equal(s.corner[3 * 5]! & 7, 6); // 0 2 1: the side from 0 to 2 is one
  assert.equal(s.corner[3 * 4]! >>> 3, 4); // points of the second block come after those of the first
  assert.deepEqual(s.low, [0, 0, 0]);
  assert.deepEqual(s.high, [5, 3, 4]);
  assert.equal(radius(s), Math.hypot(5, 3, 4) / 2);
});

test('edges have each a length on both of their faces, diagonals none', () => {
  const [wedge, slab] = edgeLengths(readSurface(sampleData().arrays));
  assert.ok(Math.abs(wedge! - 2 * (2 + 3 + 1 + Math.sqrt(13) + Math.sqrt(5) + Math.sqrt(10))) < 1e-5);
  assert.ok(Math.abs(slab! - 2 * 4 * (2 + 1 + 4)) < 1e-5);
});

test('the section of a box is its outline', () => {
  const s = readSurface(sampleData().arrays);
  const plane = { normal: [0, 0, 1] as [number, number, number], distance: 2 };
  const lengthOf = (lines: Float32Array): number => {
    let sum = 0;
    for (let i = 0; i < lines.length; i += 6) sum += Math.hypot(lines[i]! - lines[i + 3]!, lines[i + 1]! - lines[i + 4]!, lines[i + 2]! - lines[i + 5]!);
    return sum;
  };
  const all = sectionLines(s, s.point, plane, () => true);
  assert.ok(Math.abs(lengthOf(all) - 6) < 1e-6); // 2 × (2 + 1): the wedge is lower
  for (let i = 2; i < all.length; i += 3) assert.equal(all[i], 2);
  for (let i = 0; i < all.length; i += 6) { // counter-clockwise about its middle (4, 0.5)
    const [x, y, dx, dy] = [all[i]! - 4, all[i + 1]! - 0.5, all[i + 3]! - all[i]!, all[i + 4]! - all[i + 1]!];
    assert.ok(x * dy - y * dx > 0);
  }
  assert.equal(sectionLines(s, s.point, plane, (b) => b === 0).length, 0);
});

test('poles are those of joints alone, upward, with their area', () => {
  const data = sampleData();
  const list = poles(readSurface(data.arrays), data);
  assert.ok(list.every((p) => p.origin === 0 && p.normal[2] >= -1e-9));
  // Joint faces: z = 0 (3 m²) and y = 0 (1 m²) of the wedge, x = 5 and y = 1 of the slab (4 and 8 m²); each side counts half.
  const area = list.reduce((sum, p) => sum + p.area, 0);
  assert.ok(Math.abs(area - (3 + 1 + 4 + 8) / 2) < 1e-6, `${area}`);
});
