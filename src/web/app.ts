// The page: makes its parts, and carries changes of the view to the picture.
import * as THREE from 'three';
import { categoryBytes, mapBytes, mapColour, type Rgb } from './colour';
import { Contacts } from './contacts';
import { type Context, supportOf } from './context';
import type { Keyblock, PageData } from './data';
import { makeFields, paintMaterials, poles, rangeOf, type Field } from './fields';
import { firstState } from './first_view';
import { Keyboard } from './ui/keyboard';
import { historyAt, Motion } from './motion';
import { CameraControl } from './scene/camera';
import { ContactPoints } from './scene/contact_points';
import { DeadEnds } from './scene/dead_ends';
import { Scene } from './scene/scene';
import { boltRods, Marks, motionArrows, waterLevels } from './scene/symbols';
import { type ClipPlane, sectionLines } from './scene/section';
import { readSurface, type Surface } from './scene/surface';
import { Controls, views } from './ui/controls';
import { h } from './ui/dom';
import { header, helpDialog } from './ui/header';
import { Overlay } from './ui/overlay';
import { movingBlocks } from './ui/format';
import { overlayStyle, themes, variables } from './ui/overlay_style';
import { sidePanel } from './ui/side_panel';
import { Timeline } from './ui/timeline';
import { blockFlags } from './visibility';
import { WhatIf } from './block_theory/what_if';
import { decodeState, encodeState, Store, type ViewState } from './view_state';

export class App implements Context {
  readonly surface: Surface;
  readonly motion: Motion;
  readonly fields: Field[];
  readonly poles;
  readonly store: Store;
  readonly scene: Scene;
  readonly control: CameraControl;
  readonly support;
  readonly whatIf: WhatIf | undefined;
  private readonly answered;
  private firstPose = '';
  readonly timeline: Timeline | null;
  private readonly index = new Map<number, number>();
  private readonly ranges = new Map<string, [number, number]>();
  private readonly first: ViewState;
  private readonly overlay: Overlay;
  private readonly marks: Marks;
  private readonly contacts: Contacts | undefined;
  private readonly dots = new ContactPoints();
  private readonly deadEnds: DeadEnds;
  private readonly waterLevel: THREE.Object3D;
  private readonly help = helpDialog();
  private addressTimer = 0;

  /// Not `alone`: without panels, keys and address, for pictures within another page.
  constructor(private readonly root: HTMLElement, readonly data: PageData, private readonly alone = true) {
    this.surface = readSurface(data.arrays);
    this.motion = new Motion(this.surface, data.arrays);
    this.whatIf = WhatIf.of(data, this.surface);
    this.fields = makeFields(data, this.surface, this.motion, this.whatIf);
    this.contacts = Contacts.read(data.arrays, this.surface, this.motion);
    this.poles = poles(this.surface, data);
    this.support = supportOf(data);
    this.answered = [...(this.support.keyblocks ?? []), ...(this.support.stable ?? []).map((k) => ({ ...k, batch: 0 }))];
    this.surface.blockId.forEach((id, b) => this.index.set(id, b));
    this.first = firstState(data, this.surface, this.motion);
    this.store = new Store(alone ? decodeState(location.hash, this.first) : { ...this.first });
    this.whatIf?.apply(this.store.state.tried);
    paintMaterials(this.fields, this.store.state.paint);
    this.store.listen((state, changed) => { // before all who show it
      if (changed.has('tried')) this.whatIf?.apply(state.tried);
      if (changed.has('paint')) paintMaterials(this.fields, state.paint);
    });
    if (!this.fields.some((f) => f.key === this.store.state.field)) this.store.state.field = this.first.field;
    const canvas = h('canvas', { id: 'view', tabindex: 0, 'aria-label': 'the model' });
    this.scene = new Scene(canvas, data, this.surface, this.motion);
    this.control = new CameraControl(this.scene.camera, canvas, this.scene.radius);
    this.overlay = new Overlay(this);
    this.timeline = this.motion.states > 1 ? new Timeline(this) : null;
    this.marks = new Marks(data.document.answer?.marks ?? [], data.document.origin);
    const marks = data.document.answer?.marks ?? [];
    this.waterLevel = waterLevels(marks, data.document.origin, this.scene.radius);
    this.scene.extras.add(boltRods(data.document.answer?.bolts ?? this.support.bolts ?? [], data.document.origin, this.scene.radius), this.waterLevel, this.marks.object);
    const stability = data.document.answer?.stability;
    if (stability) this.scene.extras.add(motionArrows(movingBlocks(stability), (id) => this.middleOf(id), this.scene.radius));
    this.scene.add(this.dots.object);
    this.deadEnds = new DeadEnds(data, this.surface);
    this.scene.add(this.deadEnds.object);
    this.build(canvas);
    this.wire(canvas);
  }

