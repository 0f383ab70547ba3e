// Orbiting the model and flying through it, with mouse, touch and keys. z is up; coordinates are relative to the
// model's middle.
import * as THREE from 'three';

const quarter = Math.PI / 2 - 1e-3;

export class CameraControl {
  readonly target = new THREE.Vector3();
  azimuth = -0.7; // of the eye as seen from the target, from east towards north
  elevation = 0.5;
  distance = 1;
  fly = false;
  onChange: () => void = () => {};
  onClick: (x: number, y: number) => void = () => {};
  onDoubleClick: (x: number, y: number) => void = () => {};
  private readonly pressed = new Set<string>();
  private readonly pointers = new Map<number, { x: number; y: number }>();
  private moved = 0;
  private last = 0;
  private flight = 0;

  constructor(private readonly camera: THREE.PerspectiveCamera, private readonly canvas: HTMLElement, private readonly radius: number) {
    this.distance = 3.4 * radius;
    canvas.addEventListener('pointerdown', (e) => this.press(e));
    canvas.addEventListener('pointermove', (e) => this.drag(e));
    canvas.addEventListener('pointerup', (e) => this.release(e));
    canvas.addEventListener('pointercancel', (e) => this.pointers.delete(e.pointerId));
    canvas.addEventListener('wheel', (e) => this.wheel(e), { passive: false });
    canvas.addEventListener('dblclick', (e) => this.onDoubleClick(e.offsetX, e.offsetY));
    canvas.addEventListener('contextmenu', (e) => e.preventDefault());
    window.addEventListener('blur', () => this.pressed.clear());
    this.place();
  }

  get direction(): THREE.Vector3 {
    const c = Math.cos(this.elevation);
    return new THREE.Vector3(c * Math.cos(this.azimuth), c * Math.sin(this.azimuth), Math.sin(this.elevation));
  }

  private place(): void {
    this.camera.position.copy(this.target).addScaledVector(this.direction, this.distance);
    this.camera.lookAt(this.target);
    this.camera.updateMatrixWorld();
  }

  private changed(): void {
    this.place();
    this.onChange();
  }

  /// The distance from which a box (half its extents, about the target) is seen as a whole.
  distanceFor(half: THREE.Vector3, azimuth: number, elevation: number): number {
    const c = Math.cos(elevation);
    const back = new THREE.Vector3(c * Math.cos(azimuth), c * Math.sin(azimuth), Math.sin(elevation));
    const right = new THREE.Vector3(-Math.sin(azimuth), Math.cos(azimuth), 0);
    const up = new THREE.Vector3().crossVectors(back, right);
    const high = Math.tan((this.camera.fov * Math.PI) / 360);
    const wide = high * this.camera.aspect;
    let least = 0;
    for (const x of [-half.x, half.x])
      for (const y of [-half.y, half.y])
        for (const z of [-half.z, half.z]) {
          const corner = new THREE.Vector3(x, y, z);
          const need = Math.max(Math.abs(corner.dot(right)) / wide, Math.abs(corner.dot(up)) / high);
          least = Math.max(least, corner.dot(back) + 1.08 * need);
        }
    return least;
  }

  /// The view as six numbers: eye, target.
  get pose(): number[] {
    return [...this.camera.position.toArray(), ...this.target.toArray()];
  }
  set pose(pose: number[]) {
    const eye = new THREE.Vector3().fromArray(pose);
    this.target.fromArray(pose, 3);
    this.look(eye.sub(this.target));
    this.changed();
  }

  private look(arm: THREE.Vector3): void {
    this.distance = Math.max(arm.length(), 1e-3 * this.radius);
    this.azimuth = Math.atan2(arm.y, arm.x);
    this.elevation = Math.asin(Math.min(1, Math.max(-1, arm.z / this.distance)));
    this.elevation = Math.min(quarter, Math.max(-quarter, this.elevation));
  }

  /// Turns and moves in a third of a second; at once for those who asked for less motion.
  flyTo(target: THREE.Vector3, distance: number, azimuth = this.azimuth, elevation = this.elevation): void {
    const from = { target: this.target.clone(), distance: this.distance, azimuth: this.azimuth, elevation: this.elevation };
    const turn = Math.atan2(Math.sin(azimuth - from.azimuth), Math.cos(azimuth - from.azimuth));
    const still = matchMedia('(prefers-reduced-motion: reduce)').matches;
    const began = performance.now();
    const flight = ++this.flight;
    const step = (): void => {
      if (flight !== this.flight) return;
      const t = still ? 1 : Math.min(1, (performance.now() - began) / 350);
      const share = t * t * (3 - 2 * t);
      this.target.lerpVectors(from.target, target, share);
      this.distance = from.distance * (distance / from.distance) ** share;
      this.azimuth = from.azimuth + share * turn;
      this.elevation = from.elevation + share * (elevation - from.elevation);
      this.changed();
      if (t < 1) requestAnimationFrame(step);
    };
    step();
  }

