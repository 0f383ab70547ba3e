// What `rockfold view` put into the page: a JSON document, and arrays as deflated, shuffled base64 (src/page).

import type { Water } from './block_theory/water';

export type NumberArray = Uint8Array | Uint16Array | Int16Array | Uint32Array | Float32Array | Float64Array;

const constructors = {
  uint8: Uint8Array,
  uint16: Uint16Array,
  int16: Int16Array,
  uint32: Uint32Array,
  float32: Float32Array,
  float64: Float64Array,
} as const;
export type NumberType = keyof typeof constructors;

export interface ArrayEntry {
  name: string;
  type: NumberType;
  count: number;
  differences?: boolean; // each number less the one before it
}

export interface Origin {
  name: string;
  kind: number; // 0 joint, 1 face of a solid, 2 wall of an excavation
  continues: boolean;
  material: number; // into the joint materials; −1: none
}

export interface Keyblock {
  block: number;
  batch: number;
  volume: number;
  weight: number;
  mode: string;
  motion?: string; // "slides", "pushed out"; results of older programs have none
  planes: string[];
  direction: [number, number, number];
  sliding_force: number;
  factor_of_safety: number | null;
  free_area: number;
  support_force: number;
  support_pressure: number;
  blocks?: number[];
  stage?: number;
  bolts?: { bolt: string; utilisation: number }[];
  supported_factor_of_safety?: number | null;
  utilisation?: number | null;
  adequate?: boolean;
}

export interface Bolt {
  name: string;
  collar: [number, number, number];
  direction: [number, number, number];
  length: number;
  state?: string; // of a run, at its end: "elastic", "yields", "slides", "broken", "not installed" …
  force?: number; // N, the largest along it
  mobilisation?: number; // of what its steel bears
}

export interface Monitor {
  name: string;
  point?: [number, number, number];
  time: number[];
  displacement?: number[][];
  velocity?: number[][];
  von_mises?: number[];
  principal_stress?: number[][];
  strength_ratio?: number[];
  joint?: string;
  normal_stress?: number[];
  shear_stress?: number[];
  opening?: number[];
  slip?: number[];
}

export interface Support {
  keyblocks?: Keyblock[];
  stable?: Keyblock[];
  bolts?: Bolt[];
}

export interface Mark {
  kind: 'fixed' | 'load' | 'quiet' | 'monitor' | 'water';
  name: string;
  points: number[][];
  directions: number[][]; // unit; of loads and water levels
}

/// The model's joints and loads with their defaults.
export interface Setup {
  gravity: [number, number, number];
  joint_materials: { name: string; friction_angle: number; cohesion: number }[];
  support?: {
    target_factor_of_safety: number;
    water_pressure: number;
    seismic_coefficient: [number, number, number];
    rotation: boolean;
    in_situ_stress: boolean;
    support_direction: [number, number, number] | null;
    pushed_out_within?: number; // of a unit direction, upwards or downwards
    water: Water[];
  };
}

/// The factor of safety of the whole mass: with tan(friction) and cohesion divided by `stands` it stands, by `fails` it does not.
export interface Reduction {
  factor: number | null;
  stands: number | null;
  fails: number | null;
  shown: number; // the factor of the run whose motion the result holds
  blocks: number[]; // that fail
}

/// A block of a mechanism: the fastest point of the mass moves with 1 m/s.
export interface MovingBlock {
  block: number;
  velocity: [number, number, number];
}

/// The whole mass by limit analysis: `sliding` without dilation, `bound` above it.
export interface Stability {
  in_words: string;
  bound: { factor: number | null; mechanism: MovingBlock[] };
  sliding: { factor: number | null; answer: string; mechanism: MovingBlock[] };
}

export interface Answer extends Support {
  setup?: Setup;
  totals?: Record<string, unknown>;
  monitors?: Monitor[];
  energy_history?: Record<string, number[]>;
  contacts_history?: Record<string, number[]>;
  support?: Support;
  marks?: Mark[];
  reduction?: Reduction;
  stability?: Stability;
}

export interface PageDocument {
  format: number;
  file: string;
  title: string;
  command: string;
  version: string;
  commit: string;
  origin: [number, number, number];
  blocks: number;
  materials: string[];
  origins: Origin[];
  answer: Answer | null;
  model: string;
  arrays: ArrayEntry[];
}

/// Bytes of equal significance stand together in `shuffled`; puts each number's bytes side by side again.
export function unshuffled(shuffled: Uint8Array, entry: ArrayEntry): NumberArray {
  const type = constructors[entry.type];
  const size = type.BYTES_PER_ELEMENT;
  if (shuffled.length !== size * entry.count) throw new Error(`${entry.name} is cut short`);
  const bytes = new Uint8Array(shuffled.length);
  for (let k = 0; k < size; ++k) {
    const plane = shuffled.subarray(k * entry.count, (k + 1) * entry.count);
    for (let i = 0, at = k; i < entry.count; ++i, at += size) bytes[at] = plane[i]!;
  }
  const numbers = new type(bytes.buffer);
  if (entry.differences) for (let i = 1; i < entry.count; ++i) numbers[i] = numbers[i]! + numbers[i - 1]!;
  return numbers;
}

export function fromBase64(text: string): Uint8Array<ArrayBuffer> {
  const binary = atob(text.trim());
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

export async function inflated(bytes: Uint8Array<ArrayBuffer>): Promise<Uint8Array> {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/// The arrays of a page by name.
export class Arrays {
  constructor(private readonly byName: Map<string, NumberArray>) {}
  has(name: string): boolean {
    return this.byName.has(name);
  }
  /// Undefined where the result holds no such array.
  find(name: string): NumberArray | undefined {
    return this.byName.get(name);
  }
  get(name: string): NumberArray {
    const found = this.byName.get(name);
    if (!found) throw new Error(`the page lacks ${name}`);
    return found;
  }
}

export interface PageData {
  document: PageDocument;
  arrays: Arrays;
}

/// Reads what stands in the page, and empties the elements: the texts are as large as the page.
export async function readPage(page: Document): Promise<PageData> {
  const text = page.getElementById('document')?.textContent;
  if (!text) throw new Error('the page holds no result');
  const document = JSON.parse(text) as PageDocument;
  const read = async (entry: ArrayEntry): Promise<[string, NumberArray]> => {
    const element = page.getElementById(`array-${entry.name}`);
    if (!element) throw new Error(`the page lacks ${entry.name}`);
    const bytes = await inflated(fromBase64(element.textContent ?? ''));
    element.remove();
    return [entry.name, unshuffled(bytes, entry)];
  };
  const arrays = new Arrays(new Map(await Promise.all(document.arrays.map(read))));
  return { document, arrays };
}
