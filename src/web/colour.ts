// Colour maps that are even to the eye and safe for colour-blind people, made in OKLab (B. Ottosson 2020).

export type Rgb = [number, number, number]; // 0 … 1, sRGB

/// Lightness 0 … 1, chroma, hue in degrees.
export type Lch = [number, number, number];

export function lchToRgb([L, C, H]: Lch): Rgb {
  const a = C * Math.cos((H * Math.PI) / 180);
  const b = C * Math.sin((H * Math.PI) / 180);
  const l = (L + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (L - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (L - 0.0894841775 * a - 1.291485548 * b) ** 3;
  const linear = [
    4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
    -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
    -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s,
  ];
  return linear.map((v) => {
    const c = Math.min(1, Math.max(0, v));
    return c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055;
  }) as Rgb;
}

export function rgbToOklab([r, g, b]: Rgb): [number, number, number] {
  const [x, y, z] = [r, g, b].map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4)) as Rgb;
  const l = Math.cbrt(0.4122214708 * x + 0.5363325363 * y + 0.0514459929 * z);
  const m = Math.cbrt(0.2119034982 * x + 0.6806995451 * y + 0.1073969566 * z);
  const s = Math.cbrt(0.0883024619 * x + 0.2817188376 * y + 0.6299787005 * z);
  return [
    0.2104542553 * l + 0.793617785 * m - 0.0040720468 * s,
    1.9779984951 * l - 2.428592205 * m + 0.4505937099 * s,
    0.0259040371 * l + 0.7827717662 * m - 0.808675766 * s,
  ];
}

function between(stops: Lch[], share: number): Lch {
  const at = Math.min(Math.max(share, 0), 1) * (stops.length - 1);
  const i = Math.min(Math.floor(at), stops.length - 2);
  const t = at - i;
  return [0, 1, 2].map((k) => stops[i]![k]! + t * (stops[i + 1]![k]! - stops[i]![k]!)) as Lch;
}

/// Dark blue to pale yellow; lightness rises evenly.
const sequential: Lch[] = [
  [0.28, 0.1, 285],
  [0.41, 0.115, 262],
  [0.54, 0.105, 225],
  [0.67, 0.11, 180],
  [0.8, 0.135, 135],
  [0.93, 0.13, 105],
];
/// Rust over near-white to blue: both ends are as dark, and differ for every kind of colour blindness.
const diverging: Lch[] = [
  [0.42, 0.13, 45],
  [0.6, 0.135, 55],
  [0.78, 0.08, 70],
  [0.93, 0.01, 90],
  [0.78, 0.065, 235],
  [0.6, 0.11, 248],
  [0.42, 0.12, 258],
];

export type MapName = 'sequential' | 'reversed' | 'diverging';

export function mapColour(name: MapName, share: number): Rgb {
  if (name === 'diverging') return lchToRgb(between(diverging, share));
  return lchToRgb(between(sequential, name === 'reversed' ? 1 - share : share));
}

/// Okabe & Ito's colours for up to eight names, then turns of the golden angle.
const distinct: string[] = ['#e69f00', '#56b4e9', '#009e73', '#f0e442', '#0072b2', '#d55e00', '#cc79a7', '#8a8a8a'];

export function fromHex(hex: string): Rgb {
  const n = parseInt(hex.slice(1), 16);
  return [(n >> 16) / 255, ((n >> 8) & 255) / 255, (n & 255) / 255];
}

export function toHex(rgb: Rgb): string {
  return '#' + rgb.map((c) => Math.round(255 * c).toString(16).padStart(2, '0')).join('');
}

export function categoryColour(i: number): Rgb {
  if (i < distinct.length) return fromHex(distinct[i]!);
  return lchToRgb([0.55 + 0.25 * ((i * 0.381966) % 1), 0.1, (i * 137.508) % 360]);
}

/// As stone and soil look. Any two differ by 0.11 or more in OKLab, for eyes without red or without green cones too (colour_test).
const stone: string[] = ['#d2b48c', '#6492cb', '#7f7221', '#c1e3fc', '#6e4c40', '#ede091', '#507986', '#2b568b'];

export function materialColour(i: number): Rgb {
  return i < stone.length ? fromHex(stone[i]!) : categoryColour(i);
}

/// For ids: neighbours in number look different, none shouts.
export function idColour(id: number): Rgb {
  const hue = (id * 137.50776) % 360;
  return lchToRgb([0.62 + 0.2 * ((id * 0.61803) % 1), 0.075, hue]);
}

/// 256 colours as RGBA bytes.
export function mapBytes(name: MapName): Uint8Array {
  const bytes = new Uint8Array(4 * 256);
  for (let i = 0; i < 256; ++i) put(bytes, i, mapColour(name, i / 255));
  return bytes;
}

/// 256 colours, of which the first are those of the categories.
export function categoryBytes(colours: Rgb[]): Uint8Array {
  const bytes = new Uint8Array(4 * 256);
  for (let i = 0; i < 256; ++i) put(bytes, i, colours[i % colours.length]!);
  return bytes;
}

function put(bytes: Uint8Array, i: number, rgb: Rgb): void {
  for (let k = 0; k < 3; ++k) bytes[4 * i + k] = Math.round(255 * rgb[k]!);
  bytes[4 * i + 3] = 255;
}
