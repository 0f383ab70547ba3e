// What a result is first shown as.
import type { PageData } from './data';
import { niceStep } from './ui/format';
import type { Motion } from './motion';
import { radius, type Surface } from './scene/surface';
import { initialState, type ViewState } from './view_state';

/// States that are looked at for how far rock moves.
const mostLookedAt = 20;
/// Of the model's size: displacements that are less are rounding.
const leastDisplacement = 1e-10;

/// Displacements are first drawn so large that the largest is a fortieth of the model, or as they are if that is less.
export function firstMagnification(surface: Surface, motion: Motion): number {
  const last = motion.states - 1;
  const size = radius(surface);
  let largest = 0;
  for (let k = Math.min(last, mostLookedAt - 1), n = k; k >= 0; --k) {
    const u = motion.displacement(n > 0 ? Math.round((k * last) / n) : last);
    for (let i = 0; i < u.length; i += 3) largest = Math.max(largest, Math.hypot(u[i]!, u[i + 1]!, u[i + 2]!));
  }
  const wanted = size / 40;
  return largest > leastDisplacement * size && largest < wanted ? niceStep(wanted / largest, 1) / 2 || 1 : 1;
}

/// Rock all round an opening hides it: then the model is cut through the opening's middle, lengthwise.
function sectionThroughOpenings(data: PageData, surface: Surface): ViewState['clip'] | undefined {
  const kinds = data.document.origins.map((o) => (o.kind === 2 ? 'wall' : o.kind === 1 && !o.continues ? 'free' : 'other'));
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let t = 0; t < surface.origin.length; ++t) {
    const kind = kinds[surface.origin[t]!];
    if (kind === 'free') return undefined;
    if (kind !== 'wall') continue;
    for (let c = 0; c < 3; ++c)
      for (let d = 0; d < 3; ++d) {
        const x = surface.point[3 * (surface.corner[3 * t + c]! >>> 3) + d]!;
        low[d] = Math.min(low[d]!, x);
        high[d] = Math.max(high[d]!, x);
      }
  }
  if (!(high[0]! > low[0]!)) return undefined;
  const axis = high[0]! - low[0]! <= high[1]! - low[1]! ? 0 : 1;
  const clip = initialState().clip;
  const extent = surface.high[axis]! - surface.low[axis]!;
  clip[axis] = { on: true, at: (0.5 * (low[axis]! + high[axis]!) - surface.low[axis]!) / extent, flip: axis === 1 };
  return clip;
}

export function firstState(data: PageData, surface: Surface, motion: Motion): ViewState {
  const state = initialState();
  const keys = data.arrays.find('class');
  state.field = keys ? (Array.from(keys).some((c) => c === 3) ? 'batch' : 'class') : motion.states > 0 ? 'displacement' : 'id';
  state.at = Math.max(0, motion.states - 1);
  state.magnify = firstMagnification(surface, motion);
  state.clip = sectionThroughOpenings(data, surface) ?? state.clip;
  return state;
}
