// Which blocks are solid, ghosts or hidden.
import type { Arrays } from './data';
import { Flag } from './scene/shaders';
import type { Surface } from './scene/surface';
import type { ViewState } from './view_state';

export const keyClass = 3;

/// Flags of shaders.ts for each block. [N] `moved` [N]: the blocks of show = 'moved'; `classes` [N]: others than the result's; `seeThrough`: none is solid.
export function blockFlags(state: ViewState, surface: Surface, arrays: Arrays, more: { moved?: Uint8Array; classes?: ArrayLike<number>; seeThrough?: boolean } = {}): Uint8Array {
  const flags = new Uint8Array(surface.blockId.length);
  const stage = arrays.get('stage');
  const classes = more.classes ?? arrays.find('class');
  const finite = arrays.get('finite');
  const chosen = new Set(state.chosen);
  const hidden = new Set(state.hidden);
  const shown = (b: number, id: number): boolean =>
    state.show === 'all' || (state.show === 'key' && classes?.[b] === keyClass) ||
    (state.show === 'finite' && finite[b] === 1) || (state.show === 'moved' && more.moved?.[b] === 1) || (state.show === 'chosen' && chosen.has(id));
  for (let b = 0; b < flags.length; ++b) {
    const id = surface.blockId[b]!;
    const gone = stage[b]! > 0 && (state.stage < 0 || stage[b]! <= state.stage);
    if (gone || hidden.has(id)) flags[b] = Flag.hidden;
    else if (id === state.selected) flags[b] = Flag.selected;
    else if (!shown(b, id)) flags[b] = { ghost: Flag.ghost, hidden: Flag.hidden, solid: Flag.solid }[state.rest];
    else flags[b] = state.opacity < 1 || more.seeThrough ? Flag.ghost : Flag.solid;
  }
  return flags;
}
