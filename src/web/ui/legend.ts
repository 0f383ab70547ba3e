// The legend, the scale bar and the north arrow: one drawing over the picture, also part of the exported image.
import type { Context } from '../context';
import { mapColour, toHex } from '../colour';
import { repainted } from '../fields';
import { h, svg, textWidth } from './dom';
import { Flag } from '../scene/shaders';
import { digits, niceStep, ticks, unitFor } from './format';

const least = 250; // px, of a bar's box
const titleFont = '600 13px';

/// Everything in pixels from the lower left corner of its own box. `live`: colours of materials can be changed in it.
export function legend(context: Context, live = false): SVGSVGElement {
  const field = context.field();
  return field.categories ? categoryLegend(context, live && field.key === 'material') : barLegend(context);
}

/// Says so where block theory is of what is tried, not of the model.
function titleOf(context: Context): string {
  const { label, theory } = context.field();
  return theory && context.whatIf?.active ? `What if: ${label.charAt(0).toLowerCase()}${label.slice(1)}` : label;
}

function heading(text: string): SVGTextElement {
  return svg('text', { x: 12, y: 20, class: 'legend-title' }, text);
}

function box(height: number, w: number, ...children: (Node | null)[]): SVGSVGElement {
  return svg('svg', { width: w, height, viewBox: `0 0 ${w} ${height}`, class: 'legend' },
    svg('rect', { x: 0.5, y: 0.5, width: w - 1, height: height - 1, rx: 6, class: 'legend-box' }), ...children);
}

function barLegend(context: Context): SVGSVGElement {
  const field = context.field();
  const [low, high] = context.limits();
  const [factor, unit] = unitFor(Math.max(Math.abs(low), Math.abs(high)), field.unit);
  const title = unit ? `${titleOf(context)}, ${unit}` : titleOf(context);
  const width = Math.max(least, textWidth(title, titleFont) + 24);
  const left = 14;
  const right = width - 14;
  const parts: Node[] = [heading(title)];
  const steps = 64;
  for (let i = 0; i < steps; ++i)
    parts.push(svg('rect', { x: left + (i * (right - left)) / steps, y: 30, width: (right - left) / steps + 0.6, height: 14,
      fill: toHex(mapColour(field.map ?? 'sequential', (i + 0.5) / steps)) }));
  for (const t of ticks(low / factor, high / factor, 4)) {
    const x = left + ((t * factor - low) / (high - low)) * (right - left);
    parts.push(svg('line', { x1: x, x2: x, y1: 44, y2: 49, class: 'legend-tick' }));
    parts.push(svg('text', { x, y: 62, class: 'legend-text', 'text-anchor': x < left + 12 ? 'start' : x > right - 12 ? 'end' : 'middle' }, digits(t, 3)));
  }
  return box(72, width, ...parts);
}

/// A swatch that opens the browser's choice of colours.
function colourInput(context: Context, material: number, colour: string): SVGForeignObjectElement {
  const { store, data } = context;
  const input = h('input', { type: 'color', value: colour, title: 'another colour', 'aria-label': `colour of ${data.document.materials[material]}`,
    change: () => store.set({ paint: repainted(store.state.paint, material, input.value) }) });
  return svg('foreignObject', { width: 13, height: 13 }, input);
}

function categoryLegend(context: Context, live: boolean): SVGSVGElement {
  const field = context.field();
  if (field.key === 'id') return box(32, 190, heading('Each block its colour'));
  const used = usedCategories(context);
  const most = 9;
  const shown = used.slice(0, most);
  const nameOf = (i: number): string => {
    const { name } = field.categories![i]!;
    return name.length > 40 ? name.slice(0, 39) + '…' : name;
  };
  const width = Math.max(170, textWidth(titleOf(context), titleFont) + 24, ...shown.map((i) => 45 + textWidth(nameOf(i), '12px')));
  const rows = shown.map((i, row) => {
    const colour = toHex(field.categories![i]!.colour);
    const swatch = live ? colourInput(context, i, colour) : svg('rect', { width: 13, height: 13, rx: 2, fill: colour, class: 'legend-swatch' });
    return svg('g', {}, svg('g', { transform: `translate(12 ${32 + 20 * row})` }, swatch),
      svg('text', { x: 33, y: 43 + 20 * row, class: 'legend-text' }, nameOf(i)));
  });
  if (used.length > most) rows.push(svg('g', {}, svg('text', { x: 33, y: 43 + 20 * most, class: 'legend-text' }, `and ${used.length - most} more`)));
  return box(38 + 20 * rows.length, width, heading(titleOf(context)), ...rows);
}