  private build(canvas: HTMLCanvasElement): void {
    if (!this.alone) {
      this.root.replaceChildren(h('main', {}, canvas, this.overlay.element));
      return;
    }
    document.title = `${this.data.document.title || this.data.document.file} – Rockfold`;
    document.head.append(h('style', {}, overlayStyle));
    const controls = new Controls(this, (azimuth, elevation) => this.lookFrom(azimuth, elevation));
    this.root.replaceChildren(
      header(this, { picture: () => void this.savePicture(), theme: () => this.nextTheme(), panels: (side) => this.togglePanel(side) }, this.help),
      controls.element, h('main', {}, canvas, this.overlay.element), sidePanel(this), ...(this.timeline ? [this.timeline.element] : []), this.help);
    if (innerWidth < 900) this.root.classList.add('no-left', 'no-right');
    else if (innerWidth < 1180) this.root.classList.add('no-right');
  }

  private wire(canvas: HTMLCanvasElement): void {
    this.store.listen((_, changed) => this.apply(changed));
    this.scene.ratioChanged = (ratio) => {
      this.marks.setSize(15 * ratio);
      this.dots.setSize(8 * ratio);
    };
    this.scene.beforeFrame = () => this.overlay.update(this.themeName());
    this.control.onChange = () => { this.scene.request(); this.rememberAddress(); };
    this.control.onClick = (x, y) => this.pick(x, y);
    this.control.onDoubleClick = (x, y) => this.goTo(x, y);
    if (this.alone) new Keyboard(this, this.help, { lookFrom: (a, e) => this.lookFrom(a, e), reset: () => this.reset(), theme: () => this.nextTheme() });
    new ResizeObserver(() => {
      // What nobody has turned yet stays as a whole in the picture, whose shape may change while the page is laid out.
      const untouched = this.control.pose.join() === this.firstPose;
      this.resize();
      if (untouched) this.reset(false);
    }).observe(canvas.parentElement!);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.apply(new Set(['theme'])));
    if (this.alone) addEventListener('hashchange', () => this.followAddress());
    this.resize();
    this.reset(false);
    if (this.store.state.camera.length === 6) this.control.pose = this.store.state.camera;
    this.apply(new Set(Object.keys(this.store.state) as (keyof ViewState)[]));
  }

  get keyblocks(): Keyblock[] {
    return this.whatIf?.active ? this.whatIf.rows() : this.answered;
  }

  field(): Field {
    return this.fields.find((f) => f.key === this.store.state.field) ?? this.fields[0]!;
  }

  limits(): [number, number] {
    const field = this.field();
    let range = this.ranges.get(field.key);
    if (!range) this.ranges.set(field.key, (range = rangeOf(field, this.motion.states)));
    const { low, high } = this.store.state;
    return [low ?? range[0], high ?? range[1]];
  }

  indexOf(id: number): number | undefined {
    return this.index.get(id);
  }

  /// Where the camera should look to see a block, and how large the block is.
  private blockPlace(b: number): { middle: THREE.Vector3; size: number } {
    const box = new THREE.Box3();
    const p = new THREE.Vector3();
    for (let i = this.surface.pointBegin[b]!; i < this.surface.pointBegin[b + 1]!; ++i)
      box.expandByPoint(p.fromArray(this.surface.point, 3 * i));
    const middle = box.getCenter(new THREE.Vector3());
    const centroid = this.data.arrays.get('centroid');
    for (let d = 0; d < 3; ++d)
      middle.setComponent(d, middle.getComponent(d) + this.store.state.explode * (centroid[3 * b + d]! - this.data.document.origin[d]!));
    return { middle, size: box.getSize(p).length() };
  }

  /// Where a block's middle is before any motion, relative to the model's.
  private middleOf(id: number): number[] | undefined {
    const b = this.indexOf(id);
    const centroid = this.data.arrays.get('centroid');
    return b === undefined ? undefined : [0, 1, 2].map((d) => centroid[3 * b + d]! - this.data.document.origin[d]!);
  }

  flyToBlock(id: number): void {
    const b = this.indexOf(id);
    if (b === undefined) return;
    const { middle, size } = this.blockPlace(b);
    this.control.flyTo(middle, Math.max(3.2 * size, 0.02 * this.scene.radius));
  }

  /// The box that holds the model in all of its states, as they are drawn.
  private drawnBox(): THREE.Box3 {
    const { explode, magnify } = this.store.state;
    const box = new THREE.Box3(new THREE.Vector3(...this.surface.low), new THREE.Vector3(...this.surface.high));
    box.min.multiplyScalar(1 + explode);
    box.max.multiplyScalar(1 + explode);
    const last = this.motion.states - 1;
    const p = new THREE.Vector3();
    for (const s of last > 0 ? [0.25, 0.5, 0.75, 1].map((share) => Math.round(share * last)) : []) {
      const u = this.motion.displacement(s);
      for (let i = 0; i < u.length; i += 3) {
        p.fromArray(this.surface.point, i);
        box.expandByPoint(p.set(p.x + magnify * u[i]!, p.y + magnify * u[i + 1]!, p.z + magnify * u[i + 2]!));
      }
    }
    return box;
  }

  /// What sections leave of it.
  private seenBox(): THREE.Box3 {
    const box = this.drawnBox();
    this.store.state.clip.forEach((c, axis) => {
      if (!c.on) return;
      const [low, high] = [this.surface.low[axis]!, this.surface.high[axis]!];
      const at = (1 + this.store.state.explode) * (low + c.at * (high - low));
      if (c.flip) box.min.setComponent(axis, Math.max(box.min.getComponent(axis), at));
      else box.max.setComponent(axis, Math.min(box.max.getComponent(axis), at));
    });
    return box.isEmpty() ? this.drawnBox() : box;
  }

  lookFrom(azimuth: number, elevation: number, slowly = true): void {
    if (slowly) this.store.set({ fly: false });
    const box = this.seenBox();
    const [a, e] = [(azimuth * Math.PI) / 180, (elevation * Math.PI) / 180];
    const middle = box.getCenter(new THREE.Vector3());
    const distance = this.control.distanceFor(box.getSize(new THREE.Vector3()).multiplyScalar(0.5), a, e);
    this.scene.reach = Math.max(this.scene.radius, middle.length() + 0.5 * box.getSize(new THREE.Vector3()).length());
    if (slowly) this.control.flyTo(middle, distance, a, e);
    else this.control.jumpTo(middle, distance, a, e);
  }

  private reset(all = true): void {
    if (all) this.store.set({ ...this.first, camera: [] });
    this.lookFrom(...views.Slanted!, false);
    this.firstPose = this.control.pose.join();
  }

  private pick(x: number, y: number): void {
    const found = this.scene.pick(x, y);
    this.store.set({ selected: found ? this.surface.blockId[found.block]! : 0 });
  }

  private goTo(x: number, y: number): void {
    const found = this.scene.pick(x, y);
    if (found) this.control.flyTo(found.at, Math.max(0.3 * this.control.distance, 0.05 * this.scene.radius));
  }

  private resize(): void {
    const box = this.scene.canvas.parentElement!.getBoundingClientRect();
    this.scene.resize(Math.max(1, Math.round(box.width)), Math.max(1, Math.round(box.height)), devicePixelRatio);
    this.scene.request();
  }

  private themeName(): 'light' | 'dark' {
    const { theme } = this.store.state;
    return theme === 'auto' ? (matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light') : theme;
  }

  private nextTheme(): void {
    this.store.set({ theme: this.themeName() === 'dark' ? 'light' : 'dark' });
  }

  private togglePanel(side: 'left' | 'right'): void {
    this.root.classList.toggle(`no-${side}`);
    // On a narrow screen one panel at a time covers the picture.
    if (innerWidth < 900 && !this.root.classList.contains(`no-${side}`)) this.root.classList.add(side === 'left' ? 'no-right' : 'no-left');
    this.resize();
  }

  /// A PNG of `ratio` times the size on the screen, with legend, scale and directions.
  picture(ratio: number): Promise<Blob> {
    return this.overlay.picture(themes[this.themeName()], ratio, this.alone);
  }

  private async savePicture(): Promise<void> {
    const blob = await this.picture(2);
    const url = URL.createObjectURL(blob);
    h('a', { href: url, download: `${this.data.document.file.replace(/\.vtkhdf$/, '')}.png` }).click();
    setTimeout(() => URL.revokeObjectURL(url), 10000);
  }

  /// Carries changes of the view to the picture.
  private apply(changed: Set<keyof ViewState>): void {
    const has = (...keys: (keyof ViewState)[]): boolean => keys.some((k) => changed.has(k));
    const { state } = this.store;
    if (has('theme')) this.showTheme();
    if (has('tried')) this.waterLevel.position.z = this.whatIf?.waterRise ?? 0;
    if (has('fly')) this.control.fly = state.fly;
    if (has('fly', 'clip')) this.scene.showBacks(state.fly || state.clip.some((c) => c.on));
    const flagged = has('show', 'rest', 'stage', 'selected', 'chosen', 'hidden', 'opacity', 'field', 'tried') || (has('at') && state.show === 'moved');
    if (flagged) this.scene.setFlags(this.flags(state));
    if (has('field', 'paint', 'low', 'high', 'tried') || (has('at') && this.field().changes && !this.field().shader)) this.showValues();
    if (has('at', 'magnify')) this.scene.setMotion(state.at, state.magnify);
    if (has('magnify', 'explode')) this.scene.reach = Math.max(this.scene.reach, this.drawnBox().max.distanceTo(this.drawnBox().min));
    if (has('field', 'low', 'high', 'at', 'magnify', 'explode', 'joint')) this.showContacts();
    if (has('explode', 'edges', 'texture', 'opacity', 'joint', 'show', 'rest', 'field')) this.showLook();
    if (has('clip') || (state.clip.some((c) => c.on) && has('at', 'magnify', 'explode', 'show', 'rest', 'stage', 'chosen', 'hidden', 'opacity'))) this.showClip();
    // Dead ends stand in the rock as it was cut.
    if (flagged || has('joint', 'explode')) this.deadEnds.show(state.explode === 0 ? state.joint : -1, this.scene.flags);
    if (has('at', 'magnify')) this.marks.follow((name) => this.monitorPlace(name));
    this.scene.extras.visible = state.symbols && state.explode === 0; // symbols stand in the rock, not in blocks pulled apart
    this.scene.request();
    this.rememberAddress();
  }

  /// Where a monitor is drawn, relative to the model's middle.
  monitorPlace(name: string): number[] {
    const { answer, origin } = this.data.document;
    const { at, magnify } = this.store.state;
    const start = answer?.marks?.find((m) => m.kind === 'monitor' && m.name === name)?.points[0] ?? origin;
    const history = answer?.monitors?.find((m) => m.name === name);
    const u = history?.displacement ? historyAt(history.time, history.displacement, this.motion.timeAt(at)) : [0, 0, 0];
    return start.map((x, d) => x - origin[d]! + magnify * u[d]!);
  }

  private showTheme(): void {
    const theme = themes[this.themeName()];
    document.documentElement.dataset.theme = this.themeName();
    document.documentElement.setAttribute('style', variables(theme));
    this.scene.setPalette({ background: theme.background, ink: '#0c0e11', none: theme.none, accent: theme.accent });
  }

  private showValues(): void {
    const field = this.field();
    const [low, high] = this.limits();
    const names = field.categories?.map((c) => c.colour);
    this.scene.setMap(names ? categoryBytes(names) : mapBytes(field.map ?? 'sequential'), !!names);
    if (field.of === 'contact') this.scene.setValues('block', new Float32Array(this.surface.blockId.length).fill(NaN), 0, 1);
    else if (field.shader) this.scene.setDisplacementValues(field.shader, low, high);
    else this.scene.setValues(field.of, field.values(this.store.state.at), low, high);
  }

  private flags(state: ViewState): Uint8Array {
    const moved = state.show === 'moved' ? this.motion.moved(state.at, this.data.arrays.get('volume')) : undefined;
    return blockFlags(state, this.surface, this.data.arrays, { ...(moved ? { moved } : {}), ...(this.whatIf?.values ? { classes: this.whatIf.values.class } : {}), seeThrough: this.field().of === 'contact' });
  }

  /// The dots of contact points, where they are what is coloured.
  private showContacts(): void {
    const field = this.field();
    const shown = field.of === 'contact' && !!this.contacts;
    this.dots.object.visible = shown;
    if (!shown) return;
    const { at, magnify, explode, joint } = this.store.state;
    const [low, high] = this.limits();
    const none: Rgb = [0.65, 0.65, 0.65];
    const colour = (v: number): Rgb => {
      if (Number.isNaN(v)) return none;
      if (field.categories) return field.categories[v]?.colour ?? none;
      return mapColour(field.map ?? 'sequential', (v - low) / (high - low || 1));
    };
    const centroid = this.data.arrays.get('centroid');
    const shift = (b: number): number[] => [0, 1, 2].map((d) => explode * (centroid[3 * b + d]! - this.data.document.origin[d]!));
    this.dots.show(this.contacts!.positions(at, magnify, shift), Array.from(field.values(at), colour), this.contacts!.shown(at, joint));
  }

  private showLook(): void {
    const { explode, edges, texture, opacity, joint } = this.store.state;
    const filtered = 0.22 / Math.cbrt(this.surface.blockId.length);
    this.scene.setLook({ explode, edges, texture, joint, ghost: opacity < 1 ? opacity : this.field().of === 'contact' ? Math.max(0.05, filtered) : Math.max(0.012, filtered) });
  }

  private showClip(): void {
    const { state } = this.store;
    const planes: ClipPlane[] = state.clip.flatMap((c, axis) => {
      if (!c.on) return [];
      const sign = c.flip ? -1 : 1;
      const normal: [number, number, number] = [0, 0, 0];
      normal[axis] = sign;
      const extent = this.surface.high[axis]! - this.surface.low[axis]!;
      // A hair off the place asked for: planes of joints and faces would flicker on the cut.
      return [{ normal, distance: sign * (1 + state.explode) * (this.surface.low[axis]! + (c.at + 1.3e-5) * extent) }];
    });
    const flags = this.flags({ ...state, selected: 0 });
    const position = this.positions();
    this.scene.setClip(planes, state.edges ? planes.map((p) => sectionLines(this.surface, position, p, (b) => flags[b] === 0)) : []);
    this.marks.clip(planes);
    this.dots.clip(planes);
    this.deadEnds.clip(planes);
  }

  /// Where the points are drawn now.
  private positions(): Float32Array {
    const { at, magnify, explode } = this.store.state;
    const out = Float32Array.from(this.surface.point);
    const u = this.motion.states > 0 ? this.motion.displacement(at) : undefined;
    const centroid = this.data.arrays.get('centroid');
    for (let i = 0; i < out.length; ++i) {
      if (u) out[i] = out[i]! + magnify * u[i]!;
      if (explode > 0) {
        const b = this.surface.blockOfPoint[(i / 3) | 0]!;
        out[i] = out[i]! + explode * (centroid[3 * b + (i % 3)]! - this.data.document.origin[i % 3]!);
      }
    }
    return out;
  }

  /// The view goes into the address a moment after it has come to rest.
  private rememberAddress(): void {
    if (!this.alone) return;
    clearTimeout(this.addressTimer);
    this.addressTimer = window.setTimeout(() => {
      const text = encodeState({ ...this.store.state, camera: this.control.pose }, this.first);
      if (`#${text}` === location.hash) return;
      try {
        history.replaceState(null, '', `#${text}`);
      } catch {
        // Some browsers guard the addresses of files: then the address stays as it is.
      }
    }, 300);
  }

  private followAddress(): void {
    const state = decodeState(location.hash, this.first);
    if (state.camera.length === 6) this.control.pose = state.camera;
    this.store.set(state);
  }
}
