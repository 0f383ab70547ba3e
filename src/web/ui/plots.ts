// Monitors and energies over time, with the time that the picture shows.
import { categoryColour, toHex } from '../colour';
import type { Context } from '../context';
import { contactNames } from '../contacts';
import type { Monitor } from '../data';
import { choice, h, svg } from './dom';
import { digits, quantity, ticks, unitFor } from './format';

export interface Curve {
  name: string;
  values: number[];
}

export interface Series {
  title: string;
  unit: string;
  time: number[];
  curves: Curve[];
}

const size = { width: 330, height: 170, left: 46, right: 8, top: 8, bottom: 24 };

const quantities: { key: string; name: string; unit: string; of: (m: Monitor) => number[] | undefined }[] = [
  { key: 'length', name: 'displacement', unit: 'm', of: (m) => m.displacement?.map((u) => Math.hypot(...u)) },
  { key: 'x', name: 'displacement to the east', unit: 'm', of: (m) => m.displacement?.map((u) => u[0]!) },
  { key: 'y', name: 'displacement to the north', unit: 'm', of: (m) => m.displacement?.map((u) => u[1]!) },
  { key: 'z', name: 'displacement upwards', unit: 'm', of: (m) => m.displacement?.map((u) => u[2]!) },
  { key: 'v', name: 'velocity', unit: 'm/s', of: (m) => m.velocity?.map((v) => Math.hypot(...v)) },
  { key: 'mises', name: 'von Mises stress', unit: 'Pa', of: (m) => m.von_mises },
  { key: 's1', name: 'σ₁', unit: 'Pa', of: (m) => m.principal_stress?.map((s) => s[0]!) },
  { key: 's3', name: 'σ₃', unit: 'Pa', of: (m) => m.principal_stress?.map((s) => s[2]!) },
  { key: 'ratio', name: 'strength over stress', unit: '', of: (m) => m.strength_ratio },
  { key: 'normal', name: 'normal stress of the joint', unit: 'Pa', of: (m) => m.normal_stress },
  { key: 'shear', name: 'shear stress of the joint', unit: 'Pa', of: (m) => m.shear_stress },
  { key: 'opening', name: 'opening of the joint', unit: 'm', of: (m) => m.opening },
  { key: 'slip', name: 'slip of the joint', unit: 'm', of: (m) => m.slip },
];

function monitorSeries(monitors: Monitor[], key: string): Series | null {
  const wanted = quantities.find((q) => q.key === key)!;
  const curves = monitors.flatMap((m) => {
    const values = wanted.of(m);
    return values && values.length === m.time.length ? [{ name: m.name, values }] : [];
  });
  return curves.length ? { title: `Monitors: ${wanted.name}`, unit: wanted.unit, time: monitors[0]!.time, curves } : null;
}

function energySeries(history: Record<string, number[]>): Series | null {
  const time = history.time;
  if (!time || time.length < 2) return null;
  // What never differs from zero beside the others only takes room.
  const peaks = Object.entries(history).filter(([name]) => name !== 'time')
    .map(([name, values]) => ({ name, values, peak: Math.max(...values.map(Math.abs)) }));
  const most = Math.max(...peaks.map((p) => p.peak));
  const curves = peaks.filter((p) => p.peak > 1e-6 * most);
  return curves.length ? { title: 'Energy', unit: 'J', time, curves } : null;
}

/// How many contact points are open, stick and slide.
function contactSeries(history: Record<string, number[]>): Series | null {
  const { time } = history;
  if (!time || time.length < 2) return null;
  return { title: 'Contact points', unit: '', time, curves: contactNames.map((name) => ({ name, values: history[name] ?? [] })) };
}

/// Curves of more points than pixels are drawn as the least and greatest of each pixel.
export function thinned(time: number[], values: number[], low: number, high: number, columns: number): [number, number][] {
  if (values.length <= 2 * columns) return values.map((v, i) => [time[i]!, v]);
  const out: [number, number][] = [];
  let i = 0;
  for (let c = 0; c < columns; ++c) {
    const end = low + ((c + 1) / columns) * (high - low);
    let least = -1;
    let greatest = -1;
    for (; i < values.length && (time[i]! <= end || c === columns - 1); ++i) {
      if (least < 0 || values[i]! < values[least]!) least = i;
      if (greatest < 0 || values[i]! > values[greatest]!) greatest = i;
    }
    if (least >= 0) for (const k of new Set([Math.min(least, greatest), Math.max(least, greatest)])) out.push([time[k]!, values[k]!]);
  }
  return out;
}

/// One plot; a press on it goes to that time.
class Plot {
  readonly element: HTMLElement;
  private readonly cursor = svg('line', { class: 'cursor', y1: size.top, y2: size.height - size.bottom });
  private readonly dots: SVGCircleElement[];
  private readonly readouts: HTMLElement[];
  private readonly x: (t: number) => number;
  private readonly y: (v: number) => number;

