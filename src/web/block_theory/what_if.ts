// What if friction, cohesion, water, earthquake or target were others: what is tried, and what follows for each block.
import { FirstLooks, type Outcome, type Settings, type Verdict } from './first_looks';
import type { Keyblock, PageData } from '../data';
import type { Surface } from '../scene/surface';
import { niceStep } from '../ui/format';

/// One thing that can be tried. Its place in the list is its number in the address.
export interface Knob {
  label: string;
  unit: string;
  min: number;
  max: number;
  step: number;
  value: number; // as in the model
  group: string; // of the panel
}

type WaterKind = 'table' | 'head' | 'pressure' | 'everywhere' | 'none' | 'several';

/// Class numbers of the fields; 6: what follows from blocks that moved before, or from groups, is for the program to say.
const [stable, key, excavated, notExamined, byProgram] = [2, 3, 4, 5, 6];
const modeNumber = { lifting: 1, single_plane: 2, two_planes: 3, rotation: 4 } as const;

/// Numbers of each block of the page, as the fields want them.
export interface BlockValues {
  class: Float32Array;
  batch: Float32Array;
  mode: Float32Array;
  factor_of_safety: Float32Array;
  support_force: Float32Array;
}

export class WhatIf {
  readonly knobs: Knob[];
  outcome: Outcome | null = null; // null: all is as in the model, and as the program said
  values: BlockValues | null = null;
  milliseconds = 0; // that the last recomputation took
  private settings: Settings;
  private readonly materials: number[];
  private readonly waterKind: WaterKind;

  private constructor(private readonly looks: FirstLooks, private readonly data: PageData, private readonly surface: Surface) {
    this.settings = looks.initial;
    this.materials = looks.materials();
    this.waterKind = kindOfWater(looks.initial, looks.gravity);
    this.knobs = this.makeKnobs();
  }

  static of(data: PageData, surface: Surface): WhatIf | undefined {
    const looks = FirstLooks.read(data.document, data.arrays);
    return looks && looks.count > 0 ? new WhatIf(looks, data, surface) : undefined;
  }

  /// Batches that may follow: one a stage.
  get mostBatches(): number {
    return this.looks.stageCount;
  }

  get active(): boolean {
    return this.outcome !== null;
  }

  private makeKnobs(): Knob[] {
    const { initial } = this.looks;
    const [kx, ky] = initial.seismic;
    const k = Math.hypot(kx, ky);
    const azimuth = k > 0 ? ((Math.atan2(kx, ky) * 180) / Math.PI + 360) % 360 : 0;
    const knobs: Knob[] = [
      { group: 'Target factor of safety', label: 'F.S.', unit: '', min: 1, max: Math.max(3, 1.5 * initial.target), step: 0.05, value: initial.target },
      { group: 'Earthquake', label: 'horizontal', unit: 'g', min: 0, max: Math.max(0.5, 2 * k), step: 0.01, value: k },
      { group: 'Earthquake', label: 'towards', unit: '°', min: 0, max: 360, step: 5, value: azimuth },
      this.waterKnob(),
    ];
    for (const m of this.materials) {
      const group = `Joints “${this.nameOf(m)}”`;
      const [friction, cohesion] = [initial.friction[m]!, initial.cohesion[m]! / 1000];
      const most = niceStep(Math.max(100, 4 * cohesion), 1);
      knobs.push({ group, label: 'friction', unit: '°', min: 0, max: Math.max(70, friction), step: 0.5, value: friction },
        { group, label: 'cohesion', unit: 'kPa', min: 0, max: most, step: most / 200, value: cohesion });
    }
    return knobs;
  }

  private waterKnob(): Knob {
    const { waters, waterPressure } = this.looks.initial;
    const first = waters[0];
    const group = 'Water';
    if (this.waterKind === 'pressure' || this.waterKind === 'everywhere') {
      const value = (first?.pressure ?? waterPressure) / 1000;
      const max = niceStep(Math.max(100, 3 * value), 1);
      return { group, label: 'pressure', unit: 'kPa', min: 0, max, step: max / 200, value };
    }
    const [low, high] = this.looks.levels();
    const value = first?.table?.point[2] ?? first?.head ?? low;
    const [min, max] = [Math.min(low, value), Math.max(high, value)];
    return { group, label: 'level', unit: 'm', min, max, step: niceStep(max - min, 200), value };
  }

  /// Undefined where several waters stand at several levels, or gravity is zero.
  get waterReason(): string | undefined {
    return this.waterKind === 'several' ? 'The model has more than one [[water]], or no gravity: change it with --set.' : undefined;
  }

  private nameOf(m: number): string {
    return this.data.document.answer!.setup!.joint_materials[m]!.name;
  }

  /// `tried`: number of a knob, value, number, value, …
  apply(tried: number[]): void {
    const changed = new Map<number, number>();
    for (let i = 0; i + 1 < tried.length; i += 2) {
      const knob = this.knobs[tried[i]!];
      if (knob && tried[i + 1] !== knob.value) changed.set(tried[i]!, tried[i + 1]!);
    }
    if (changed.size === 0) {
      [this.outcome, this.values, this.settings] = [null, null, this.looks.initial];
      return;
    }
    this.settings = this.settingsOf(changed);
    const began = performance.now();
    this.outcome = this.looks.evaluate(this.settings);
    this.milliseconds = performance.now() - began;
    this.values = this.blockValues(this.outcome);
  }

