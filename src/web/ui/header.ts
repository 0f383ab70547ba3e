// The bar at the top: what is shown, search, picture, address, light or dark, help.
import type { Context } from '../context';
import { button, h } from './dom';
import { reductionText, stabilityText } from './format';

export interface HeaderActions {
  picture: () => void;
  theme: () => void;
  panels: (side: 'left' | 'right') => void;
}

export const shortcuts: [keys: string, what: string][] = [
  ['drag', 'turn'], ['right button or Shift + drag', 'move aside'], ['wheel', 'nearer, farther'], ['click', 'pick a block'], ['double click', 'go there'],
  ['W A S D, Q E', 'move the camera'], ['G', 'fly: look around from where you are'], ['Space', 'play or pause'], [', and .', 'state before, next'], ['Home, End', 'first, last state'],
  ['F', 'fly to the picked block'], ['H', 'hide it'], ['I', 'isolate it, or show all'], ['Esc', 'pick nothing'], ['1 2 3', 'cut across east, north, up'],
  ['Shift + 1 2 3', 'the other side'], ['B', 'edges'], ['T', 'rock texture'], ['P', 'plan view'], ['R', 'view as at first'], ['L', 'light or dark'], ['/', 'search'], ['?', 'this list'],
];

export function helpDialog(): HTMLDialogElement {
  const dialog = h('dialog', { class: 'help' },
    h('h2', {}, 'Keys and mouse'),
    h('dl', {}, ...shortcuts.flatMap(([keys, what]) => [h('dt', {}, keys), h('dd', {}, what)])),
    h('p', { class: 'note' }, 'The address of this page always holds the view: copy it to share the view.'),
    button('Close', 'Esc', () => dialog.close()));
  return dialog;
}

export function header(context: Context, actions: HeaderActions, help: HTMLDialogElement): HTMLElement {
  const { document: result } = context.data;
  const search = h('input', { type: 'search', id: 'search', placeholder: 'Block number …', 'aria-label': 'search a block by its number', inputmode: 'numeric',
    keydown: (e: KeyboardEvent) => { if (e.key === 'Enter') find(); if (e.key === 'Escape') search.blur(); } });
  const find = (): void => {
    const id = Number(search.value.trim());
    const found = context.indexOf(id) !== undefined;
    search.setCustomValidity(found ? '' : 'there is no such block on this page');
    search.reportValidity();
    if (!found) return;
    context.store.set({ selected: id });
    context.flyToBlock(id);
    search.blur();
  };
  search.addEventListener('input', () => search.setCustomValidity(''));
  const copy = button('Copy link', 'the address of this view', () => {
    void navigator.clipboard?.writeText(location.href).then(() => { copy.textContent = 'Copied'; setTimeout(() => { copy.textContent = 'Copy link'; }, 1200); });
  });
  const { reduction, stability } = result.answer ?? {};
  const safety = reduction ? reductionText(reduction) : stability ? stabilityText(stability) : undefined;
  return h('header', {},
    button('☰', 'show or hide the panel on the left', () => actions.panels('left'), { class: 'panel-button', 'aria-label': 'left panel' }),
    h('h1', {}, result.title || result.file),
    ...(safety ? [h('span', { class: 'safety', title: safety.more }, safety.factor)] : []),
    h('span', { class: 'origin' }, `${result.file} · Rockfold ${result.version}`),
    search,
    button('Picture', 'save as PNG', actions.picture, { id: 'png' }), copy,
    button('◐', 'light or dark (L)', actions.theme, { 'aria-label': 'light or dark', id: 'theme' }),
    button('?', 'keys and mouse', () => help.showModal(), { 'aria-label': 'help' }),
    button('☷', 'show or hide the panel on the right', () => actions.panels('right'), { class: 'panel-button', 'aria-label': 'right panel' }));
}
