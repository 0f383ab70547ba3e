// Where the points of the blocks are in a state, and between two states.
import type { Arrays } from './data';
import type { Surface } from './scene/surface';

/// Of a block's size: as the program counts blocks that moved.
const shareThatIsMotion = 0.01;

/// The solution of three equations, by Cramer's rule.
function solve3(rows: number[][], right: number[]): number[] {
  const det = (m: number[][]): number =>
    m[0]![0]! * (m[1]![1]! * m[2]![2]! - m[1]![2]! * m[2]![1]!) - m[0]![1]! * (m[1]![0]! * m[2]![2]! - m[1]![2]! * m[2]![0]!) +
    m[0]![2]! * (m[1]![0]! * m[2]![1]! - m[1]![1]! * m[2]![0]!);
  const whole = det(rows);
  return [0, 1, 2].map((k) => det(rows.map((row, d) => row.map((v, j) => (j === k ? right[d]! : v)))) / whole);
}

/// Between the states `from` and `to` (the same where the place is a whole number): `share` of the second.
export interface Place {
  from: number;
  to: number;
  share: number;
}

/// `at` counts states, from 0: 1.25 is a quarter of the way from the second to the third.
export function placeAt(at: number, states: number): Place {
  const clamped = Math.min(Math.max(at, 0), Math.max(0, states - 1));
  const from = Math.floor(clamped);
  const to = Math.min(from + 1, Math.max(0, states - 1));
  return { from, to: clamped > from ? to : from, share: clamped - from };
}

/// A history's value at a time, linear between its entries.
export function historyAt(time: number[], values: number[][], t: number): number[] {
  let i = time.findIndex((s) => s >= t - 1e-12);
  if (i < 0) i = time.length - 1;
  const before = Math.max(0, i - 1);
  const span = time[i]! - time[before]!;
  const share = span > 0 ? Math.min(1, Math.max(0, (t - time[before]!) / span)) : 1;
  return values[before]!.map((v, d) => v + share * (values[i]![d]! - v));
}

export class Motion {
  readonly time: ArrayLike<number>;
  readonly step: ArrayLike<number>;
  /// Of blocks as wholes, [S][N][12] about middle [N][3]; or of points, [S][3][P] in units.
  readonly blockMotion: Float32Array | undefined;
  readonly middle: Float32Array | undefined;
  readonly pointMotion: Int16Array | undefined;
  readonly unit: Float32Array;

  constructor(private readonly surface: Surface, arrays: Arrays) {
    this.time = arrays.find('state_time') ?? [];
    this.step = arrays.find('state_step') ?? [];
    this.blockMotion = arrays.find('block_motion') as Float32Array | undefined;
    this.middle = arrays.find('block_middle') as Float32Array | undefined;
    this.pointMotion = arrays.find('point_displacement') as Int16Array | undefined;
    this.unit = (arrays.find('displacement_unit') as Float32Array | undefined) ?? new Float32Array(0);
  }

  get states(): number {
    return this.time.length;
  }

  timeAt(at: number): number {
    if (this.states === 0) return 0;
    const { from, to, share } = placeAt(at, this.states);
    return this.time[from]! + share * (this.time[to]! - this.time[from]!);
  }

  /// The place in the list of states whose time is `time`.
  placeOfTime(time: number): number {
    for (let s = 0; s + 1 < this.states; ++s)
      if (time <= this.time[s + 1]!) {
        const span = this.time[s + 1]! - this.time[s]!;
        return s + (span > 0 ? Math.max(0, (time - this.time[s]!) / span) : 0);
      }
    return Math.max(0, this.states - 1);
  }