/// Those that some block shown (or some face) has; names of faces that are no joint only where there are few.
function usedCategories(context: Context): number[] {
  const field = context.field();
  if (field.of === 'origin') {
    const joints = new Set(context.poles.map((p) => p.origin));
    return [...joints].sort((a, b) => a - b);
  }
  if (field.of === 'contact') return field.categories!.map((_, i) => i); // they come and go
  const { flags } = context.scene;
  const isShown = (b: number): boolean => !((flags[b] ?? 0) & Flag.hidden);
  return [...new Set(Array.from(field.values(context.store.state.at)).filter((_, b) => isShown(b)))].filter((v) => v >= 0).sort((a, b) => a - b);
}

/// A bar of a round length at the distance of what the camera looks at.
export function scaleBar(context: Context): SVGSVGElement {
  const { camera, canvas } = context.scene;
  const metre = canvas.clientHeight / (2 * context.control.distance * Math.tan((camera.fov * Math.PI) / 360));
  const length = niceStep(130 / metre / 2, 1);
  const w = length * metre;
  const half = w / 2;
  const [factor, unit] = length < 0.02 ? [1e-3, 'mm'] : length < 1000 ? [1, 'm'] : [1000, 'km'];
  return svg('svg', { width: Math.ceil(w) + 44, height: 34, viewBox: `-22 0 ${Math.ceil(w) + 44} 34`, class: 'scale-bar', 'aria-label': 'scale bar' },
    svg('rect', { x: 0, y: 22, width: w, height: 6, class: 'bar-outline' }),
    svg('rect', { x: 0, y: 22, width: half, height: 6, class: 'bar-fill' }),
    svg('text', { x: 0, y: 16, 'text-anchor': 'middle', class: 'legend-text' }, '0'),
    svg('text', { x: w, y: 16, 'text-anchor': 'middle', class: 'legend-text' }, `${digits(length / factor, 3)} ${unit}`));
}

/// East, north and up as the camera sees them; north is the arrow.
export function compass(context: Context): SVGSVGElement {
  const e = context.scene.camera.matrixWorldInverse.elements;
  const r = 30;
  const axes = [
    { name: 'E', x: e[0]!, y: e[1]!, z: e[2]!, kind: 'minor' },
    { name: 'N', x: e[4]!, y: e[5]!, z: e[6]!, kind: 'north' },
    { name: 'Up', x: e[8]!, y: e[9]!, z: e[10]!, kind: 'minor' },
  ].sort((a, b) => a.z - b.z);
  const parts = axes.map(({ name, x, y, kind }) => {
    const length = Math.hypot(x, y);
    const lx = (r + 11) * (length > 0.25 ? x / length * Math.max(length, 0.45) : x);
    const ly = -(r + 11) * (length > 0.25 ? y / length * Math.max(length, 0.45) : y);
    return svg('g', { class: kind },
      svg('line', { x1: 0, y1: 0, x2: r * x, y2: -r * y }),
      kind === 'north' && length > 0.15 ? arrowHead(r * x, -r * y, x / length, -y / length) : null,
      length > 0.12 ? svg('text', { x: lx, y: ly + 4, 'text-anchor': 'middle', class: 'legend-text' }, name) : null);
  });
  return svg('svg', { width: 100, height: 100, viewBox: '-50 -50 100 100', class: 'compass', 'aria-label': 'directions' }, ...parts);
}

function arrowHead(x: number, y: number, dx: number, dy: number): SVGPolygonElement {
  const at = (along: number, aside: number): string => `${x + along * dx - aside * dy},${y + along * dy + aside * dx}`;
  return svg('polygon', { points: [at(5, 0), at(-7, 5), at(-7, -5)].join(' ') });
}
