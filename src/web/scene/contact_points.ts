// Contact points as dots of one size on the screen, each with its colour.
import * as THREE from 'three';
import type { Rgb } from '../colour';
import type { ClipPlane } from './section';

const vertex = /* glsl */ `
in vec3 position, aColour;
uniform mat4 viewMatrix, projectionMatrix;
uniform float uSize;
uniform vec4 uClip[3];
out vec3 vColour;
void main() {
  bool cut = false;
  for (int i = 0; i < 3; ++i) cut = cut || dot(uClip[i].xyz, position) > uClip[i].w + 1e-3;
  gl_Position = cut ? vec4(2.0, 2.0, 2.0, 1.0) : projectionMatrix * viewMatrix * vec4(position, 1.0);
  gl_PointSize = uSize;
  vColour = aColour;
}`;

const fragment = /* glsl */ `
precision highp float;
in vec3 vColour;
out vec4 colour;
void main() {
  float d = length(gl_PointCoord - 0.5);
  if (d > 0.5) discard;
  colour = vec4(d > 0.4 ? 0.35 * vColour : vColour, 1.0);
}`;

export class ContactPoints {
  readonly object: THREE.Points;
  private readonly clips = [new THREE.Vector4(), new THREE.Vector4(), new THREE.Vector4()];

  constructor() {
    const material = new THREE.RawShaderMaterial({ glslVersion: THREE.GLSL3, vertexShader: vertex, fragmentShader: fragment,
      uniforms: { uSize: { value: 8 }, uClip: { value: this.clips } } });
    this.object = new THREE.Points(new THREE.BufferGeometry(), material);
    this.object.frustumCulled = false;
    this.object.renderOrder = 3; // after ghosts, which write no depth
    this.object.visible = false;
  }

  /// Those of `shown`.
  show(positions: Float32Array, colours: Rgb[], shown: boolean[]): void {
    const place = positions.filter((_, i) => shown[(i / 3) | 0]);
    const colour = colours.filter((_, i) => shown[i]);
    this.object.geometry.dispose();
    this.object.geometry = new THREE.BufferGeometry();
    this.object.geometry.setAttribute('position', new THREE.BufferAttribute(place, 3));
    this.object.geometry.setAttribute('aColour', new THREE.BufferAttribute(Float32Array.from(colour.flat()), 3));
  }

  clip(planes: ClipPlane[]): void {
    this.clips.forEach((v, i) => {
      const plane = planes[i];
      if (plane) v.set(...plane.normal, plane.distance);
      else v.set(0, 0, 0, 0);
    });
  }

  setSize(pixels: number): void {
    (this.object.material as THREE.RawShaderMaterial).uniforms.uSize!.value = pixels;
  }
}
