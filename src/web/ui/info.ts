// What the page knows of the selected block.
import type { Context } from '../context';
import { classNames, vonMises } from '../fields';
import { digits, quantity } from './format';
import { button, h } from './dom';
import { wordsOf } from './table';

type Fact = [name: string, value: string];

export class BlockInfo {
  readonly element = h('div', { class: 'info' });

  constructor(private readonly context: Context) {
    context.store.listen((_, changed) => {
      if (changed.has('selected') || changed.has('at') || changed.has('hidden') || changed.has('chosen') || changed.has('tried')) this.fill();
    });
    this.fill();
  }

  private fill(): void {
    const id = this.context.store.state.selected;
    const b = id ? this.context.indexOf(id) : undefined;
    if (id === 0) {
      this.element.replaceChildren(h('p', { class: 'note' }, 'Click a block, or type its number into the search above.'));
      return;
    }
    if (b === undefined) {
      this.element.replaceChildren(h('p', { class: 'note' }, `Block ${id} is not on this page.`));
      return;
    }
    this.element.replaceChildren(h('h2', {}, `Block ${id}`), this.actions(id), facts('', this.properties(b)),
      ...this.theory(b, id), ...this.motion(b), ...this.joints(b));
  }

  private actions(id: number): HTMLElement {
    const { store } = this.context;
    const { chosen, hidden, show } = store.state;
    const isolated = show === 'chosen' && chosen.includes(id);
    return h('div', { class: 'row' },
      button('Fly to', 'f', () => this.context.flyToBlock(id)),
      button('Hide', 'h', () => store.set({ hidden: [...hidden, id], selected: 0 })),
      button(isolated ? 'Show all' : 'Isolate', 'i', () => store.set(isolated ? { show: 'all', chosen: [] } : { show: 'chosen', chosen: [id] })));
  }

  private properties(b: number): Fact[] {
    const { arrays, document } = this.context.data;
    const c = arrays.get('centroid');
    const list: Fact[] = [
      ['Volume', `${digits(arrays.get('volume')[b]!)} m³`],
      ['Centroid', [0, 1, 2].map((d) => digits(c[3 * b + d]!)).join(', ') + ' m'],
      ['Material', document.materials[arrays.get('material')[b]!] ?? '–'],
      ['Shape', arrays.get('convex')[b] ? 'convex' : 'not convex'],
      ['Extent', arrays.get('finite')[b] ? 'finite' : 'goes on beyond the model'],
    ];
    const stage = arrays.get('stage')[b]!;
    if (stage > 0) list.push(['Excavated', `at stage ${stage}`]);
    const flags = arrays.find('flags')?.[b] ?? 0;
    if (flags & 1) list.push(['Flag', 'small volume']);
    if (flags & 2) list.push(['Flag', 'elongated']);
    return list;
  }

  private theory(b: number, id: number): HTMLElement[] {
    const { arrays } = this.context.data;
    const classes = arrays.find('class');
    if (!classes) return [];
    const { whatIf } = this.context;
    const list: Fact[] = [['Class', classNames[(whatIf?.values?.class ?? classes)[b]!] ?? '–']];
    const key = this.context.keyblocks.find((k) => k.block === id || k.blocks?.includes(id));
    if (key) {
      const how = wordsOf(key);
      if (key.batch > 0) list.push(['Batch', String(key.batch)]);
      if (key.blocks && key.blocks.length > 1) list.push(['Together with', key.blocks.filter((i) => i !== id).join(', ')]);
      list.push(['Motion', key.planes.length ? `${how}: ${key.planes.join(', ')}` : how]);
      list.push(['Direction', trend(key.direction)]);
      list.push(['Weight', quantity(key.weight, 'N')]);
      list.push(['Factor of safety', key.factor_of_safety === null ? '0, nothing resists' : digits(key.factor_of_safety, 3)]);
      list.push(['Net driving force', quantity(key.sliding_force, 'N')]);
      list.push(['Free area', `${digits(key.free_area)} m²`]);
      list.push(['Support force', quantity(key.support_force, 'N')]);
      list.push(['Support pressure', quantity(key.support_pressure, 'Pa')]);
      if (key.supported_factor_of_safety !== undefined) list.push(['… with support', key.supported_factor_of_safety === null ? '–' : digits(key.supported_factor_of_safety, 3)]);
      if (key.bolts?.length) list.push(['Bolts', key.bolts.map((bolt) => bolt.bolt).join(', ')]);
      if (typeof key.utilisation === 'number') list.push(['Utilisation', `${digits(key.utilisation, 3)} %`]);
    }
    return [facts(whatIf?.active ? 'Block theory, with what is tried' : 'Block theory', list)];
  }

  private motion(b: number): HTMLElement[] {
    const { motion, store, data, surface } = this.context;
    if (motion.states === 0) return [];
    const { at } = store.state;
    const { mean, largest } = motion.ofBlock(b, at);
    const list: Fact[] = [
      ['Time', `${digits(motion.timeAt(at))} s`],
      ['Mean displacement', quantity(Math.hypot(...mean), 'm')],
      ['… east, north, up', mean.map((u) => quantity(u, 'm', 3)).join(', ')],
      ['Largest, of its points', quantity(largest, 'm')],
    ];
    const stress = data.arrays.find('block_stress');
    if (stress) {
      const from = 6 * (Math.round(at) * surface.blockId.length + b);
      list.push(['Von Mises stress', quantity(vonMises(stress.subarray(from, from + 6)), 'Pa')]);
    }
    return [facts('Motion', list)];
  }

  /// The joints around it, as "name dip/direction".
  private joints(b: number): HTMLElement[] {
    const { surface, data } = this.context;
    const names = new Set<string>();
    for (let t = surface.triangleBegin[b]!; t < surface.triangleBegin[b + 1]!; ++t) {
      const origin = data.document.origins[surface.origin[t]!];
      if (origin) names.add(origin.name);
    }
    return [facts('Faces', [['Lie in', [...names].join(', ')]])];
  }
}

function trend([x, y, z]: [number, number, number]): string {
  const plunge = (Math.atan2(-z, Math.hypot(x, y)) * 180) / Math.PI;
  const direction = ((Math.atan2(x, y) * 180) / Math.PI + 360) % 360;
  if (Math.abs(plunge) > 89) return plunge > 0 ? 'down' : 'up';
  return `towards ${String(Math.round(direction) % 360).padStart(3, '0')}°, ${Math.abs(Math.round(plunge))}° ${plunge < 0 ? 'up' : 'down'}`;
}

function facts(title: string, list: Fact[]): HTMLElement {
  return h('section', {}, title ? h('h3', {}, title) : null,
    h('dl', {}, ...list.flatMap(([name, value]) => [h('dt', {}, name), h('dd', {}, value)])));
}

