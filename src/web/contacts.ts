// The contact points of a run: where they are in each stored state, and what they bear.
import { fromHex } from './colour';
import type { Arrays } from './data';
import type { Field } from './fields';
import type { Motion } from './motion';
import type { Surface } from './scene/surface';

export const contactNames = ['open', 'stick', 'slide'];
const contactColours = ['#8d99ae', '#0072b2', '#d55e00'];

const measures = [
  { key: 'contact_normal', label: 'Normal stress in joints', unit: 'Pa', map: 'reversed' }, // compression is negative
  { key: 'contact_shear', label: 'Shear stress in joints', unit: 'Pa', map: 'sequential' },
  { key: 'contact_slip', label: 'Slip of joints', unit: 'm', map: 'sequential' },
  { key: 'contact_gap', label: 'Opening of joints', unit: 'm', map: 'sequential' },
] as const;

export class Contacts {
  private readonly begin: Uint32Array; // [S+1]

  private constructor(private readonly arrays: Arrays, private readonly surface: Surface, private readonly motion: Motion) {
    const count = arrays.get('contact_count');
    this.begin = new Uint32Array(count.length + 1);
    for (let s = 0; s < count.length; ++s) this.begin[s + 1] = this.begin[s]! + count[s]!;
  }

  /// Undefined where blocks do not touch each other.
  static read(arrays: Arrays, surface: Surface, motion: Motion): Contacts | undefined {
    return arrays.has('contact_count') ? new Contacts(arrays, surface, motion) : undefined;
  }

  /// Contact points are known in stored states: between two of them, those of the nearer one.
  private rows(at: number): [number, number] {
    const s = Math.min(Math.max(0, Math.round(at)), this.begin.length - 2);
    return [this.begin[s]!, this.begin[s + 1]!];
  }

  /// What blocks can be coloured by of them.
  fields(): Field[] {
    const states = this.arrays.get('contact_state');
    const fields: Field[] = [{ key: 'contact_state', label: 'State of joints', unit: '', of: 'contact', changes: true,
      categories: contactNames.map((name, i) => ({ name, colour: fromHex(contactColours[i]!) })),
      values: (at) => Float32Array.from(states.subarray(...this.rows(at))) }];
    for (const { key, label, unit, map } of measures) {
      const levels = this.arrays.find(key);
      if (!levels) continue;
      const [low, high] = this.arrays.get(`${key}_range`) as unknown as [number, number];
      fields.push({ key, label, unit, of: 'contact', map, changes: true, values: (at) => {
        const [from, to] = this.rows(at);
        const out = new Float32Array(to - from);
        // Open points bear nothing: without a colour of the map.
        for (let i = from; i < to; ++i) out[i - from] = unit === 'Pa' && states[i] === 0 ? NaN : low + (levels[i]! / 1000) * (high - low);
        return out;
      } });
    }
    return fields;
  }

  /// Which of them belong to a joint: an origin's number, −1 and −2 all.
  shown(at: number, joint: number): boolean[] {
    return Array.from(this.arrays.get('contact_joint').subarray(...this.rows(at)), (j) => joint < 0 || j === joint + 1);
  }

  /// Where the points are drawn, relative to the model's middle: with the first of their blocks, whose displacement is magnified.
  positions(at: number, magnify: number, shift: (block: number) => ArrayLike<number>): Float32Array {
    const place = this.arrays.get('contact_place');
    const ids = this.arrays.get('contact_block');
    const [from, to] = this.rows(at);
    const state = Math.round(at);
    const out = new Float32Array(3 * (to - from));
    const index = new Map<number, number>();
    this.surface.blockId.forEach((id, b) => index.set(id, b));
    for (let i = from; i < to; ++i) {
      const x = [place[3 * i]!, place[3 * i + 1]!, place[3 * i + 2]!];
      const b = index.get(ids[i]!);
      const u = b === undefined || magnify === 1 ? [0, 0, 0] : this.motion.displacementOfPlace(state, b, x);
      const by = b === undefined ? [0, 0, 0] : shift(b);
      for (let d = 0; d < 3; ++d) out[3 * (i - from) + d] = x[d]! + (magnify - 1) * u[d]! + by[d]!;
    }
    return out;
  }
}
