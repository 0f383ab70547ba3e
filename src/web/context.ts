// What the parts of the page share.
import type { CameraControl } from './scene/camera';
import type { Scene } from './scene/scene';
import type { Keyblock, PageData, Support } from './data';
import type { Field, Pole } from './fields';
import type { Motion } from './motion';
import type { Surface } from './scene/surface';
import type { WhatIf } from './block_theory/what_if';
import type { Store } from './view_state';

export interface Context {
  data: PageData;
  surface: Surface;
  motion: Motion;
  fields: Field[];
  poles: Pole[];
  store: Store;
  scene: Scene;
  control: CameraControl;
  support: Support;
  whatIf: WhatIf | undefined;
  /// Key blocks, then those that stay below the target or that bolts cross: the program's, or what follows from what is tried.
  keyblocks: Keyblock[];
  /// 0 … N-1 of an id, or undefined where the page does not show it.
  indexOf(id: number): number | undefined;
  flyToBlock(id: number): void;
  /// Limits of the map as they are now.
  limits(): [number, number];
  field(): Field;
  /// Where a monitor is drawn, relative to the model's middle.
  monitorPlace(name: string): number[];
}

/// Key blocks and bolts stand at the top of what `support` answers, and inside of what `run` and `demo` do.
export function supportOf(data: PageData): Support {
  const answer = data.document.answer;
  return answer?.support ?? answer ?? {};
}
