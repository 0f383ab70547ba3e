// Joints that end inside blocks: no block has them for a face, so they are drawn by themselves, where their block is shown.
import * as THREE from 'three';
import { originColours } from '../fields';
import type { PageData } from '../data';
import type { ClipPlane } from './section';
import type { Surface } from './surface';
import { Flag } from './shaders';

const vertex = /* glsl */ `
in vec3 position, aColour;
uniform mat4 viewMatrix, projectionMatrix;
out vec3 vAt, vColour;
void main() {
  vAt = position;
  vColour = aColour;
  gl_Position = projectionMatrix * viewMatrix * vec4(position, 1.0);
}`;

const fragment = /* glsl */ `
precision highp float;
in vec3 vAt, vColour;
uniform vec4 uClip[3];
out vec4 colour;
void main() {
  for (int i = 0; i < 3; ++i) if (dot(uClip[i].xyz, vAt) > uClip[i].w + 1e-3) discard;
  vec3 n = normalize(cross(dFdx(vAt), dFdy(vAt)));
  colour = vec4((0.7 + 0.3 * abs(dot(n, vec3(0.35, -0.5, 0.79)))) * vColour, 0.8);
}`;

export class DeadEnds {
  readonly object: THREE.Mesh;
  private readonly clips = [new THREE.Vector4(), new THREE.Vector4(), new THREE.Vector4()];
  private readonly triangle: Uint32Array; // corners
  private readonly origin: Uint32Array; // of each triangle
  private readonly block: Int32Array; // of each triangle, 0 … N-1; −1: the page leaves it out

  constructor(data: PageData, surface: Surface) {
    const begin = data.arrays.find('dead_end_begin') ?? [0];
    const place = data.arrays.find('dead_end_xyz') ?? [];
    const of = data.arrays.find('dead_end_origin') ?? [];
    const inBlock = data.arrays.find('dead_end_block') ?? [];
    const row = new Map(Array.from(surface.blockId, (id, b) => [id, b]));
    const corners: number[] = [];
    const origins: number[] = [];
    const blocks: number[] = [];
    const colour = new Float32Array(place.length);
    const colours = originColours(data);
    for (let p = 0; p + 1 < begin.length; ++p) {
      const first = begin[p]!;
      for (let c = first; c < begin[p + 1]!; ++c) colour.set(colours[of[p]!] ?? [0.5, 0.5, 0.5], 3 * c);
      for (let c = first + 1; c + 1 < begin[p + 1]!; ++c) {
        corners.push(first, c, c + 1); // convex polygons, as fans
        origins.push(of[p]!);
        blocks.push(row.get(inBlock[p]!) ?? -1);
      }
    }
    this.triangle = Uint32Array.from(corners);
    this.origin = Uint32Array.from(origins);
    this.block = Int32Array.from(blocks);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(Float32Array.from(place), 3));
    geometry.setAttribute('aColour', new THREE.BufferAttribute(colour, 3));
    const material = new THREE.RawShaderMaterial({ glslVersion: THREE.GLSL3, vertexShader: vertex, fragmentShader: fragment,
      transparent: true, side: THREE.DoubleSide, depthWrite: false, uniforms: { uClip: { value: this.clips } } });
    this.object = new THREE.Mesh(geometry, material);
    this.object.frustumCulled = false;
    this.object.renderOrder = 1; // with the joints between blocks
    this.object.visible = false;
  }

  /// Those of one joint (−1 none, −2 all) in blocks that are not hidden. `flags` [N] of shaders.ts.
  show(joint: number, flags: Uint8Array): void {
    const isShown = (t: number): boolean => (joint === -2 || this.origin[t] === joint) && !((flags[this.block[t]!] ?? Flag.hidden) & Flag.hidden);
    const shown = joint === -1 ? this.triangle.subarray(0, 0) : this.triangle.filter((_, i) => isShown((i / 3) | 0));
    this.object.visible = shown.length > 0;
    this.object.geometry.setIndex(new THREE.BufferAttribute(shown, 1));
  }

  clip(planes: ClipPlane[]): void {
    this.clips.forEach((v, i) => {
      const plane = planes[i];
      if (plane) v.set(...plane.normal, plane.distance);
      else v.set(0, 0, 0, 0);
    });
  }
}