  /// Displacement (m) of point p in state s.
  pointAt(s: number, p: number, out: number[]): void {
    if (this.pointMotion) {
      const points = this.surface.point.length / 3;
      const i = 3 * s * points + p;
      for (let d = 0; d < 3; ++d) out[d] = this.unit[s]! * this.pointMotion[i + d * points]!;
      return;
    }
    if (!this.blockMotion || !this.middle) {
      out[0] = out[1] = out[2] = 0;
      return;
    }
    const b = this.surface.blockOfPoint[p]!;
    const m = 12 * (s * this.surface.blockId.length + b);
    const x = this.surface.point[3 * p]! - this.middle[3 * b]!;
    const y = this.surface.point[3 * p + 1]! - this.middle[3 * b + 1]!;
    const z = this.surface.point[3 * p + 2]! - this.middle[3 * b + 2]!;
    for (let d = 0; d < 3; ++d) {
      const row = m + 3 + 3 * d;
      out[d] = this.blockMotion[m + d]! + this.blockMotion[row]! * x + this.blockMotion[row + 1]! * y +
        this.blockMotion[row + 2]! * z;
    }
  }

  /// Displacement (m) in state s of what stands at x then, in or on a block: exactly where blocks move as wholes, else that of the
  /// block's point nearest to it.
  displacementOfPlace(s: number, block: number, x: number[]): number[] {
    const { blockMotion, middle } = this;
    if (blockMotion && middle) {
      const m = 12 * (s * this.surface.blockId.length + block);
      const rows = [0, 1, 2].map((d) => [0, 1, 2].map((k) => blockMotion[m + 3 + 3 * d + k]! + (d === k ? 1 : 0)));
      const arm = solve3(rows, x.map((v, d) => v - middle[3 * block + d]! - blockMotion[m + d]!));
      return arm.map((a, d) => x[d]! - middle[3 * block + d]! - a);
    }
    const u = [0, 0, 0];
    let nearest = [0, 0, 0];
    let least = Infinity;
    for (let p = this.surface.pointBegin[block]!; p < this.surface.pointBegin[block + 1]!; ++p) {
      this.pointAt(s, p, u);
      const distance = Math.hypot(...u.map((v, d) => this.surface.point[3 * p + d]! + v - x[d]!));
      if (distance < least) [least, nearest] = [distance, [...u]];
    }
    return nearest;
  }

  /// Which blocks have moved by more than a hundredth of their size (the cube root of their volume) at a place in time. [N]
  moved(at: number, volume: ArrayLike<number>): Uint8Array {
    return Uint8Array.from(this.surface.blockId, (_, b) =>
      Math.hypot(...this.ofBlock(b, at).mean) > shareThatIsMotion * Math.cbrt(volume[b]!) ? 1 : 0);
  }

  /// Displacements [P][3] at a place in time.
  displacement(at: number): Float32Array {
    const out = new Float32Array(this.surface.point.length);
    if (this.states === 0) return out;
    const { from, to, share } = placeAt(at, this.states);
    const a = [0, 0, 0];
    const b = [0, 0, 0];
    for (let p = 0; 3 * p < out.length; ++p) {
      this.pointAt(from, p, a);
      if (share > 0) this.pointAt(to, p, b);
      for (let d = 0; d < 3; ++d) out[3 * p + d] = a[d]! + (share > 0 ? share * (b[d]! - a[d]!) : 0);
    }
    return out;
  }

  /// The largest displacement of a block's points, and its mean, at a place in time (m).
  ofBlock(block: number, at: number): { mean: [number, number, number]; largest: number } {
    const mean: [number, number, number] = [0, 0, 0];
    let largest = 0;
    if (this.states === 0) return { mean, largest };
    const from = this.surface.pointBegin[block]!;
    const to = this.surface.pointBegin[block + 1]!;
    const place = placeAt(at, this.states);
    const a = [0, 0, 0];
    const b = [0, 0, 0];
    for (let p = from; p < to; ++p) {
      this.pointAt(place.from, p, a);
      this.pointAt(place.to, p, b);
      for (let d = 0; d < 3; ++d) {
        a[d] = a[d]! + place.share * (b[d]! - a[d]!);
        mean[d] = mean[d]! + a[d]! / (to - from);
      }
      largest = Math.max(largest, Math.hypot(a[0]!, a[1]!, a[2]!));
    }
    return { mean, largest };
  }
}
