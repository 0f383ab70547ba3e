// Bolts as rods, arrows of blocks that move, and marks (monitors, loads, fixings, water) as points and arrows that keep their size on the screen.
import * as THREE from 'three';
import { mapColour } from '../colour';
import type { Bolt, Mark, MovingBlock } from '../data';
import type { ClipPlane } from './section';

const kinds: Record<Mark['kind'], { shape: number; colour: string }> = {
  monitor: { shape: 0, colour: '#0072b2' },
  fixed: { shape: 1, colour: '#009e73' },
  load: { shape: 2, colour: '#d55e00' },
  quiet: { shape: 3, colour: '#cc79a7' },
  water: { shape: 4, colour: '#2a8fd0' },
};

/// As much as is used of what its steel bears, from blue over grey to rust; black where it has broken. Blue before any motion.
export function boltColour(bolt: Bolt): THREE.Color {
  if (bolt.mobilisation === undefined) return new THREE.Color().setStyle('#1f5fd0', THREE.LinearSRGBColorSpace);
  if (bolt.state === 'broken') return new THREE.Color(0, 0, 0);
  return new THREE.Color(...mapColour('diverging', 1 - Math.min(1, bolt.mobilisation)));
}

/// Rods from collar to toe, seen through the rock too, faintly.
export function boltRods(bolts: Bolt[], origin: number[], radius: number): THREE.Object3D {
  const group = new THREE.Group();
  if (bolts.length === 0) return group;
  const thickness = Math.max(0.03, radius / 500);
  const geometry = new THREE.CylinderGeometry(thickness, thickness, 1, 6, 1);
  geometry.translate(0, 0.5, 0);
  const place = new THREE.Object3D();
  for (const hidden of [false, true]) {
    const material = new THREE.MeshBasicMaterial({
      depthTest: !hidden, transparent: hidden, opacity: hidden ? 0.3 : 1, depthWrite: !hidden });
    const mesh = new THREE.InstancedMesh(geometry, material, bolts.length);
    bolts.forEach((bolt, i) => {
      place.position.set(bolt.collar[0] - origin[0]!, bolt.collar[1] - origin[1]!, bolt.collar[2] - origin[2]!);
      place.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), new THREE.Vector3(...bolt.direction).normalize());
      place.scale.set(1, bolt.length, 1);
      place.updateMatrix();
      mesh.setMatrixAt(i, place.matrix);
      mesh.setColorAt(i, boltColour(bolt));
    });
    mesh.frustumCulled = false;
    mesh.renderOrder = hidden ? 4 : 3;
    group.add(mesh);
  }
  return group;
}

/// How blocks of a mechanism move: arrows from their middles, as long as they are fast, seen through the rock too, faintly. `middle` is none of
/// a block that the page does not show.
export function motionArrows(moving: MovingBlock[], middle: (block: number) => number[] | undefined, radius: number): THREE.Object3D {
  const group = new THREE.Group();
  const least = 0.02; // of the fastest point: too short for an arrow
  const arrows = moving.flatMap(({ block, velocity }) => {
    const from = middle(block);
    const way = new THREE.Vector3(...velocity);
    return from && way.length() > least ? [{ from: new THREE.Vector3().fromArray(from), way }] : [];
  });
  if (arrows.length === 0) return group;
  const fastest = Math.max(...arrows.map(({ way }) => way.length()));
  const longest = radius / 4;
  const thickness = radius / 150;
  const shaft = new THREE.CylinderGeometry(thickness, thickness, 1, 8, 1).translate(0, 0.5, 0);
  const head = new THREE.ConeGeometry(3 * thickness, 8 * thickness, 12).translate(0, 4 * thickness, 0);
  const place = new THREE.Object3D();
  for (const hidden of [false, true]) {
    const material = new THREE.MeshBasicMaterial({ color: new THREE.Color().setStyle('#c0266e', THREE.LinearSRGBColorSpace),
      depthTest: !hidden, transparent: hidden, opacity: hidden ? 0.55 : 1, depthWrite: !hidden });
    for (const geometry of [shaft, head]) {
      const mesh = new THREE.InstancedMesh(geometry, material, arrows.length);
      arrows.forEach(({ from, way }, i) => {
        const length = (longest * way.length()) / fastest;
        place.position.copy(from);
        place.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), way.clone().normalize());
        place.scale.set(1, geometry === shaft ? length : 1, 1);
        if (geometry === head) place.position.addScaledVector(way, length / way.length());
        place.updateMatrix();
        mesh.setMatrixAt(i, place.matrix);
      });
      mesh.frustumCulled = false;
      mesh.renderOrder = hidden ? 4 : 3;
      group.add(mesh);
    }
  }
  return group;
}

