// What blocks can be coloured by: the values, their unit, and the colours that suit them.
import { categoryColour, fromHex, idColour, type MapName, materialColour, type Rgb } from './colour';
import { Contacts } from './contacts';
import type { PageData } from './data';
import { type Motion, placeAt } from './motion';
import { areaVector, type Surface } from './scene/surface';
import type { BlockValues, WhatIf } from './block_theory/what_if';

export interface Field {
  key: string;
  label: string;
  unit: string;
  /// A value for each block, each point, or each triangle's origin (a joint set, a face).
  /// 'contact': of the contact points, drawn as dots in blocks that are ghosts.
  of: 'block' | 'point' | 'origin' | 'contact';
  /// Names of categories: the values are then their numbers.
  categories?: { name: string; colour: Rgb }[];
  map?: MapName;
  /// Fixed limits of the map; by default those of the values.
  range?: [number, number];
  /// NaN: no value. `at` is a place in the list of states.
  values: (at: number) => Float32Array;
  changes: boolean; // with the state
  theory?: boolean; // of block theory: follows what is tried
  /// The shader finds it by itself from the motion: 3 the length of the displacement, 4, 5, 6 its parts to x, y, z.
  shader?: number;
}

export const classNames = ['infinite', 'tapered', 'stable', 'key', 'excavated', 'not examined', 'by the program'];
const classColours = ['#8d99ae', '#b7b7a4', '#5aa9d6', '#d55e00', '#e8e4d8', '#cfcfcf', '#8e6bb0'];
export const modeNames = ['none', 'lifting', 'sliding on a plane', 'sliding on two planes', 'rotation'];

/// Makes the list of fields that a result has.
export function makeFields(data: PageData, surface: Surface, motion: Motion, whatIf?: WhatIf): Field[] {
  const fields = [...blockFields(data, surface), ...theoryFields(data, surface, whatIf), ...originFields(data)];
  if (motion.states > 0) fields.push(...motionFields(data, motion));
  fields.push(...(Contacts.read(data.arrays, surface, motion)?.fields() ?? []));
  fields.push(...stressFields(data, surface, motion));
  return fields;
}

function constant(values: ArrayLike<number>): () => Float32Array {
  const fixed = Float32Array.from(values);
  return () => fixed;
}

function blockFields({ document, arrays }: PageData, surface: Surface): Field[] {
  const ids: Rgb[] = [];
  for (let i = 0; i < 256; ++i) ids.push(idColour(i));
  const fields: Field[] = [
    { key: 'id', label: 'Block', unit: '', of: 'block', changes: false,
      categories: ids.map((colour, i) => ({ name: String(i), colour })),
      values: constant(Array.from(surface.blockId, (id) => id % 256)) },
    { key: 'volume', label: 'Volume', unit: 'm³', of: 'block', map: 'sequential', changes: false,
      values: constant(arrays.get('volume')) },
    { key: 'material', label: 'Material', unit: '', of: 'block', changes: false,
      categories: document.materials.map((name, i) => ({ name, colour: materialColour(i) })),
      values: constant(arrays.get('material')) },
  ];
  const stage = arrays.get('stage');
  const last = Math.max(...Array.from(new Set(stage)));
  if (last > 0)
    fields.push({ key: 'stage', label: 'Excavation stage', unit: '', of: 'block', changes: false,
      categories: Array.from({ length: last + 1 }, (_, i) => ({
        name: i === 0 ? 'stays' : `stage ${i}`, colour: i === 0 ? fromHex('#9aa3ad') : categoryColour(i - 1) })),
      values: constant(stage) });
  fields.push({ key: 'finite', label: 'Finite', unit: '', of: 'block', changes: false,
    categories: [{ name: 'goes on', colour: fromHex('#9aa3ad') }, { name: 'finite', colour: categoryColour(0) }],
    values: constant(arrays.get('finite')) });
  return fields;
}

/// Gives materials the colours of ViewState.paint, or their own.
export function paintMaterials(fields: Field[], paint: string): void {
  const hex = paint.split('_');
  fields.find((f) => f.key === 'material')!.categories!.forEach((category, i) => {
    category.colour = /^[0-9a-f]{6}$/.test(hex[i] ?? '') ? fromHex(`#${hex[i]}`) : materialColour(i);
  });
}

/// ViewState.paint with another colour ("#99aabb") for one material.
export function repainted(paint: string, material: number, colour: string): string {
  const hex = paint.split('_');
  while (hex.length <= material) hex.push('');
  hex[material] = colour.slice(1);
  return hex.join('_');
}

