// The views of a printed report: the page's own pictures, drawn once when the report is opened, as images.
import { App } from './app';
import { readPage } from './data';
import { h } from './ui/dom';
import type { ViewState } from './view_state';

interface View {
  caption: string;
  state: Partial<ViewState>;
  from?: [azimuth: number, elevation: number];
}

/// What is worth a picture of this result.
export function viewsOf(app: App): View[] {
  const has = (field: string): boolean => app.fields.some((f) => f.key === field);
  const label = (field: string): string => app.fields.find((f) => f.key === field)!.label.toLowerCase();
  const last = Math.max(0, app.motion.states - 1);
  const first = app.store.state.field;
  const views: View[] = [{ caption: `The model, coloured by ${label(first)}`, state: {} },
    { caption: `From the other side, coloured by ${label(first)}`, state: {}, from: [138, 28] }];
  if (app.poles.length && has('joint')) views.push({ caption: 'The joint set of each face, blocks pulled apart', state: { field: 'joint', explode: 0.4 } });
  if (app.keyblocks.some((k) => k.batch > 0)) {
    const state: Partial<ViewState> = { show: 'key', rest: 'ghost' };
    views.push({ caption: 'Key blocks by factor of safety, the others as ghosts', state: { ...state, field: 'factor_of_safety' } });
    if (has('supported_factor_of_safety'))
      views.push({ caption: 'Key blocks by factor of safety with support', state: { ...state, field: 'supported_factor_of_safety' } });
  }
  if (app.motion.states > 1) {
    views.push({ caption: 'Displacement at the end', state: { field: 'displacement', at: last } });
    if (has('contact_state')) {
      views.push({ caption: 'Contact points at the end by their state', state: { field: 'contact_state', at: last, symbols: false } });
      views.push({ caption: 'Blocks that moved by more than a hundredth of their size', state: { field: 'moved', at: last } });
    }
    if (has('von_mises')) views.push({ caption: `${app.fields.find((f) => f.key === 'von_mises')!.label} at the end`, state: { field: 'von_mises', at: last } });
  }
  return views;
}

async function draw(app: App, place: HTMLElement): Promise<void> {
  const start = { ...app.store.state };
  for (const { caption, state, from } of viewsOf(app)) {
    app.store.set({ ...start, theme: 'light', ...state, camera: [] });
    app.lookFrom(...(from ?? ([-42, 28] as [number, number])), false);
    const scale = app.store.state.magnify;
    const moves = app.motion.states > 0 && app.store.state.at > 0 && scale !== 1;
    const image = h('img', { src: URL.createObjectURL(await app.picture(1.25)), alt: caption });
    await image.decode();
    place.append(h('figure', { class: 'view' }, image, h('figcaption', {}, moves ? `${caption}; displacements drawn ${scale} times as large.` : `${caption}.`)));
  }
}

async function start(): Promise<void> {
  const place = document.getElementById('views')!;
  const note = document.getElementById('views-note')!;
  const root = h('div', { class: 'renderer' });
  document.body.append(root);
  try {
    const app = new App(root, await readPage(document), false);
    await draw(app, place);
    app.scene.beforeFrame = () => {}; // a last frame may be on its way
    app.scene.renderer.dispose();
    note.remove();
    document.documentElement.dataset.ready = 'yes';
  } catch (error) {
    note.textContent = `The views could not be drawn here (${error instanceof Error ? error.message : String(error)}): a browser with WebGL 2 draws them.`;
    document.documentElement.dataset.ready = 'failed';
  }
  root.remove();
}

void start();
