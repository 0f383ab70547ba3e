// The panel on the left: what is coloured, shown, cut and from where it is seen.
import type { Context } from '../context';
import type { ViewState } from '../view_state';
import { button, checkbox, choice, h, slider } from './dom';
import { digits, unitFor } from './format';
import { Stereonet } from './stereonet';

type Update = (state: ViewState) => void;

/// Azimuth and elevation (deg) of the eye as seen from the model.
export const views: Record<string, [number, number]> = {
  Plan: [-90, 89.9], North: [90, 0], East: [0, 0], South: [-90, 0], West: [180, 0], Slanted: [-42, 28],
};

export class Controls {
  readonly element: HTMLElement;
  private readonly updates: Update[] = [];

  constructor(private readonly context: Context, private readonly lookFrom: (azimuth: number, elevation: number) => void) {
    this.element = h('nav', { class: 'panel left', 'aria-label': 'view' },
      this.section('Colour', this.colour()), this.section('Blocks', this.blocks()), this.section('Section', this.clip()),
      this.section('Camera', this.cameras()),
      context.poles.length ? this.section('Joints', [...this.joints(), new Stereonet(context).element]) : null);
    const update = (): void => { for (const u of this.updates) u(context.store.state); };
    context.store.listen(update);
    update();
  }

  private section(title: string, rows: Node[]): HTMLElement {
    return h('details', { open: true }, h('summary', {}, title), ...rows);
  }

  private colour(): Node[] {
    const { store, fields } = this.context;
    const field = choice('By', fields.map((f) => [f.key, f.label]), store.state.field, (key) => store.set({ field: key, low: null, high: null }), 'field');
    const limit = (key: 'low' | 'high'): HTMLInputElement => {
      const input = h('input', { type: 'number', step: 'any', 'aria-label': `${key} end of the colours`, change: () => {
        const scale = this.scale();
        const x = Number(input.value);
        store.set({ [key]: input.value === '' || !Number.isFinite(x) ? null : x * scale });
      } });
      return input;
    };
    const low = limit('low');
    const high = limit('high');
    const unit = h('span', { class: 'unit' });
    const row = h('div', { class: 'limits' }, low, h('span', {}, 'to'), high, unit, button('auto', 'limits by the values', () => store.set({ low: null, high: null })));
    this.updates.push((s) => {
      field.select.value = s.field;
      const f = this.context.field();
      row.hidden = !!f.categories;
      const [a, b] = this.context.limits();
      const scale = this.scale();
      if (document.activeElement !== low) low.value = String(Number((a / scale).toPrecision(4)));
      if (document.activeElement !== high) high.value = String(Number((b / scale).toPrecision(4)));
      unit.textContent = unitFor(Math.max(Math.abs(a), Math.abs(b)), f.unit)[1];
    });
    return [field.row, row];
  }

  private scale(): number {
    const [a, b] = this.context.limits();
    return unitFor(Math.max(Math.abs(a), Math.abs(b)), this.context.field().unit)[0];
  }

  private blocks(): Node[] {
    const { store, data } = this.context;
    const rows: Node[] = [];
    const options: [string, string][] = [['all', 'all blocks'], ['finite', 'finite blocks']];
    if (data.arrays.has('class')) options.splice(1, 0, ['key', 'key blocks']);
    if (this.context.motion.states > 1) options.push(['moved', 'blocks that moved']);
    options.push(['chosen', 'isolated blocks']);
    const show = choice('Show', options, store.state.show, (v) => store.set({ show: v as ViewState['show'] }), 'show');
    const rest = choice('The others', [['ghost', 'as ghosts'], ['hidden', 'not at all']], store.state.rest, (v) => store.set({ rest: v as ViewState['rest'] }), 'rest');
    const opacity = this.slider('Opacity', 'opacity', 0.05, 1, 0.05, (x) => `${Math.round(100 * x)} %`);
    const explode = this.slider('Pull apart', 'explode', 0, 1.5, 0.01, (x) => `${Math.round(100 * x)} %`);
    rows.push(show.row, rest.row, opacity, explode);
    const stages = Math.max(0, ...new Set(data.arrays.get('stage')));
    if (stages > 0) rows.push(this.slider('Excavated', 'stage', 0, stages, 1, (x) => (x === 0 ? 'nothing' : `to stage ${x}`), stages));
    const edges = checkbox('Edges', true, (on) => store.set({ edges: on }));
    const texture = checkbox('Rock texture', true, (on) => store.set({ texture: on }));
    const symbols = checkbox('Symbols', true, (on) => store.set({ symbols: on }), 'monitors, bolts, loads, fixings');
    rows.push(h('div', { class: 'checks' }, edges.row, texture.row, symbols.row));
    const back = button('Show hidden blocks again', 'all of them', () => store.set({ hidden: [] }));
    rows.push(back);
    this.updates.push((s) => {
      show.select.value = s.show;
      rest.select.value = s.rest;
      rest.row.hidden = s.show === 'all';
      edges.box.checked = s.edges;
      texture.box.checked = s.texture;
      symbols.box.checked = s.symbols;
      back.hidden = s.hidden.length === 0;
    });
    return rows;
  }