function theoryFields({ arrays }: PageData, surface: Surface, whatIf: WhatIf | undefined): Field[] {
  const classes = arrays.find('class');
  if (!classes) return [];
  const batch = arrays.get('batch');
  const mode = arrays.get('mode');
  const safety = Float32Array.from(arrays.get('factor_of_safety'), (f, b) =>
    Number.isNaN(f) && classes[b] === 3 && mode[b] === 1 ? 0 : f); // falls: nothing resists
  const batches = Math.max(1, whatIf?.mostBatches ?? 0, ...Array.from(new Set(batch)));
  /// What the program said, or what follows from what is tried; of bolts the program alone says it.
  const now = (name: keyof BlockValues | undefined, values: ArrayLike<number>): (() => Float32Array) => {
    const fixed = Float32Array.from(values);
    const unknown = new Float32Array(fixed.length).fill(NaN);
    return () => (whatIf?.values ? (name ? whatIf.values[name] : unknown) : fixed);
  };
  const limited = (values: () => Float32Array) => (): Float32Array => values().map((b) => Math.min(b, lastBatch));
  const fields: Field[] = [
    { key: 'class', label: 'Class', unit: '', of: 'block', changes: false,
      categories: classNames.map((name, i) => ({ name, colour: fromHex(classColours[i]!) })), values: now('class', classes) },
    { key: 'batch', label: 'Batch', unit: '', of: 'block', changes: false,
      categories: Array.from({ length: Math.min(batches, lastBatch) + 1 }, (_, i) => ({
        name: i === 0 ? 'no key block' : `batch ${i}${i === lastBatch && batches > lastBatch ? ' and later' : ''}`,
        colour: i === 0 ? fromHex('#9aa3ad') : categoryColour(batchColour(i)) })),
      values: limited(now('batch', batch)) },
    { key: 'mode', label: 'Motion', unit: '', of: 'block', changes: false,
      categories: modeNames.map((name, i) => ({ name, colour: i === 0 ? fromHex('#9aa3ad') : categoryColour(batchColour(i)) })),
      values: now('mode', mode) },
    { key: 'factor_of_safety', label: 'Factor of safety', unit: '', of: 'block', map: 'diverging', range: [0, 2],
      changes: false, values: now('factor_of_safety', safety) },
  ];
  const supported = arrays.find('supported_factor_of_safety');
  if (supported)
    fields.push({ key: 'supported_factor_of_safety', label: 'Factor of safety with support', unit: '', of: 'block',
      map: 'diverging', range: [0, 2], changes: false, values: now(undefined, supported) });
  const utilisation = arrays.find('utilisation');
  if (utilisation)
    fields.push({ key: 'utilisation', label: 'Utilisation of bolts', unit: '%', of: 'block', map: 'sequential',
      changes: false, values: now(undefined, utilisation) });
  const force = arrays.get('support_force');
  fields.push({ key: 'support_force', label: 'Support force', unit: 'N', of: 'block', map: 'sequential', changes: false,
    values: now('support_force', Array.from({ length: surface.blockId.length }, (_, b) => (force[b]! > 0 ? force[b]! : NaN))) });
  return fields.map((field) => ({ ...field, theory: true }));
}

/// So many have a colour of their own.
const lastBatch = 7;

/// The warm ones of the eight first: batch 1 goes first.
function batchColour(i: number): number {
  return [5, 0, 3, 2, 1, 4, 6][(i - 1) % 7]!;
}

/// Joint sets by colour; the rock's own boundary grey.
export function originColours(data: PageData): Rgb[] {
  let joints = 0;
  return data.document.origins.map((o) => (o.kind === 0 ? categoryColour(joints++) : fromHex(o.kind === 1 ? '#b9bec5' : '#8f969f')));
}

function originFields(data: PageData): Field[] {
  const colours = originColours(data);
  if (data.document.origins.length > 255) return [];
  return [{ key: 'joint', label: 'Joint set of each face', unit: '', of: 'origin', changes: false,
    categories: data.document.origins.map((o, i) => ({ name: o.name, colour: colours[i]! })),
    values: constant(data.document.origins.map((_, i) => i)) }];
}

function motionFields({ arrays }: PageData, motion: Motion): Field[] {
  const part = (pick: (u: Float32Array, i: number) => number) => (at: number): Float32Array => {
    const u = motion.displacement(at);
    const out = new Float32Array(u.length / 3);
    for (let p = 0; p < out.length; ++p) out[p] = pick(u, 3 * p);
    return out;
  };
  const axis = (key: string, name: string, d: number): Field => ({ key, label: `Displacement ${name}`, unit: 'm', of: 'point',
    map: 'diverging', changes: true, shader: 4 + d, values: part((u, i) => u[i + d]!) });
  const volume = arrays.get('volume');
  return [
    { key: 'displacement', label: 'Displacement', unit: 'm', of: 'point', map: 'sequential', changes: true, shader: 3,
      values: part((u, i) => Math.hypot(u[i]!, u[i + 1]!, u[i + 2]!)) },
    axis('displacement_x', 'to the east', 0), axis('displacement_y', 'to the north', 1), axis('displacement_z', 'upwards', 2),
    { key: 'moved', label: 'Blocks that moved', unit: '', of: 'block', changes: true,
      categories: [{ name: 'below 1 % of their size', colour: fromHex('#b9bec5') }, { name: 'by 1 % or more', colour: fromHex('#d55e00') }],
      values: (at) => Float32Array.from(motion.moved(at, volume)) },
  ];
}

