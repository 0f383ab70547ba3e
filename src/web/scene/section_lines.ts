// The outlines on the caps of sections, drawn in the plane of their section: each block has its side of them, as of other edges.
import * as THREE from 'three';
import type { ClipPlane } from './section';

const vertex = /* glsl */ `
in vec3 aFrom, aTo;
in float aPlane;        // into uClip
uniform mat4 viewMatrix, projectionMatrix;
uniform vec4 uClip[3];
uniform vec2 uScreen;   // size of the drawing, pixels
uniform float uWidth;   // pixels
uniform vec3 cameraPosition;
out vec3 vAt;
out float vInward;      // pixels from the outline
flat out int vPlane;

vec2 pixel(vec3 eye) { vec4 p = projectionMatrix * vec4(eye, 1.0); return 0.5 * uScreen * p.xy / p.w; }

void main() {
  vec3 a = (viewMatrix * vec4(aFrom, 1.0)).xyz, b = (viewMatrix * vec4(aTo, 1.0)).xyz;
  float near = projectionMatrix[3][2] / (projectionMatrix[2][2] - 1.0);
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  if (a.z > -near && b.z > -near) return;
  if (a.z > -near) a = mix(b, a, (b.z + near) / (b.z - a.z));
  if (b.z > -near) b = mix(a, b, (a.z + near) / (a.z - b.z));
  vPlane = int(aPlane);
  bool first = gl_VertexID < 2, fromOutside = dot(uClip[vPlane].xyz, cameraPosition) > uClip[vPlane].w;
  vec3 end = first ? a : b;
  vec2 along = pixel(b) - pixel(a);
  vec2 inward = length(along) > 0.0 ? normalize(vec2(-along.y, along.x)) * (fromOutside ? 1.0 : -1.0) : vec2(0.0);
  vInward = gl_VertexID % 2 == 0 ? 0.0 : uWidth + 0.5;
  vec2 corner = 2.0 * (pixel(end) + vInward * inward) / uScreen;
  // The corner's place in the plane, a hair nearer: nothing that the section keeps lies before it.
  vec3 sight = vec3(corner.x / projectionMatrix[0][0], corner.y / projectionMatrix[1][1], -1.0);
  vec3 normal = mat3(viewMatrix) * uClip[vPlane].xyz;
  float across = dot(normal, sight);
  float depth = -end.z * clamp(dot(normal, end / -end.z) / (abs(across) > 1e-4 ? across : 1e-4), 0.8, 1.25);
  vAt = first ? aFrom : aTo;
  gl_Position = projectionMatrix * vec4((1.0 - 1e-4) * depth * sight, 1.0);
}`;

const fragment = /* glsl */ `
precision highp float;
precision highp int;
in vec3 vAt;
in float vInward;
flat in int vPlane;
uniform vec4 uClip[3];
uniform float uWidth;
uniform vec3 uInk;
out vec4 colour;
void main() {
  for (int i = 0; i < 3; ++i) if (i != vPlane && dot(uClip[i].xyz, vAt) > uClip[i].w) discard;
  colour = vec4(uInk, 0.62 * (1.0 - smoothstep(uWidth - 0.5, uWidth + 0.5, vInward)));
}`;

export class SectionLines {
  readonly object: THREE.Mesh<THREE.InstancedBufferGeometry, THREE.RawShaderMaterial>;
  private readonly clips = [new THREE.Vector4(), new THREE.Vector4(), new THREE.Vector4()];
  private readonly screen = new THREE.Vector2();

  constructor(ink: THREE.IUniform) {
    const material = new THREE.RawShaderMaterial({ glslVersion: THREE.GLSL3, vertexShader: vertex, fragmentShader: fragment, side: THREE.DoubleSide, transparent: true, depthWrite: false,
      uniforms: { uClip: { value: this.clips }, uScreen: { value: this.screen }, uWidth: { value: 1 }, uInk: ink } });
    this.object = new THREE.Mesh(new THREE.InstancedBufferGeometry(), material);
    this.object.frustumCulled = false;
    this.object.renderOrder = 3; // over joints and ghosts that meet the plane
    this.object.visible = false;
  }

  /// `lines`: for each plane what sectionLines finds.
  show(planes: ClipPlane[], lines: Float32Array[]): void {
    planes.forEach((plane, i) => this.clips[i]!.set(...plane.normal, plane.distance));
    for (let i = planes.length; i < 3; ++i) this.clips[i]!.set(0, 0, 0, 0);
    const ends = new THREE.InstancedInterleavedBuffer(Float32Array.from(lines.flatMap((l) => Array.from(l))), 6);
    const plane = Float32Array.from(lines.flatMap((l, i) => new Array<number>(l.length / 6).fill(i)));
    this.object.geometry.dispose();
    const geometry = this.object.geometry = new THREE.InstancedBufferGeometry();
    geometry.setIndex([0, 1, 2, 2, 1, 3]);
    geometry.setAttribute('aFrom', new THREE.InterleavedBufferAttribute(ends, 3, 0));
    geometry.setAttribute('aTo', new THREE.InterleavedBufferAttribute(ends, 3, 3));
    geometry.setAttribute('aPlane', new THREE.InstancedBufferAttribute(plane, 1));
    geometry.instanceCount = plane.length;
    this.object.visible = plane.length > 0;
  }

  /// Of the drawing, and how wide one side of a line is: all in its pixels.
  resize(width: number, height: number, line: number): void {
    this.screen.set(width, height);
    this.object.material.uniforms.uWidth!.value = line;
  }
}