  jumpTo(target: THREE.Vector3, distance: number, azimuth: number, elevation: number): void {
    this.target.copy(target);
    Object.assign(this, { distance, azimuth, elevation });
    this.changed();
  }

  private press(e: PointerEvent): void {
    this.canvas.setPointerCapture(e.pointerId);
    this.pointers.set(e.pointerId, { x: e.offsetX, y: e.offsetY });
    this.moved = 0;
    ++this.flight;
  }

  private release(e: PointerEvent): void {
    const alone = this.pointers.size === 1;
    this.pointers.delete(e.pointerId);
    if (alone && this.moved < 4 && e.button === 0) this.onClick(e.offsetX, e.offsetY);
  }

  private drag(e: PointerEvent): void {
    const before = this.pointers.get(e.pointerId);
    if (!before) return;
    const dx = e.offsetX - before.x;
    const dy = e.offsetY - before.y;
    this.moved += Math.abs(dx) + Math.abs(dy);
    if (this.pointers.size === 2) {
      const other = [...this.pointers].find(([id]) => id !== e.pointerId)![1];
      const was = Math.hypot(before.x - other.x, before.y - other.y);
      const is = Math.hypot(e.offsetX - other.x, e.offsetY - other.y);
      if (was > 0 && is > 0) this.distance *= was / is;
      this.pan(dx / 2, dy / 2);
    } else if (e.buttons & 6 || e.shiftKey || e.ctrlKey) {
      this.pan(dx, dy);
    } else {
      this.turn((-dx * 2 * Math.PI) / 900, (dy * Math.PI) / 600);
    }
    this.pointers.set(e.pointerId, { x: e.offsetX, y: e.offsetY });
    this.changed();
  }

  turn(azimuth: number, elevation: number): void {
    const eye = this.camera.position.clone();
    this.azimuth += this.fly ? azimuth * 0.6 : azimuth;
    this.elevation = Math.min(quarter, Math.max(-quarter, this.elevation + (this.fly ? elevation * 0.6 : elevation)));
    if (this.fly) this.target.copy(eye).addScaledVector(this.direction, -this.distance); // the eye stays
  }

  pan(dx: number, dy: number): void {
    const pixel = (2 * this.distance * Math.tan((this.camera.fov * Math.PI) / 360)) / this.canvas.clientHeight;
    const e = this.camera.matrixWorld.elements;
    this.target.addScaledVector(new THREE.Vector3(e[0], e[1], e[2]), -dx * pixel);
    this.target.addScaledVector(new THREE.Vector3(e[4], e[5], e[6]), dy * pixel);
  }

  private wheel(e: WheelEvent): void {
    e.preventDefault();
    ++this.flight;
    const steps = Math.sign(e.deltaY) * Math.min(3, Math.abs(e.deltaY) / 100);
    if (this.fly) this.walk(new THREE.Vector3(0, 0, -steps), 0.03 * this.radius);
    else this.zoom(1.18 ** steps, e.offsetX, e.offsetY);
    this.changed();
  }

  /// Towards what is under the cursor.
  private zoom(factor: number, x: number, y: number): void {
    const next = Math.max(this.distance * factor, 0.004 * this.radius);
    const before = { x: x - this.canvas.clientWidth / 2, y: y - this.canvas.clientHeight / 2 };
    const share = next / this.distance - 1;
    this.pan(before.x * share, before.y * share);
    this.distance = next;
  }

  /// Along the camera's own axes: right, up, back.
  private walk(way: THREE.Vector3, length: number): void {
    this.target.addScaledVector(way.applyQuaternion(this.camera.quaternion), length);
  }

  /// Keys that move the camera; whether the key is one of them.
  key(code: string, down: boolean): boolean {
    if (!(code in moves)) return false;
    if (!down) return this.pressed.delete(code);
    if (this.pressed.size === 0) {
      this.last = performance.now();
      requestAnimationFrame(() => this.tick());
    }
    this.pressed.add(code);
    return true;
  }

  private tick(): void {
    if (this.pressed.size === 0) return;
    const now = performance.now();
    const seconds = Math.min(0.25, Math.max(0.016, (now - this.last) / 1000));
    this.last = now;
    const way = new THREE.Vector3();
    for (const code of this.pressed) way.add(new THREE.Vector3(...moves[code]!));
    if (way.lengthSq() > 0) this.walk(way.normalize(), seconds * (this.fly ? 0.3 * this.radius : 0.5 * this.distance));
    this.changed();
    requestAnimationFrame(() => this.tick());
  }
}

const moves: Record<string, [number, number, number]> = {
  KeyW: [0, 0, -1], KeyS: [0, 0, 1], KeyA: [-1, 0, 0], KeyD: [1, 0, 0], KeyQ: [0, -1, 0], KeyE: [0, 1, 0],
};