/// Water levels as planes that reach over the model.
export function waterLevels(marks: Mark[], origin: number[], radius: number): THREE.Object3D {
  const group = new THREE.Group();
  for (const mark of marks.filter((m) => m.kind === 'water')) {
    const material = new THREE.MeshBasicMaterial({ color: new THREE.Color().setStyle(kinds.water.colour, THREE.LinearSRGBColorSpace),
      transparent: true, opacity: 0.35, side: THREE.DoubleSide, depthWrite: false });
    const plane = new THREE.Mesh(new THREE.PlaneGeometry(1.6 * radius, 1.6 * radius), material);
    const normal = new THREE.Vector3().fromArray(mark.directions[0]!);
    const point = new THREE.Vector3().fromArray(mark.points[0]!).sub(new THREE.Vector3().fromArray(origin));
    plane.position.copy(normal).multiplyScalar(point.dot(normal)); // its place nearest to the model's middle
    plane.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), normal);
    plane.renderOrder = 3;
    group.add(plane);
  }
  return group;
}

const vertex = /* glsl */ `
in vec3 position, aWay, aColour;
in float aShape;
uniform mat4 viewMatrix, projectionMatrix;
uniform float uSize, uNearer;
uniform vec4 uClip[3];
out vec3 vColour;
flat out float vShape;
flat out vec2 vWay;
void main() {
  bool cut = false;
  for (int i = 0; i < 3; ++i) cut = cut || dot(uClip[i].xyz, position) > uClip[i].w + 1e-3;
  vec4 eye = viewMatrix * vec4(position, 1.0);
  // A little nearer than the face that it stands on.
  gl_Position = projectionMatrix * vec4(eye.xyz * (1.0 - uNearer), 1.0);
  if (cut) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  gl_PointSize = uSize;
  vColour = aColour;
  vShape = aShape;
  vec2 way = (viewMatrix * vec4(aWay, 0.0)).xy;
  vWay = length(way) > 0.05 ? normalize(way) : vec2(0.0);
}`;

const fragment = /* glsl */ `
precision highp float;
in vec3 vColour;
flat in float vShape;
flat in vec2 vWay;
out vec4 colour;
float box(vec2 p, vec2 half_) { vec2 d = abs(p) - half_; return max(d.x, d.y); }
float triangle(vec2 p, float r) { p.y += r * 0.35; return max(abs(p.x) * 0.866 + p.y * 0.5, -p.y) - r * 0.5; }
void main() {
  vec2 p = vec2(gl_PointCoord.x, 1.0 - gl_PointCoord.y) * 2.0 - 1.0;
  float d;
  if (vShape < 0.5) d = length(p) - 0.55;
  else if (vShape < 1.5) d = triangle(p, 0.85);
  else if (vShape < 2.5 && vWay != vec2(0.0)) {
    // An arrow whose point is the loaded place.
    vec2 q = vec2(dot(p, vec2(vWay.y, -vWay.x)), dot(p, vWay));
    d = min(box(q - vec2(0.0, -0.5), vec2(0.09, 0.45)), max(abs(q.x) * 0.9 + (q.y - 0.02) * 0.5, -q.y - 0.38) - 0.0);
  } else if (vShape < 2.5) d = abs(length(p) - 0.4) - 0.14;
  else if (vShape < 3.5) d = min(box(p, vec2(0.6, 0.1)), min(box(p - vec2(0.0, 0.32), vec2(0.6, 0.1)), box(p + vec2(0.0, 0.32), vec2(0.6, 0.1))));
  else d = max(triangle(-p, 0.8), -1.0);
  if (d > 0.14) discard;
  colour = vec4(d > 0.0 ? vec3(1.0) : vColour, 1.0);  // a white rim, so that it stands out everywhere
}`;