  constructor(private readonly series: Series, seek: (time: number) => void) {
    const { time, curves, unit } = series;
    const [t0, t1] = [time[0]!, time[time.length - 1]!];
    const all = curves.flatMap((c) => c.values).filter(Number.isFinite);
    let [low, high] = all.reduce(([a, b], v) => [Math.min(a, v), Math.max(b, v)], [0, 0]);
    if (!(high > low)) high = low + 1;
    const [factor, name] = unitFor(Math.max(-low, high), unit);
    this.x = (t) => size.left + ((t - t0) / (t1 - t0 || 1)) * (size.width - size.left - size.right);
    this.y = (v) => size.top + ((high - v) / (high - low)) * (size.height - size.top - size.bottom);
    const drawing = svg('svg', { viewBox: `0 0 ${size.width} ${size.height}`, class: 'plot', role: 'img', 'aria-label': series.title,
      pointerdown: (e: PointerEvent) => { drawing.setPointerCapture(e.pointerId); go(e); },
      pointermove: (e: PointerEvent) => { if (e.buttons & 1) go(e); } });
    const go = (e: PointerEvent): void => {
      const box = drawing.getBoundingClientRect();
      const px = ((e.clientX - box.left) / box.width) * size.width;
      seek(t0 + ((px - size.left) / (size.width - size.left - size.right)) * (t1 - t0));
    };
    drawing.append(...this.axes(low / factor, high / factor, factor, t0, t1));
    this.dots = [];
    curves.forEach((curve, i) => {
      const colour = toHex(categoryColour(curveColour(i)));
      const path = thinned(time, curve.values, t0, t1, size.width).map(([t, v]) => `${this.x(t).toFixed(1)},${this.y(v).toFixed(1)}`);
      drawing.append(svg('polyline', { points: path.join(' '), class: 'curve', stroke: colour }));
      this.dots.push(svg('circle', { r: 3.2, fill: colour, class: 'dot' }));
    });
    drawing.append(this.cursor, ...this.dots);
    this.readouts = curves.map(() => h('b', {}));
    const keys = curves.map((curve, i) => h('span', { class: 'key' },
      h('i', { style: `background:${toHex(categoryColour(curveColour(i)))}` }), curve.name, ' ', this.readouts[i]!));
    this.element = h('section', {}, h('h3', {}, name ? `${series.title}, ${name}` : series.title), drawing, h('div', { class: 'plot-keys' }, ...keys));
  }

  private axes(low: number, high: number, factor: number, t0: number, t1: number): SVGElement[] {
    const out: SVGElement[] = [];
    const bottom = size.height - size.bottom;
    for (const v of ticks(low, high, 4)) {
      const y = this.y(v * factor);
      out.push(svg('line', { x1: size.left, x2: size.width - size.right, y1: y, y2: y, class: 'grid' }),
        svg('text', { x: size.left - 5, y: y + 3.5, 'text-anchor': 'end' }, digits(v, 3)));
    }
    for (const t of ticks(t0, t1, 5)) {
      const last = t > t1 - 0.01 * (t1 - t0); // its words would reach beyond the picture
      out.push(svg('line', { x1: this.x(t), x2: this.x(t), y1: bottom, y2: bottom + 4, class: 'axis' }),
        svg('text', { x: this.x(t), y: bottom + 15, 'text-anchor': last ? 'end' : 'middle' }, last ? `${digits(t, 3)} s` : digits(t, 3)));
    }
    out.push(svg('line', { x1: size.left, x2: size.width - size.right, y1: bottom, y2: bottom, class: 'axis' }));
    return out;
  }

  show(t: number): void {
    const { time, curves, unit } = this.series;
    const x = this.x(t);
    this.cursor.setAttribute('x1', String(x));
    this.cursor.setAttribute('x2', String(x));
    let i = time.findIndex((s) => s >= t - 1e-12);
    if (i < 0) i = time.length - 1;
    const before = Math.max(0, i - 1);
    const span = time[i]! - time[before]!;
    const share = span > 0 ? Math.min(1, (t - time[before]!) / span) : 1;
    curves.forEach((curve, k) => {
      const v = curve.values[before]! + share * (curve.values[i]! - curve.values[before]!);
      this.dots[k]!.setAttribute('cx', String(x));
      this.dots[k]!.setAttribute('cy', String(this.y(v)));
      this.readouts[k]!.textContent = quantity(v, unit);
    });
  }
}

/// Okabe & Ito's colours that stand out on white and on black alike come first.
function curveColour(i: number): number {
  return [4, 5, 2, 0, 6, 1, 7][i % 7]! + (i >= 7 ? 8 : 0);
}

export class Plots {
  readonly element = h('div', { class: 'plots' });
  private plots: Plot[] = [];
  private shown = 'length';

  constructor(private readonly context: Context) {
    context.store.listen((_, changed) => { if (changed.has('at')) this.move(); });
    this.fill();
  }

  static has(context: Context): boolean {
    const answer = context.data.document.answer;
    return (answer?.monitors ?? []).some((m) => m.time.length > 1) || (answer?.energy_history?.time?.length ?? 0) > 1;
  }

  private fill(): void {
    const answer = this.context.data.document.answer;
    const monitors = (answer?.monitors ?? []).filter((m) => m.time.length > 1);
    const seek = (time: number): void => this.context.store.set({ at: this.context.motion.placeOfTime(time) });
    const parts: Node[] = [];
    this.plots = [];
    const add = (series: Series | null): void => {
      if (!series) return;
      const plot = new Plot(series, seek);
      this.plots.push(plot);
      parts.push(plot.element);
    };
    if (monitors.length) {
      const known = quantities.filter((q) => monitorSeries(monitors, q.key));
      if (!known.some((q) => q.key === this.shown)) this.shown = known[0]!.key;
      parts.push(choice('Monitors', known.map((q) => [q.key, q.name]), this.shown, (key) => { this.shown = key; this.fill(); }).row);
      add(monitorSeries(monitors, this.shown));
    }
    if (answer?.energy_history) add(energySeries(answer.energy_history));
    if (answer?.contacts_history) add(contactSeries(answer.contacts_history));
    this.element.replaceChildren(...parts);
    this.move();
  }

  private move(): void {
    const time = this.context.motion.timeAt(this.context.store.state.at);
    for (const plot of this.plots) plot.show(time);
  }
}
