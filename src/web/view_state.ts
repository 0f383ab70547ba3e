// All that can be seen of the page's view, and its form in the address.

export interface Clip {
  on: boolean;
  at: number; // 0 … 1 of the model's extent along the axis
  flip: boolean;
}

export interface ViewState {
  field: string;
  paint: string; // colours of materials in their order, "c0c0c0__5f7f5a"; empty: the page's own
  at: number; // place in the list of states: 1.25 is a quarter past the second
  magnify: number; // of displacements
  stage: number; // excavated so far; −1: all
  show: 'all' | 'key' | 'finite' | 'moved' | 'chosen';
  rest: 'ghost' | 'hidden' | 'solid';
  opacity: number;
  explode: number;
  edges: boolean;
  texture: boolean;
  symbols: boolean;
  joint: number; // an origin whose joints are shown: −1 none, −2 all
  clip: [Clip, Clip, Clip]; // across x, y, z
  selected: number; // a block's id, 0: none
  chosen: number[]; // ids of isolated blocks
  tried: number[]; // number of a knob (what_if.ts), value, number, value, …; empty: as in the model
  hidden: number[]; // ids
  low: number | null; // limits of the map, null: by the values
  high: number | null;
  theme: 'auto' | 'light' | 'dark';
  fly: boolean;
  camera: number[]; // where it stands and what it looks at, m from the model's middle; empty: as at first
}

const off = (): Clip => ({ on: false, at: 0.5, flip: false });

export function initialState(): ViewState {
  return {
    field: '', paint: '', at: 0, magnify: 1, stage: -1, show: 'all', rest: 'ghost', opacity: 1, explode: 0, edges: true, texture: true,
    symbols: true, joint: -1, clip: [off(), off(), off()], selected: 0, chosen: [], tried: [], hidden: [], low: null, high: null,
    theme: 'auto', fly: false, camera: [],
  };
}

const round = (x: number): number => Number(x.toPrecision(5));

function encodeValue(key: keyof ViewState, value: unknown): string {
  if (key === 'clip')
    return (value as Clip[]).map((c) => (c.on ? `${c.flip ? '-' : ''}${round(c.at)}` : '')).join('_');
  if (Array.isArray(value)) return value.map((v) => round(v as number)).join('_');
  if (typeof value === 'boolean') return value ? '1' : '0';
  if (typeof value === 'number') return String(round(value));
  return encodeURIComponent(String(value));
}

/// "field=batch&selected=12": what differs from `initial`, in a fixed order.
export function encodeState(state: ViewState, initial: ViewState = initialState()): string {
  const parts: string[] = [];
  for (const key of Object.keys(initial) as (keyof ViewState)[]) {
    const text = encodeValue(key, state[key] ?? '');
    if (text !== encodeValue(key, initial[key] ?? '')) parts.push(`${key}=${text}`);
  }
  return parts.join('&');
}

const choices: Partial<Record<keyof ViewState, string[]>> = {
  show: ['all', 'key', 'finite', 'moved', 'chosen'],
  rest: ['ghost', 'hidden', 'solid'],
  theme: ['auto', 'light', 'dark'],
};

/// An address is anybody's text: what makes no sense is passed over.
function decodeValue(key: keyof ViewState, text: string, initial: ViewState[keyof ViewState]): unknown {
  if (key === 'clip') {
    const parts = text.split('_');
    return [0, 1, 2].map((i) => {
      const part = parts[i] ?? '';
      const at = Math.abs(Number(part));
      return part === '' || !Number.isFinite(at) ? off() : { on: true, at: Math.min(1, at), flip: part.startsWith('-') };
    });
  }
  if (Array.isArray(initial)) return text === '' ? [] : text.split('_').map(Number).filter(Number.isFinite);
  if (typeof initial === 'boolean') return text === '1';
  if (typeof initial === 'number' || initial === null) {
    const number = text === '' ? NaN : Number(text);
    return Number.isFinite(number) ? number : initial;
  }
  const word = decodeURIComponent(text);
  return !choices[key] || choices[key].includes(word) ? word : initial;
}

export function decodeState(hash: string, initial: ViewState = initialState()): ViewState {
  const state: Record<string, unknown> = { ...initial };
  for (const part of hash.replace(/^#/, '').split('&')) {
    const [key, text] = part.split('=', 2) as [keyof ViewState, string | undefined];
    if (!Object.hasOwn(initial, key) || text === undefined) continue;
    try {
      state[key] = decodeValue(key, text, initial[key]);
    } catch {
      // a broken %-escape
    }
  }
  return state as unknown as ViewState;
}

type Listener = (state: ViewState, changed: Set<keyof ViewState>) => void;

/// The one place where the view is kept; who shows it listens.
export class Store {
  private listeners: Listener[] = [];
  constructor(public state: ViewState) {}

  listen(listener: Listener): void {
    this.listeners.push(listener);
  }
  set(change: Partial<ViewState>): void {
    const changed = new Set<keyof ViewState>();
    for (const key of Object.keys(change) as (keyof ViewState)[])
      if (this.state[key] !== change[key]) changed.add(key);
    if (changed.size === 0) return;
    this.state = { ...this.state, ...change };
    for (const listener of this.listeners) listener(this.state, changed);
  }
}
