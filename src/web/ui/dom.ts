// Making elements. Text is always set as text: names and titles come from models.

type Child = Node | string | null | undefined | false;
type Attributes = Record<string, string | number | boolean | ((e: never) => void) | undefined>;

function fill<T extends Element>(element: T, attributes: Attributes, children: Child[]): T {
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === 'function') element.addEventListener(name, value as unknown as EventListener);
    else if (value === true) element.setAttribute(name, '');
    else if (value !== false && value !== undefined) element.setAttribute(name, String(value));
  }
  for (const child of children) if (child || child === '') element.append(child);
  return element;
}

export function h<K extends keyof HTMLElementTagNameMap>(tag: K, attributes: Attributes = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  return fill(document.createElement(tag), attributes, children);
}

export function svg<K extends keyof SVGElementTagNameMap>(tag: K, attributes: Attributes = {}, ...children: Child[]): SVGElementTagNameMap[K] {
  return fill(document.createElementNS('http://www.w3.org/2000/svg', tag), attributes, children);
}

let ruler: CanvasRenderingContext2D | null = null;

/// px that words take; `font` is CSS: "600 13px".
export function textWidth(words: string, font: string): number {
  ruler ??= document.createElement('canvas').getContext('2d')!;
  ruler.font = `${font} system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", "DejaVu Sans", sans-serif`;
  return ruler.measureText(words).width;
}

export function checkbox(label: string, checked: boolean, change: (on: boolean) => void, title = ''): { row: HTMLLabelElement; box: HTMLInputElement } {
  const box = h('input', { type: 'checkbox', checked, change: () => change(box.checked) });
  box.checked = checked;
  return { row: h('label', { class: 'check', title: title || undefined }, box, h('span', {}, label)), box };
}

export function slider(attributes: { label: string; min: number; max: number; step: number | 'any'; value: number; input: (value: number) => void; id?: string }): { row: HTMLElement; range: HTMLInputElement; output: HTMLOutputElement } {
  const { label, min, max, step, value, input, id } = attributes;
  const range = h('input', { type: 'range', min, max, step, value, id, 'aria-label': label, input: () => input(Number(range.value)) });
  const output = h('output', {});
  return { row: h('label', { class: 'slider' }, h('span', {}, label), range, output), range, output };
}

export function choice(label: string, options: [value: string, name: string][], value: string, change: (value: string) => void, id?: string): { row: HTMLElement; select: HTMLSelectElement } {
  const select = h('select', { id, 'aria-label': label, change: () => change(select.value) },
    ...options.map(([v, name]) => h('option', { value: v, selected: v === value }, name)));
  return { row: h('label', { class: 'choice' }, h('span', {}, label), select), select };
}

export function button(label: string, title: string, click: () => void, attributes: Attributes = {}): HTMLButtonElement {
  return h('button', { type: 'button', title, click, ...attributes }, label);
}
