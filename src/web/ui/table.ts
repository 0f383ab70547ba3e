// The table of key blocks: sorts by any column, selects and flies to a block.
import type { Context } from '../context';
import type { Keyblock } from '../data';
import { button, h } from './dom';
import { digits } from './format';

interface Column {
  key: string;
  name: string;
  unit: string;
  title: string;
  value: (k: Keyblock) => number | string | null;
  show?: (k: Keyblock) => string;
}

const modes: Record<string, string> = {
  lifting: 'falls', single_plane: 'slides', two_planes: 'slides on two', rotation: 'turns', at_rest: 'at rest',
};

/// How it moves, as the program says it; what the page finds itself has its word from block_theory/first_looks.
export function wordsOf(k: Keyblock): string {
  return k.motion ?? modes[k.mode] ?? k.mode;
}

function columnsOf(keys: Keyblock[]): Column[] {
  const number = (key: keyof Keyblock, name: string, unit: string, title: string, factor = 1): Column => ({
    key, name, unit, title, value: (k) => (typeof k[key] === 'number' ? (k[key] as number) / factor : null) });
  const columns: Column[] = [
    number('block', 'block', '', 'number of the block'),
    number('batch', 'batch', '', 'batch 1 moves first; – : stays'),
    { key: 'factor_of_safety', name: 'F.S.', unit: '', title: 'factor of safety: resisting over driving force; 0 where nothing resists',
      value: (k) => k.factor_of_safety ?? 0, show: (k) => (k.factor_of_safety ?? 0).toFixed(2) },
    number('volume', 'volume', 'm³', 'volume'),
    number('support_force', 'support', 'kN', 'least force for the target factor of safety', 1000),
    { key: 'mode', name: 'it', unit: '', title: 'how it moves', value: wordsOf },
    { key: 'planes', name: 'on', unit: '', title: 'the joints that it slides on', value: (k) => k.planes.join(', ') },
    number('support_pressure', 'pressure', 'kPa', 'support force over the free area', 1000),
  ];
  if (keys.some((k) => k.supported_factor_of_safety !== undefined))
    columns.push({ key: 'supported', name: 'F.S. held', unit: '', title: 'factor of safety with bolts and shotcrete',
      value: (k) => k.supported_factor_of_safety ?? null, show: (k) => k.supported_factor_of_safety?.toFixed(2) ?? '–' },
    number('utilisation', 'used', '%', 'utilisation of its bolts'));
  return columns;
}

const atOnce = 300;

export class KeyblockTable {
  readonly element: HTMLElement;
  private sortBy: string;
  private descending: boolean;
  private limit = atOnce;
  private wanted = '';
  private stale = false;
  private readonly columns: Column[];
  private readonly body = h('tbody', {});
  private readonly head = h('tr', {});
  private readonly foot = h('div', { class: 'note' });

  constructor(private readonly context: Context) {
    this.columns = columnsOf(context.keyblocks);
    this.sortBy = 'batch';
    this.descending = false;
    const search = h('input', { type: 'search', placeholder: 'block or joint …', 'aria-label': 'find in the table',
      input: () => { this.wanted = search.value.trim().toLowerCase(); this.limit = atOnce; this.fill(); } });
    this.element = h('div', { class: 'keyblocks' },
      h('div', { class: 'row' }, search),
      h('div', { class: 'scroll' }, h('table', {}, h('thead', {}, this.head), this.body)), this.foot);
    context.store.listen((_, changed) => {
      if (changed.has('tried')) this.later();
      if (changed.has('selected')) this.mark();
    });
    this.fill();
  }

  /// The rows are made when they are looked at, once a frame.
  private later(): void {
    this.stale = true;
    if (this.element.offsetParent) requestAnimationFrame(() => this.refresh());
  }

  /// When the table is opened, or its rows have changed.
  refresh(): void {
    if (this.stale) this.fill();
  }

  private rows(): Keyblock[] {
    const column = this.columns.find((c) => c.key === this.sortBy)!;
    const found = this.context.keyblocks.filter((k) => this.wanted === '' || String(k.block) === this.wanted ||
      k.planes.some((p) => p.toLowerCase().includes(this.wanted)) || wordsOf(k).startsWith(this.wanted));
    // Batch 0 (stays) comes after the others; equal ones by their support force.
    const value = (k: Keyblock): number | string | null => (column.key === 'batch' && k.batch === 0 ? 1e9 : column.value(k));
    return found.sort((a, b) => {
      const x = value(a);
      const y = value(b);
      const order = x === null ? 1 : y === null ? -1 : x < y ? -1 : x > y ? 1 : 0;
      return (this.descending && x !== null && y !== null ? -order : order) || b.support_force - a.support_force || a.block - b.block;
    });
  }

  private fill(): void {
    this.stale = false;
    this.head.replaceChildren(...this.columns.map((c) => {
      const sorted = c.key === this.sortBy;
      return h('th', { 'aria-sort': sorted ? (this.descending ? 'descending' : 'ascending') : 'none', title: c.title },
        h('button', { type: 'button', click: () => this.sort(c.key) }, c.name, c.unit ? h('small', {}, ` ${c.unit}`) : null,
          sorted ? h('i', {}, this.descending ? ' ↓' : ' ↑') : null));
    }));
    const rows = this.rows();
    this.body.replaceChildren(...rows.slice(0, this.limit).map((k) => this.row(k)));
    const more = rows.length - this.limit;
    this.foot.replaceChildren(`${rows.length} of ${this.context.keyblocks.length} entries`,
      ...(more > 0 ? [' · ', button(`show ${more} more`, 'all rows', () => { this.limit = Infinity; this.fill(); })] : []));
    this.mark();
  }

  private row(k: Keyblock): HTMLTableRowElement {
    return h('tr', { 'data-block': k.block, tabindex: 0,
      click: () => this.open(k.block), keydown: (e: KeyboardEvent) => this.keys(e, k.block) },
      ...this.columns.map((c) => {
        const v = c.value(k);
        const text = c.key === 'batch' && v === 0 ? '–' : c.show ? c.show(k) : typeof v === 'number' ? digits(v, c.key === 'block' ? 9 : 4) : (v ?? '–');
        return h('td', { class: typeof v === 'number' ? 'number' : typeof v === 'string' ? 'words' : undefined }, text);
      }));
  }

  private keys(e: KeyboardEvent, block: number): void {
    const row = e.currentTarget as HTMLElement;
    if (e.key === 'Enter' || e.key === ' ') this.open(block);
    else if (e.key === 'ArrowDown') (row.nextElementSibling as HTMLElement | null)?.focus();
    else if (e.key === 'ArrowUp') (row.previousElementSibling as HTMLElement | null)?.focus();
    else return;
    e.preventDefault();
    e.stopPropagation();
  }

  private open(block: number): void {
    this.context.store.set({ selected: block });
    this.context.flyToBlock(block);
  }

  private sort(key: string): void {
    const text = key === 'mode' || key === 'planes';
    this.descending = key === this.sortBy ? !this.descending : !text && !['block', 'batch', 'factor_of_safety'].includes(key);
    this.sortBy = key;
    this.fill();
  }

  private mark(): void {
    const { selected } = this.context.store.state;
    for (const row of this.body.children) {
      const is = row.getAttribute('data-block') === String(selected);
      row.classList.toggle('selected', is);
      if (is && this.element.offsetParent) row.scrollIntoView({ block: 'nearest' });
    }
  }
}
