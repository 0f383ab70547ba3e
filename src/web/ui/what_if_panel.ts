// Sliders for what the model could have been, and what follows from it at once.
import type { Context } from '../context';
import type { Knob, WhatIf } from '../block_theory/what_if';
import { button, h, slider } from './dom';
import { digits, quantity } from './format';

export class WhatIfPanel {
  readonly element: HTMLElement;
  private readonly updates: (() => void)[] = [];
  private readonly result = h('div', { class: 'what-if-result', 'aria-live': 'polite' });

  constructor(private readonly context: Context, private readonly whatIf: WhatIf) {
    const groups: HTMLElement[] = [];
    let last = '';
    whatIf.knobs.forEach((knob, i) => {
      if (knob.group === 'Water' && whatIf.waterReason) {
        groups.push(h('h3', {}, 'Water'), h('p', { class: 'note' }, whatIf.waterReason));
        return;
      }
      if (knob.group !== last) groups.push(h('h3', {}, knob.group));
      last = knob.group;
      groups.push(this.row(knob, i));
    });
    this.element = h('div', { class: 'what-if' },
      h('p', { class: 'note' }, 'Move a slider: block theory is done again at once for the blocks that move first, and colours and the table follow.'),
      this.result, ...groups,
      h('p', { class: 'note' }, 'Bolts, later batches, and blocks that fail together are computed by the program.'));
    context.store.listen((_, changed) => { if (changed.has('tried')) this.update(); });
    this.update();
  }

  private valueOf(i: number): number {
    const { tried } = this.context.store.state;
    for (let k = 0; k + 1 < tried.length; k += 2) if (tried[k] === i) return tried[k + 1]!;
    return this.whatIf.knobs[i]!.value;
  }

  private set(i: number, value: number): void {
    const knob = this.whatIf.knobs[i]!;
    const others = this.context.store.state.tried;
    const tried: number[] = [];
    for (let k = 0; k + 1 < others.length; k += 2) if (others[k] !== i) tried.push(others[k]!, others[k + 1]!);
    if (value !== knob.value) tried.push(i, value);
    this.context.store.set({ tried });
  }

  private row(knob: Knob, i: number): HTMLElement {
    const s = slider({ label: knob.label, min: knob.min, max: knob.max, step: 'any', value: knob.value, id: `knob-${i}`,
      input: (x) => this.set(i, snapped(x, knob)) });
    const back = button('↺', 'as in the model', () => this.set(i, knob.value));
    this.updates.push(() => {
      const x = this.valueOf(i);
      s.range.value = String(x);
      s.output.textContent = `${digits(x, 4)}${knob.unit === '°' ? '°' : knob.unit ? ` ${knob.unit}` : ''}`;
      const same = x === knob.value;
      back.style.visibility = same ? 'hidden' : 'visible';
      s.output.classList.toggle('changed', !same);
    });
    return h('div', { class: 'knob' }, s.row, back);
  }

  private update(): void {
    for (const u of this.updates) u();
    this.result.replaceChildren(...(this.whatIf.active ? this.told() : [h('p', {}, 'All is as in the model.')]));
  }

  private told(): Node[] {
    const { outcome } = this.whatIf;
    const now = this.whatIf.summary();
    const was = this.context.support.keyblocks?.filter((k) => k.batch === 1) ?? [];
    const facts: [string, string, string][] = [
      ['Blocks that move first', String(now.blocks), String(was.length)],
      ['Volume', `${digits(now.volume)} m³`, `${digits(was.reduce((sum, k) => sum + k.volume, 0))} m³`],
      ['Support force', quantity(now.force, 'N'), quantity(was.reduce((sum, k) => sum + k.support_force, 0), 'N')],
      ['Least factor of safety', now.least === null ? '–' : digits(now.least, 3), was.length === 0 ? '–' : digits(Math.min(...was.map((k) => k.factor_of_safety ?? 0)), 3)],
    ];
    const copy = button('Copy the command', this.whatIf.command(), () => {
      void navigator.clipboard?.writeText(this.whatIf.command()).then(() => { copy.textContent = 'Copied'; setTimeout(() => { copy.textContent = 'Copy the command'; }, 1200); });
    });
    return [
      h('table', {}, h('thead', {}, h('tr', {}, h('th', {}, ''), h('th', {}, 'now'), h('th', {}, 'model'))),
        h('tbody', {}, ...facts.map(([name, a, b]) => h('tr', {}, h('td', {}, name), h('td', { class: 'number' }, a), h('td', { class: 'number' }, b))))),
      ...(outcome!.groups ? [h('p', { class: 'note' }, 'No block moves alone at some stage. Whether several fail together, and what follows, is computed by the program.')] : []),
      ...(outcome!.byProgram.size > 0 ? [h('p', { class: 'note' }, `${outcome!.byProgram.size} blocks next to ones that moved at an earlier stage: by the program.`)] : []),
      h('div', { class: 'row' }, button('As in the model', 'all sliders back', () => this.context.store.set({ tried: [] }), { id: 'what-if-reset' }), copy),
      h('pre', { class: 'command' }, this.whatIf.command()),
    ];
  }
}

/// Round numbers of the knob's step; the model's own value where it is near.
function snapped(x: number, knob: Knob): number {
  if (Math.abs(x - knob.value) < 0.6 * knob.step) return knob.value;
  return Number((Math.round(x / knob.step) * knob.step).toPrecision(5));
}