  private slider(label: string, key: 'opacity' | 'explode' | 'stage', min: number, max: number, step: number, text: (x: number) => string, negative?: number): HTMLElement {
    const { store } = this.context;
    const s = slider({ label, min, max, step, value: store.state[key], id: key, input: (x) => store.set({ [key]: x }) });
    this.updates.push((state) => {
      const x = state[key] < 0 ? (negative ?? 0) : state[key];
      s.range.value = String(x);
      s.output.textContent = text(x);
    });
    return s.row;
  }

  private clip(): Node[] {
    const { store, surface, data } = this.context;
    return ['East', 'North', 'Up'].map((name, axis) => {
      const put = (change: Partial<{ on: boolean; at: number; flip: boolean }>): void => {
        const clip = store.state.clip.map((c) => ({ ...c })) as ViewState['clip'];
        clip[axis] = { ...clip[axis]!, ...change };
        store.set({ clip });
      };
      const letter = 'xyz'[axis]!;
      const on = checkbox(letter, false, (v) => put({ on: v }), `cut across ${name.toLowerCase()} (${axis + 1})`);
      on.box.id = `clip-${letter}`;
      const s = slider({ label: '', min: 0, max: 1, step: 0.002, value: 0.5, id: `clip-${letter}-at`, input: (x) => put({ on: true, at: x }) });
      const flip = button('⇄', 'keep the other side', () => put({ on: true, flip: !store.state.clip[axis]!.flip }));
      this.updates.push((state) => {
        const c = state.clip[axis]!;
        on.box.checked = c.on;
        s.range.value = String(c.at);
        s.output.textContent = `${digits(surface.low[axis]! + c.at * (surface.high[axis]! - surface.low[axis]!) + data.document.origin[axis]!, 3)} m`;
        flip.classList.toggle('chosen', c.on && c.flip);
      });
      return h('div', { class: 'clip' }, on.row, s.row, flip);
    });
  }

  private cameras(): Node[] {
    const { store } = this.context;
    const buttons = Object.entries(views).map(([name, [azimuth, elevation]]) =>
      button(name, name === 'Plan' || name === 'Slanted' ? `${name.toLowerCase()} view` : `from the ${name.toLowerCase()}`, () => this.lookFrom(azimuth, elevation)));
    const fly = checkbox('Fly through the model (G)', false, (on) => store.set({ fly: on }), 'W A S D, Q and E move, dragging looks around');
    fly.box.id = 'fly';
    this.updates.push((s) => { fly.box.checked = s.fly; });
    return [h('div', { class: 'buttons' }, ...buttons), fly.row];
  }

  private joints(): Node[] {
    const { store, data, poles } = this.context;
    const known = [...new Set(poles.map((p) => p.origin))];
    const joint = choice('Draw', [['-1', 'no joints'], ['-2', 'all joints'], ...known.slice(0, 200).map((o): [string, string] => [String(o), data.document.origins[o]!.name])],
      String(store.state.joint), (v) => store.set({ joint: Number(v) }), 'joint');
    this.updates.push((s) => { joint.select.value = String(s.joint); });
    return [joint.row];
  }
}
