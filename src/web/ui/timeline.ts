// Play, pause and slide through the states.
import type { Context } from '../context';
import { button, choice, h } from './dom';
import { digits } from './format';

export class Timeline {
  readonly element: HTMLElement;
  private playing = false;
  private last = 0;
  private speed = 1;
  private readonly play: HTMLButtonElement;
  private readonly range: HTMLInputElement;
  private readonly label = h('output', { class: 'time' });
  private readonly factor: HTMLInputElement;

  constructor(private readonly context: Context) {
    const { store, motion } = context;
    const last = motion.states - 1;
    this.play = button('', 'play or pause (space)', () => this.toggle(), { class: 'play', id: 'play' });
    this.range = h('input', { type: 'range', min: 0, max: last, step: 'any', id: 'time', 'aria-label': 'state',
      input: () => { const at = Number(this.range.value); this.stop(); store.set({ at }); } });
    this.factor = h('input', { type: 'number', min: 0, step: 'any', id: 'magnify', 'aria-label': 'displacements times',
      change: () => { const x = Number(this.factor.value); if (x >= 0 && Number.isFinite(x)) store.set({ magnify: x }); } });
    const speed = choice('Speed', [['0.25', '¼'], ['0.5', '½'], ['1', '1'], ['2', '2'], ['4', '4']], '1', (s) => { this.speed = Number(s); });
    this.element = h('footer', { class: 'timeline' },
      button('|◀', 'first state (Home)', () => this.step(-Infinity)), button('◀', 'state before (,)', () => this.step(-1)), this.play,
      button('▶', 'next state (.)', () => this.step(1)), button('▶|', 'last state (End)', () => this.step(Infinity)),
      this.range, this.label, speed.row,
      h('label', { class: 'choice', title: 'displacements are drawn this many times as large' }, h('span', {}, 'Displacements ×'), this.factor),
      button('×1', 'draw displacements as they are', () => store.set({ magnify: 1 })));
    store.listen((_, changed) => { if (changed.has('at') || changed.has('magnify')) this.show(); });
    this.show();
  }

  private show(): void {
    const { store, motion } = this.context;
    const { at, magnify } = store.state;
    this.range.value = String(at);
    if (document.activeElement !== this.factor) this.factor.value = String(Number(magnify.toPrecision(3)));
    const step = Number.isInteger(at) ? `step ${motion.step[at]}` : 'between';
    this.label.replaceChildren(h('b', {}, `${digits(motion.timeAt(at))} s`), ' ', h('small', {}, `${step} of ${motion.step[motion.states - 1]}`));
    this.play.textContent = this.playing ? '❚❚' : '►';
    this.play.setAttribute('aria-pressed', String(this.playing));
  }

  step(by: number): void {
    this.stop();
    const { store, motion } = this.context;
    const { at } = store.state;
    const next = by > 0 ? Math.floor(at + 1e-9) + by : Math.ceil(at - 1e-9) + by;
    store.set({ at: Math.min(motion.states - 1, Math.max(0, next)) });
  }

  toggle(): void {
    if (this.playing) return this.stop();
    const { store, motion } = this.context;
    if (store.state.at >= motion.states - 1) store.set({ at: 0 });
    this.playing = true;
    this.last = performance.now();
    requestAnimationFrame(() => this.tick());
    this.show();
  }

  stop(): void {
    this.playing = false;
    this.show();
  }

  /// The whole of it takes some six seconds at speed 1, however many states there are.
  private tick(): void {
    if (!this.playing) return;
    const { store, motion } = this.context;
    const now = performance.now();
    const rate = Math.max(1.5, (motion.states - 1) / 6) * this.speed;
    const at = store.state.at + (rate * Math.min(200, now - this.last)) / 1000;
    this.last = now;
    if (at >= motion.states - 1) {
      store.set({ at: motion.states - 1 });
      return this.stop();
    }
    store.set({ at });
    requestAnimationFrame(() => this.tick());
  }
}