const pointStress = [
  { key: 'von_mises', label: 'Von Mises stress', unit: 'Pa', map: 'sequential' },
  { key: 'sigma_1', label: 'σ₁, tension +', unit: 'Pa', map: 'sequential' },
  { key: 'sigma_3', label: 'σ₃, tension +', unit: 'Pa', map: 'reversed' },
  { key: 'strength_ratio', label: 'Strength over stress', unit: '', map: 'diverging' },
] as const;

function stressFields({ arrays }: PageData, surface: Surface, motion: Motion): Field[] {
  const fields: Field[] = [];
  for (const { key, label, unit, map } of pointStress) {
    const levels = arrays.find(key);
    if (!levels) continue;
    const [low, high] = arrays.get(`${key}_range`) as unknown as [number, number];
    const points = surface.point.length / 3;
    fields.push({ key, label, unit, of: 'point', map, changes: true, ...(key === 'strength_ratio' ? { range: [0, 2] as [number, number] } : {}),
      values: (at) => {
        const { from, to, share } = placeAt(at, motion.states);
        const out = new Float32Array(points);
        for (let p = 0; p < points; ++p) {
          const a = levels[from * points + p]!;
          const b = levels[to * points + p]!;
          out[p] = a === 65535 ? NaN : low + ((a + share * (b - a)) / 1000) * (high - low);
        }
        return out;
      } });
  }
  const means = arrays.find('block_stress');
  if (means)
    fields.push({ key: 'von_mises', label: 'Von Mises stress of the block', unit: 'Pa', of: 'block', map: 'sequential', changes: true,
      values: (at) => {
        const s = Math.round(at);
        return Float32Array.from({ length: surface.blockId.length }, (_, b) =>
          vonMises(means.subarray(6 * (s * surface.blockId.length + b), 6 * (s * surface.blockId.length + b) + 6)));
      } });
  return fields;
}

/// √(3 J2) of xx, yy, zz, xy, yz, zx.
export function vonMises(s: ArrayLike<number>): number {
  const [a, b, c] = [s[0]! - s[1]!, s[1]! - s[2]!, s[2]! - s[0]!];
  return Math.sqrt(0.5 * (a * a + b * b + c * c) + 3 * (s[3]! ** 2 + s[4]! ** 2 + s[5]! ** 2));
}

/// The limits of a field's map: its own, or of its values in all states, a hundredth of them left out at either end
/// where they are many (a corner's stress would hide all others).
export function rangeOf(field: Field, states: number): [number, number] {
  if (field.categories) return [0, 255];
  if (field.range) return field.range;
  const seen: number[] = [];
  const count = field.changes ? Math.max(1, states) : 1;
  for (let s = 0; s < count; ++s) {
    const values = field.values(s);
    const stride = Math.max(1, Math.floor((values.length * count) / 200000));
    for (let i = 0; i < values.length; i += stride) if (Number.isFinite(values[i]!)) seen.push(values[i]!);
  }
  if (seen.length === 0) return [0, 1];
  const sorted = Float64Array.from(seen).sort();
  const cut = field.of === 'point' && field.unit === 'Pa' ? 0.01 : 0;
  let low = sorted[Math.floor(cut * (sorted.length - 1))]!;
  let high = sorted[Math.ceil((1 - cut) * (sorted.length - 1))]!;
  if (field.map === 'diverging' && !field.range) {
    high = Math.max(Math.abs(low), Math.abs(high));
    low = -high;
  }
  if (field.key === 'displacement' || field.key === 'volume') low = 0;
  return high > low ? [low, high] : [low, low + (Math.abs(low) || 1)];
}

/// Unit normals and areas (m²) of the planes that joints have on the surface of blocks, upward, one entry an orientation.
export interface Pole {
  origin: number;
  normal: [number, number, number];
  area: number;
}

export function poles(surface: Surface, data: PageData): Pole[] {
  const found = new Map<string, Pole>();
  const v = [0, 0, 0];
  for (let t = 0; t < surface.origin.length; ++t) {
    const origin = surface.origin[t]!;
    if (data.document.origins[origin]?.kind !== 0) continue;
    areaVector(surface, t, v);
    const length = Math.hypot(v[0]!, v[1]!, v[2]!);
    if (!(length > 0)) continue;
    const sign = v[2]! < -1e-6 * length || (Math.abs(v[2]!) <= 1e-6 * length && v[1]! < 0) ? -1 : 1;
    const n = v.map((x) => (sign * x) / length) as [number, number, number];
    const key = `${origin}:${n.map((x) => Math.round(50 * x)).join()}`;
    const pole = found.get(key);
    if (pole) {
      for (let d = 0; d < 3; ++d) pole.normal[d] = pole.normal[d]! + (0.25 * length) * n[d]!;
      pole.area += 0.25 * length; // half a cross product, and each joint has two sides
    } else found.set(key, { origin, normal: n.map((x) => 0.25 * length * x) as [number, number, number], area: 0.25 * length });
  }
  for (const pole of found.values()) {
    const length = Math.hypot(...pole.normal);
    pole.normal = pole.normal.map((x) => x / length) as [number, number, number];
  }
  return [...found.values()].sort((a, b) => a.origin - b.origin || b.area - a.area);
}
