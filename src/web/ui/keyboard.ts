// Keys of the page; letters go to the view unless something is being typed.
import type { App } from '../app';
import type { ViewState } from '../view_state';
import { views } from './controls';

interface Actions {
  lookFrom: (azimuth: number, elevation: number) => void;
  reset: () => void;
  theme: () => void;
}

export class Keyboard {
  constructor(private readonly app: App, private readonly help: HTMLDialogElement, private readonly actions: Actions) {
    addEventListener('keydown', (e) => this.down(e));
    addEventListener('keyup', (e) => this.app.control.key(e.code, false));
  }

  private down(e: KeyboardEvent): void {
    const on = e.target as HTMLElement;
    if (e.ctrlKey || e.metaKey || e.altKey || this.help.open) return;
    const typing = on.matches('input:not([type=range]):not([type=checkbox]), select, textarea');
    if (typing) return;
    if (e.key === ' ' && on.matches('button, input, summary')) return;
    if ((e.key === 'Home' || e.key === 'End') && on.matches('input')) return;
    if (this.app.control.key(e.code, true) || this.act(e)) e.preventDefault();
  }

  private act(e: KeyboardEvent): boolean {
    const { app } = this;
    const { store, timeline } = app;
    const { state } = store;
    const digit = /^Digit([123])$/.exec(e.code)?.[1];
    if (digit) return this.clip(Number(digit) - 1, e.shiftKey);
    const action: Record<string, () => void> = {
      ' ': () => timeline?.toggle(), ',': () => timeline?.step(-1), '.': () => timeline?.step(1),
      Home: () => timeline?.step(-Infinity), End: () => timeline?.step(Infinity),
      f: () => app.flyToBlock(state.selected), Escape: () => store.set({ selected: 0 }),
      h: () => { if (state.selected) store.set({ hidden: [...state.hidden, state.selected], selected: 0 }); },
      i: () => store.set(state.show === 'chosen' || !state.selected ? { show: 'all', chosen: [] } : { show: 'chosen', chosen: [state.selected] }),
      g: () => store.set({ fly: !state.fly }), b: () => store.set({ edges: !state.edges }), t: () => store.set({ texture: !state.texture }),
      p: () => this.actions.lookFrom(...views.Plan!), r: () => this.actions.reset(), l: () => this.actions.theme(),
      '/': () => document.getElementById('search')?.focus(), '?': () => this.help.showModal(),
    };
    const found = action[e.key.length === 1 ? e.key.toLowerCase() : e.key];
    found?.();
    return found !== undefined;
  }

  private clip(axis: number, flip: boolean): boolean {
    const { store } = this.app;
    const clip = store.state.clip.map((c) => ({ ...c })) as ViewState['clip'];
    const c = clip[axis]!;
    clip[axis] = flip ? { ...c, on: true, flip: !c.flip } : { ...c, on: !c.on };
    store.set({ clip });
    return true;
  }
}
