// A page read without a browser, and random settings of its sliders.
import { Arrays, fromBase64, inflated, type NumberArray, type PageDocument, unshuffled } from '../data';
import { readSurface } from '../scene/surface';
import { type Knob, WhatIf } from '../block_theory/what_if';

export async function whatIfOf(html: string): Promise<WhatIf> {
  const element = (id: string): string => new RegExp(`id="${id}">(.*?)</script>`, 's').exec(html)![1]!;
  const document = JSON.parse(element('document')) as PageDocument;
  const arrays = new Map<string, NumberArray>();
  for (const entry of document.arrays) arrays.set(entry.name, unshuffled(await inflated(fromBase64(element(`array-${entry.name}`))), entry));
  const data = { document, arrays: new Arrays(arrays) };
  return WhatIf.of(data, readSurface(data.arrays))!;
}

/// Numbers and values as WhatIf.apply takes them: some three of five knobs moved, each to anywhere in its range.
export function randomTries(knobs: Knob[], seed: number, count: number): number[][] {
  let state = seed >>> 0;
  const random = (): number => { // a linear congruential generator (Numerical Recipes)
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
  return Array.from({ length: count }, () => {
    const tried: number[] = [];
    knobs.forEach((knob, i) => {
      const [moved, place] = [random() < 0.6, random()];
      if (moved) tried.push(i, Number((knob.min + place * (knob.max - knob.min)).toPrecision(5)));
    });
    return tried.length > 0 ? tried : [0, knobs[0]!.min];
  });
}
