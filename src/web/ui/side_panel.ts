// The panel on the right: tabs for the picked block, key blocks, plots and the model's text.
import type { Context } from '../context';
import { h } from './dom';
import { BlockInfo } from './info';
import { Plots } from './plots';
import { KeyblockTable } from './table';
import { WhatIfPanel } from './what_if_panel';

export function sidePanel(context: Context): HTMLElement {
  const tabs: [id: string, name: string, element: HTMLElement][] = [['block', 'Block', new BlockInfo(context).element]];
  const table = context.keyblocks.length || context.whatIf ? new KeyblockTable(context) : undefined;
  if (table) tabs.push(['keys', 'Key blocks', table.element]);
  if (context.whatIf) tabs.push(['what-if', 'What if', new WhatIfPanel(context, context.whatIf).element]);
  if (Plots.has(context)) tabs.push(['plots', 'Plots', new Plots(context).element]);
  tabs.push(['model', 'Model', modelText(context)]);
  const buttons = tabs.map(([id, name]) => h('button', { type: 'button', role: 'tab', id: `tab-${id}`, 'aria-controls': `panel-${id}`, click: () => open(id) }, name));
  const bodies = tabs.map(([id, , element]) => h('div', { role: 'tabpanel', id: `panel-${id}`, 'aria-labelledby': `tab-${id}`, class: 'tab' }, element));
  const open = (wanted: string): void => {
    tabs.forEach(([id], i) => {
      bodies[i]!.hidden = id !== wanted;
      buttons[i]!.setAttribute('aria-selected', String(id === wanted));
    });
    if (wanted === 'keys') table?.refresh();
  };
  open(context.keyblocks.length ? 'keys' : Plots.has(context) ? 'plots' : 'block');
  // A block picked in the model shows what it is, unless the table is open, which marks it.
  context.store.listen((state, changed) => {
    if (!changed.has('selected') || state.selected === 0) return;
    const inTable = context.keyblocks.some((k) => k.block === state.selected);
    const panel = document.getElementById('panel-keys');
    if (!(panel && !panel.hidden && inTable)) open('block');
  });
  return h('aside', { class: 'panel right' }, h('div', { role: 'tablist', class: 'tabs' }, ...buttons), ...bodies);
}

function modelText(context: Context): HTMLElement {
  const { document } = context.data;
  return h('div', { class: 'model' },
    h('p', { class: 'note' }, `Made by rockfold ${document.version} ${document.command} (${document.commit}) from this model:`),
    h('pre', {}, document.model));
}