  private settingsOf(changed: Map<number, number>): Settings {
    const s: Settings = { ...this.looks.initial, friction: [...this.looks.initial.friction], cohesion: [...this.looks.initial.cohesion] };
    const value = (i: number): number => changed.get(i) ?? this.knobs[i]!.value;
    s.target = value(0);
    if (changed.has(1) || changed.has(2)) {
      const angle = (value(2) * Math.PI) / 180;
      s.seismic = [value(1) * Math.sin(angle), value(1) * Math.cos(angle), s.seismic[2]];
    }
    if (changed.has(3)) this.setWater(s, value(3));
    this.materials.forEach((m, i) => {
      if (changed.has(4 + 2 * i)) s.friction[m] = value(4 + 2 * i);
      if (changed.has(5 + 2 * i)) s.cohesion[m] = value(5 + 2 * i) * 1000;
    });
    return s;
  }

  private setWater(s: Settings, level: number): void {
    const first = s.waters[0];
    if (this.waterKind === 'everywhere') s.waterPressure = level * 1000;
    else if (this.waterKind === 'pressure') s.waters = [{ ...first!, pressure: level * 1000 }];
    else if (this.waterKind === 'head') s.waters = [{ ...first!, head: level }];
    else if (this.waterKind === 'table') {
      const { point, normal } = first!.table!;
      s.waters = [{ ...first!, table: { point: [point[0], point[1], level], normal } }];
    } else if (this.waterKind === 'none') s.waters = [{ joints: [], density: 1000, head: level, law: 'mid_height' }]; // as the program has it by default
  }

  private blockValues({ keyblocks, stable: held, byProgram: unknown }: Outcome): BlockValues {
    const { arrays } = this.data;
    const count = this.surface.blockId.length;
    const classes = arrays.get('class');
    const looked = this.looks.blocks();
    const verdicts = new Map([...held, ...keyblocks].map((v) => [v.block, v]));
    const make = (fill: number): Float32Array => new Float32Array(count).fill(fill);
    const values = { class: make(0), batch: make(0), mode: make(0), factor_of_safety: make(NaN), support_force: make(NaN) };
    for (let b = 0; b < count; ++b) {
      const id = this.surface.blockId[b]!;
      const v = verdicts.get(id);
      const was = classes[b]!;
      values.class[b] = v ? (v.key ? key : stable) : unknown.has(id) ? byProgram : looked.has(id) ? stable : was <= 1 || was === excavated ? was : notExamined;
      if (unknown.has(id)) values.batch[b] = NaN;
      if (!v) continue;
      values.batch[b] = v.batch;
      values.mode[b] = modeNumber[v.mode];
      values.factor_of_safety[b] = v.factor_of_safety ?? 0;
      if (v.support_force > 0) values.support_force[b] = v.support_force;
    }
    return values;
  }

  /// m that the water stands higher than in the model.
  get waterRise(): number {
    const [was, now] = [this.looks.initial.waters[0], this.settings.waters[0]];
    return (now?.head ?? now?.table?.point[2] ?? 0) - (was?.head ?? was?.table?.point[2] ?? 0);
  }

  /// Rows for the table of key blocks: those that move, then those that stay.
  rows(): Keyblock[] {
    const { keyblocks, stable: held } = this.outcome!;
    return [...keyblocks, ...held].map(asKeyblock);
  }

  /// What the panel tells of what follows.
  summary(): { blocks: number; volume: number; force: number; least: number | null } {
    const { keyblocks } = this.outcome!;
    return {
      blocks: keyblocks.length, volume: keyblocks.reduce((sum, k) => sum + k.volume, 0), force: keyblocks.reduce((sum, k) => sum + k.support_force, 0),
      least: keyblocks.length === 0 ? null : Math.min(...keyblocks.map((k) => k.factor_of_safety ?? 0)),
    };
  }

  /// What makes the program answer the same.
  command(): string {
    return ['rockfold support MODEL.toml', ...this.overrides().map((text) => `--set '${text}'`)].join(' ');
  }

  /// The texts of its --set options.
  overrides(): string[] {
    const { initial } = this.looks;
    const s = this.settings;
    const sets = ['support.batches=1'];
    if (s.target !== initial.target) sets.push(`support.target_factor_of_safety=${s.target}`);
    if (s.seismic !== initial.seismic) sets.push(`support.seismic_coefficient=[${s.seismic.join(', ')}]`);
    if (s.waterPressure !== initial.waterPressure) sets.push(`support.water_pressure=${s.waterPressure}`);
    if (s.waters !== initial.waters) sets.push(this.waterOverride(s));
    for (const m of this.materials) {
      const path = `joint_material.${/^[A-Za-z_][\w-]*$/.test(this.nameOf(m)) ? this.nameOf(m) : m + 1}`;
      if (s.friction[m] !== initial.friction[m]) sets.push(`${path}.friction_angle=${s.friction[m]}`);
      if (s.cohesion[m] !== initial.cohesion[m]) sets.push(`${path}.cohesion=${s.cohesion[m]}`);
    }
    return sets;
  }

  private waterOverride({ waters: [water] }: Settings): string {
    if (this.waterKind === 'none') return `water=[{head=${water!.head}}]`;
    if (this.waterKind === 'table') return `water.1.table.point=[${water!.table!.point.join(', ')}]`;
    return this.waterKind === 'head' ? `water.1.head=${water!.head}` : `water.1.pressure=${water!.pressure}`;
  }
}

function kindOfWater({ waters, waterPressure }: Settings, gravity: readonly number[]): WaterKind {
  const first = waters[0];
  if (waters.length > 1) return 'several';
  if (first?.pressure !== undefined) return 'pressure';
  if (Math.hypot(...gravity) === 0) return 'several';
  if (!first) return waterPressure > 0 ? 'everywhere' : 'none';
  return first.head !== undefined ? 'head' : 'table';
}

function asKeyblock(v: Verdict): Keyblock {
  return { ...v, direction: [...v.direction] as [number, number, number] };
}