/// Where a monitor is, with its motion, relative to the model's middle.
export type Follow = (name: string) => number[];

/// The marks of conditions hide behind rock, those of monitors never do.
export class Marks {
  readonly object = new THREE.Group();
  private readonly monitors: Mark[];
  private readonly layers: THREE.Points[];
  private readonly clips = [new THREE.Vector4(), new THREE.Vector4(), new THREE.Vector4()];

  constructor(marks: Mark[], private readonly origin: number[]) {
    this.monitors = marks.filter((m) => m.kind === 'monitor');
    const conditions = marks.filter((m) => m.kind !== 'monitor' && m.kind !== 'water');
    this.layers = [this.layer(conditions, true), this.layer(this.monitors, false)];
    this.object.add(...this.layers);
  }

  private layer(marks: Mark[], depthTest: boolean): THREE.Points {
    const position: number[] = [];
    const way: number[] = [];
    const colour: number[] = [];
    const shape: number[] = [];
    for (const mark of marks)
      for (const [i, point] of mark.points.entries()) {
        position.push(...point.map((x, d) => x - this.origin[d]!));
        way.push(...(mark.kind === 'load' ? (mark.directions[i] ?? [0, 0, 0]) : [0, 0, 0]));
        const kind = kinds[mark.kind];
        const n = parseInt(kind.colour.slice(1), 16);
        colour.push((n >> 16) / 255, ((n >> 8) & 255) / 255, (n & 255) / 255);
        shape.push(kind.shape);
      }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.Float32BufferAttribute(position, 3));
    geometry.setAttribute('aWay', new THREE.Float32BufferAttribute(way, 3));
    geometry.setAttribute('aColour', new THREE.Float32BufferAttribute(colour, 3));
    geometry.setAttribute('aShape', new THREE.Float32BufferAttribute(shape, 1));
    const material = new THREE.RawShaderMaterial({ glslVersion: THREE.GLSL3, vertexShader: vertex, fragmentShader: fragment,
      uniforms: { uSize: { value: 16 }, uNearer: { value: depthTest ? 2e-3 : 0 }, uClip: { value: this.clips } }, depthTest, depthWrite: false, transparent: true });
    const points = new THREE.Points(geometry, material);
    points.frustumCulled = false;
    points.renderOrder = 5;
    points.visible = position.length > 0;
    return points;
  }

  /// Monitors go with the rock.
  follow(place: Follow): void {
    const position = this.layers[1]!.geometry.getAttribute('position') as THREE.BufferAttribute;
    this.monitors.forEach((m, i) => position.setXYZ(i, ...(place(m.name) as [number, number, number])));
    position.needsUpdate = true;
  }

  /// What stands in the part that is cut away goes with it.
  clip(planes: ClipPlane[]): void {
    this.clips.forEach((v, i) => {
      const plane = planes[i];
      if (plane) v.set(...plane.normal, plane.distance);
      else v.set(0, 0, 0, 0);
    });
  }

  setSize(pixels: number): void {
    for (const [i, layer] of this.layers.entries())
      (layer.material as THREE.RawShaderMaterial).uniforms.uSize!.value = i === 0 ? 0.8 * pixels : pixels;
  }
}
