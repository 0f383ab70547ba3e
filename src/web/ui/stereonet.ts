// Poles of the joints on an equal-area net of the lower hemisphere, linked with the model: a pressed pole or great
// circle shows its joints in space.
import { toHex } from '../colour';
import type { Context } from '../context';
import { originColours, type Pole } from '../fields';
import { h, svg } from './dom';
import { dipText } from './format';

const r = 100;

/// Where a direction with z ≤ 0 lies on the net, north up; equal area (Schmidt, Lambert).
export function project([x, y, z]: [number, number, number]): [number, number] {
  const s = Math.sqrt(1 / (1 + Math.min(1, Math.abs(z))));
  return [r * x * s, -r * y * s];
}

/// The great circle of a plane with this upward normal, from one end of its strike over its dip to the other.
export function greatCircle(normal: [number, number, number]): [number, number][] {
  const [x, y, z] = normal;
  const flat = Math.hypot(x, y);
  const strike: [number, number, number] = flat > 1e-9 ? [-y / flat, x / flat, 0] : [1, 0, 0];
  const dip: [number, number, number] = flat > 1e-9 ? [(x / flat) * z, (y / flat) * z, -flat] : [0, 1, 0];
  const points: [number, number][] = [];
  for (let i = 0; i <= 48; ++i) {
    const a = (Math.PI * i) / 48;
    points.push(project([0, 1, 2].map((d) => Math.cos(a) * strike[d]! + Math.sin(a) * dip[d]!) as [number, number, number]));
  }
  return points;
}

/// The mean plane of a set, weighted by area.
export function meanNormal(poles: Pole[]): [number, number, number] {
  const sum: [number, number, number] = [0, 0, 0];
  for (const { normal, area } of poles) {
    const sign = normal[0] * sum[0] + normal[1] * sum[1] + normal[2] * sum[2] < 0 ? -1 : 1;
    for (let d = 0; d < 3; ++d) sum[d] = sum[d]! + sign * area * normal[d]!;
  }
  const length = Math.hypot(...sum) * (sum[2] < 0 ? -1 : 1) || 1;
  return sum.map((x) => x / length) as [number, number, number];
}

const mostPoles = 2000; // beyond them the largest by area

export class Stereonet {
  readonly element: HTMLElement;
  private readonly marks = new Map<number, Element[]>();

  constructor(private readonly context: Context) {
    const sets = new Map<number, Pole[]>();
    for (const pole of context.poles) sets.set(pole.origin, [...(sets.get(pole.origin) ?? []), pole]);
    const net = svg('svg', { viewBox: '-118 -118 236 236', class: 'stereonet', role: 'img', 'aria-label': 'stereonet of the joints' },
      svg('circle', { r, class: 'net' }), svg('path', { d: 'M-4,0H4M0,-4V4', class: 'axis' }),
      ...[['N', 0, -r - 5], ['S', 0, r + 13], ['E', r + 9, 4], ['W', -r - 9, 4]].map(([t, x, y]) =>
        svg('text', { x: x!, y: y!, 'text-anchor': 'middle' }, String(t))));
    const rows: Node[] = [];
    const colours = originColours(context.data).map(toHex);
    for (const [origin, poles] of sets) this.addSet(origin, poles, colours[origin]!, net, rows);
    this.element = h('div', { class: 'stereonet-box' }, net, h('div', { class: 'sets' }, ...rows),
      h('p', { class: 'note' }, 'Poles and mean planes; equal area, lower hemisphere. Press one to see its joints.'));
    context.store.listen((_, changed) => { if (changed.has('joint')) this.mark(); });
    this.mark();
  }

  private addSet(origin: number, poles: Pole[], colour: string, net: SVGSVGElement, rows: Node[]): void {
    const name = this.context.data.document.origins[origin]!.name;
    const mean = meanNormal(poles);
    const press = (): void => this.press(origin);
    const marks: Element[] = [];
    const tip = `${name}: ${dipText(mean)}`;
    // An origin of many planes that point everywhere (a network of triangles) has no mean to show.
    const spread = poles.reduce((s, p) => s + p.area * Math.abs(p.normal[0] * mean[0] + p.normal[1] * mean[1] + p.normal[2] * mean[2]), 0) /
      poles.reduce((s, p) => s + p.area, 0);
    if (spread > 0.8)
      marks.push(svg('polyline', { points: greatCircle(mean).map((p) => p.map((x) => x.toFixed(1)).join()).join(' '), class: 'circle', stroke: colour, click: press },
        svg('title', {}, tip)));
    for (const pole of poles.slice(0, Math.max(1, Math.floor(mostPoles / Math.max(1, this.context.poles.length / poles.length))))) {
      const [x, y] = project(pole.normal.map((n) => -n) as [number, number, number]);
      marks.push(svg('circle', { cx: x.toFixed(1), cy: y.toFixed(1), r: poles.length > 50 ? 2.2 : 4, fill: colour, class: 'pole', click: press },
        svg('title', {}, `${name}: ${dipText(pole.normal)}`)));
    }
    net.append(...marks);
    const row = h('button', { type: 'button', class: 'set', title: 'show its joints', click: press },
      h('i', { style: `background:${colour}` }), h('span', {}, name), h('b', {}, spread > 0.8 ? dipText(mean) : 'scattered'));
    rows.push(row);
    this.marks.set(origin, [...marks, row]);
  }

  private press(origin: number): void {
    const { store } = this.context;
    if (store.state.joint === origin) store.set({ joint: -1, opacity: 1 });
    else store.set({ joint: origin, opacity: Math.min(store.state.opacity, 0.15) });
  }

  private mark(): void {
    const { joint } = this.context.store.state;
    for (const [origin, marks] of this.marks)
      for (const mark of marks) mark.classList.toggle('chosen', joint === origin);
  }
}
