import assert from 'node:assert/strict';
import { test } from 'node:test';
import { lchToRgb, mapColour, materialColour, rgbToOklab, type Rgb } from '../colour';

const distance = (a: number[], b: number[]): number => Math.hypot(...a.map((x, i) => x - b[i]!));

/// What eyes without one kind of cones see (Viénot, Brettel & Mollon 1999), in linear light.
function colourBlind(rgb: Rgb, kind: 'protan' | 'deutan'): Rgb {
  const [r, g, b] = rgb.map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4)) as Rgb;
  const m = kind === 'protan'
    ? [[0.11238, 0.88762, 0], [0.11238, 0.88762, 0], [0.00401, -0.00401, 1]]
    : [[0.29275, 0.70725, 0], [0.29275, 0.70725, 0], [-0.02234, 0.02234, 1]];
  return m.map((row) => {
    const c = Math.min(1, Math.max(0, row[0]! * r + row[1]! * g + row[2]! * b));
    return c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055;
  }) as Rgb;
}

test('OKLab and back', () => {
  const lab = rgbToOklab(lchToRgb([0.6, 0.1, 200]));
  assert.ok(distance(lab, [0.6, 0.1 * Math.cos((200 * Math.PI) / 180), 0.1 * Math.sin((200 * Math.PI) / 180)]) < 1e-4);
});

test('the sequential map rises evenly in lightness, for colour-blind eyes too', () => {
  for (const see of [(c: Rgb) => c, (c: Rgb) => colourBlind(c, 'protan'), (c: Rgb) => colourBlind(c, 'deutan')]) {
    const lightness = Array.from({ length: 33 }, (_, i) => rgbToOklab(see(mapColour('sequential', i / 32)))[0]);
    for (let i = 1; i < 33; ++i) {
      const step = lightness[i]! - lightness[i - 1]!;
      assert.ok(step > 0.008 && step < 0.034, `step ${i}: ${step}`);
    }
  }
});

test('steps of the sequential map look alike in size', () => {
  const steps: number[] = [];
  for (let i = 0; i < 16; ++i)
    steps.push(distance(rgbToOklab(mapColour('sequential', i / 16)), rgbToOklab(mapColour('sequential', (i + 1) / 16))));
  assert.ok(Math.max(...steps) / Math.min(...steps) < 2.2, steps.map((s) => s.toFixed(3)).join(' '));
});

test('the two arms of the diverging map differ for every eye', () => {
  for (const see of [(c: Rgb) => c, (c: Rgb) => colourBlind(c, 'protan'), (c: Rgb) => colourBlind(c, 'deutan')])
    for (const share of [0, 0.1, 0.2, 0.3])
      assert.ok(distance(rgbToOklab(see(mapColour('diverging', share))), rgbToOklab(see(mapColour('diverging', 1 - share)))) > 0.1, `at ${share}`);
});

test('colours of eight materials differ for every eye', () => {
  for (const see of [(c: Rgb) => c, (c: Rgb) => colourBlind(c, 'protan'), (c: Rgb) => colourBlind(c, 'deutan')])
    for (let i = 0; i < 8; ++i)
      for (let j = 0; j < i; ++j)
        assert.ok(distance(rgbToOklab(see(materialColour(i))), rgbToOklab(see(materialColour(j)))) > 0.11, `${i} and ${j}`);
});
