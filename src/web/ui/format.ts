// Numbers as an engineer writes them.
import type { MovingBlock, Reduction, Stability } from '../data';

const prefixes: [number, string][] = [[1e9, 'G'], [1e6, 'M'], [1e3, 'k'], [1, ''], [1e-3, 'm'], [1e-6, 'µ']];
const prefixed = new Set(['N', 'Pa', 'J', 'N/m']);

/// The factor and the name of a unit that suit numbers of this size: 2.5e6 Pa is [1e6, "MPa"].
export function unitFor(size: number, unit: string): [number, string] {
  const s = Math.abs(size);
  if (unit === 'm') return s > 0 && s < 0.02 ? [1e-3, 'mm'] : [1, 'm'];
  if (!prefixed.has(unit) || !(s > 0)) return [1, unit];
  for (const [factor, prefix] of prefixes) if (s >= 0.9999 * factor) return [factor, prefix + unit];
  return [1, unit];
}

/// Four digits, no exponent where it can be read without.
export function digits(x: number, count = 4): string {
  if (x === 0) return '0';
  if (!Number.isFinite(x)) return '–';
  const size = Math.abs(x);
  if (size >= 1e7 || size < 1e-4) return x.toExponential(count - 2).replace('e+', 'e').replace('-', '−');
  const text = size >= 10 ** (count - 1) ? Math.round(x).toLocaleString('en-US').replaceAll(',', ' ') : String(Number(x.toPrecision(count)));
  return text.replace('-', '−');
}

export function quantity(x: number | null | undefined, unit: string, count = 4): string {
  if (x === null || x === undefined || Number.isNaN(x)) return '–';
  const [factor, name] = unitFor(x, unit);
  return `${digits(x / factor, count)}${name ? ' ' + name : ''}`;
}

/// Steps of 1, 2 or 5 that divide a range into at most `most` parts.
export function niceStep(span: number, most: number): number {
  const raw = span / Math.max(1, most);
  const power = 10 ** Math.floor(Math.log10(raw));
  for (const f of [1, 2, 5, 10]) if (f * power >= raw * 0.9999) return f * power;
  return 10 * power;
}

/// At least two where the range is no point.
export function ticks(low: number, high: number, most: number): number[] {
  if (!(high > low)) return [low];
  const count = (step: number): number => Math.floor(high / step + 1e-6) - Math.ceil(low / step - 1e-6) + 1;
  let step = niceStep(high - low, most);
  for (let more = most + 1; count(step) < 2; ++more) step = niceStep(high - low, more);
  const out: number[] = [];
  for (let i = Math.ceil(low / step - 1e-6); i * step <= high + 1e-6 * step; ++i) out.push(Number((i * step).toPrecision(12)));
  return out;
}

/// Dip and dip direction (deg) of an upward normal.
export function dipOf([x, y, z]: ArrayLike<number> & Iterable<number>): { dip: number; direction: number } {
  const dip = (Math.atan2(Math.hypot(x!, y!), z!) * 180) / Math.PI;
  const direction = ((Math.atan2(x!, y!) * 180) / Math.PI + 360) % 360;
  return { dip, direction };
}

/// "30/045": dip and dip direction in whole degrees.
export function dipText(normal: number[]): string {
  const { dip, direction } = dipOf(normal);
  return `${Math.round(dip)}°/${String(Math.round(direction) % 360).padStart(3, '0')}°`;
}

/// What limit analysis found of the whole mass, and whose motion the arrows show.
export function stabilityText({ in_words, bound, sliding }: Stability): { factor: string; more: string } {
  const factor = sliding.answer === 'fails' ? `factor of safety ${digits(sliding.factor!)}`
    : sliding.answer === 'falls' ? 'fails at any strength'
    : sliding.answer === 'stands' ? 'stands at any strength' : `factor of safety at most ${digits(bound.factor!)}`;
  const arrows = movingBlocks({ in_words, bound, sliding }).length > 0 ? ' Arrows: how fast blocks move, beside each other.' : '';
  return { factor: `Whole mass: ${factor}`, more: `By limit analysis: ${in_words}.${arrows}` };
}

/// Those of its mechanism without dilation; of that of the bound where none was found.
export function movingBlocks({ bound, sliding }: Stability): MovingBlock[] {
  return sliding.mechanism.length > 0 ? sliding.mechanism : bound.mechanism;
}

/// What a strength reduction found, and what the motion on the page is then of.
export function reductionText({ factor, stands, fails, shown, blocks }: Reduction): { factor: string; more: string } {
  const bounds = [stands === null ? '' : `stands at ${digits(stands)}`, fails === null ? '' : `fails at ${digits(fails)}`].filter(Boolean);
  const which = blocks.length ? ` (${blocks.length} block${blocks.length > 1 ? 's' : ''})` : '';
  return {
    factor: `Factor of safety ${factor !== null ? digits(factor) : fails === null ? `at least ${digits(stands!)}` : `below ${digits(fails)}`}`,
    more: `By strength reduction: the mass ${bounds.join(', ')}${which}. The motion shown is that with tan(friction) and cohesion divided by ${digits(shown)}.`,
  };
}
