// The blocks on the screen: textures and uniforms of the shader, drawing when something has changed, and picking.
import * as THREE from 'three';
import { originColours } from '../fields';
import type { PageData } from '../data';
import { type Motion, placeAt } from '../motion';
import type { ClipPlane } from './section';
import { edgeLengths, radius, type Surface } from './surface';
import { rockTexture } from './rock';
import { SectionLines } from './section_lines';
import { Flag, fragmentShader, Pass, vertexShader } from './shaders';
import { floats, MotionTexture, numberTexture, pointTexture } from './textures';

export interface Picked {
  block: number; // 0 … N-1
  at: THREE.Vector3;
}

export interface Palette {
  background: string;
  ink: string;
  none: string;
  accent: string;
}

/// Opacity of the edges of ghosts: of one alone, and of all over one place, as that of their faces (App.showLook).
const mostGhostEdge = 0.35;
const veil = 0.22;

/// Without a graphics card several samples a pixel take several times as long, and SwiftShader mixes in what lies behind edges of caps.
function drawsInSoftware(): boolean {
  const gl = document.createElement('canvas').getContext('webgl2');
  const info = gl?.getExtension('WEBGL_debug_renderer_info');
  const name = gl && info ? String(gl.getParameter(info.UNMASKED_RENDERER_WEBGL)) : '';
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}

export class Scene {
  readonly renderer: THREE.WebGLRenderer;
  readonly camera = new THREE.PerspectiveCamera(35, 1, 0.1, 1000);
  readonly radius: number;
  readonly extras = new THREE.Group(); // bolts and other symbols
  private readonly scene = new THREE.Scene();
  private readonly pickScene = new THREE.Scene();
  private readonly ghosts: THREE.Mesh;
  private readonly joints: THREE.Mesh;
  private readonly caps: THREE.Mesh[] = [];
  private readonly edgeLength: Float32Array; // [N] m, of each block's faces: each edge twice
  private ghostEdges = 0; // m, of all ghosts
  private readonly uniforms: Record<string, THREE.IUniform>;
  private readonly blockTexture: THREE.DataTexture;
  private readonly motionTextures: [MotionTexture, MotionTexture];
  private readonly values: Record<'block' | 'point' | 'origin', THREE.DataTexture>;
  private readonly map: THREE.DataTexture;
  private readonly target: THREE.WebGLRenderTarget;
  private readonly sectionLines: SectionLines;
  private waiting = false;
  /// Called before each frame, with the size of the canvas in CSS pixels.
  beforeFrame: () => void = () => {};
  /// Called with the pixels of the drawing for one of the screen: saved pictures have more.
  ratioChanged: (ratio: number) => void = () => {};
  frames = 0;
  /// Of each block, as they were set last, and how often.
  flags: Uint8Array = new Uint8Array(0);
  timesFlagged = 0;
  /// m from the middle that anything drawn reaches.
  reach: number;

  constructor(readonly canvas: HTMLCanvasElement, data: PageData, private readonly surface: Surface, private readonly motion: Motion) {
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: !drawsInSoftware(), stencil: true, preserveDrawingBuffer: false });
    this.renderer.localClippingEnabled = true; // of bolts; the blocks' shader cuts by itself
    this.radius = this.reach = radius(surface);
    this.camera.up.set(0, 0, 1);
    this.blockTexture = numberTexture((n) => new Float32Array(n), 4, surface.blockId.length);
    const centroid = data.arrays.get('centroid');
    for (let b = 0; b < surface.blockId.length; ++b)
      for (let d = 0; d < 3; ++d) floats(this.blockTexture)[4 * b + d] = centroid[3 * b + d]! - data.document.origin[d]!;
    this.values = {
      block: numberTexture((n) => new Float32Array(n), 1, surface.blockId.length),
      point: numberTexture((n) => new Float32Array(n), 1, motion.states > 0 ? surface.blockOfPoint.length : 1),
      origin: numberTexture((n) => new Float32Array(n), 1, data.document.origins.length),
    };
    this.map = new THREE.DataTexture(new Uint8Array(4 * 256), 256, 1);
    this.motionTextures = [new MotionTexture(motion, surface), new MotionTexture(motion, surface)];
    this.edgeLength = edgeLengths(surface);
    this.uniforms = this.makeUniforms(data);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('aCorner', new THREE.BufferAttribute(surface.corner, 1));
    geometry.setAttribute('aOrigin', this.originAttribute());
    geometry.setDrawRange(0, surface.corner.length);
    this.ghosts = this.mesh(geometry, Pass.ghost, { side: THREE.FrontSide, transparent: true, depthWrite: false });
    this.joints = this.mesh(geometry, Pass.joints, { transparent: true, polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -1 });
    this.ghosts.renderOrder = 2;
    this.joints.renderOrder = 1;
    this.sectionLines = new SectionLines(this.uniforms.uInk!);
    this.scene.add(...this.rock(geometry, Pass.solid), this.ghosts, this.joints, this.sectionLines.object, this.extras);
    this.pickScene.add(...this.rock(geometry, Pass.pick));
    this.target = new THREE.WebGLRenderTarget(1, 1, { type: THREE.FloatType, minFilter: THREE.NearestFilter, magFilter: THREE.NearestFilter, stencilBuffer: true });
  }

  add(part: THREE.Object3D): void {
    this.scene.add(part);
  }

  /// Blocks are closed and do not overlap. From where the line of sight enters what sections keep it meets as many backs of faces as
  /// fronts, or one more: then it enters inside a block, whose cap is seen. The stencil counts that; depths of coincident faces decide nothing.
  private rock(geometry: THREE.BufferGeometry, pass: number): THREE.Mesh[] {
    const count = { colorWrite: false, depthWrite: false, depthTest: false, stencilWrite: true };
    const drawn = { blending: THREE.NoBlending, stencilWrite: true };
    const [backsCounted, frontsCounted, fronts, caps] = [
      this.mesh(geometry, Pass.count, { ...count, side: THREE.BackSide, stencilZPass: THREE.IncrementWrapStencilOp }),
      this.mesh(geometry, Pass.count, { ...count, side: THREE.FrontSide, stencilZPass: THREE.DecrementWrapStencilOp }),
      this.mesh(geometry, pass, { ...drawn, side: THREE.FrontSide, stencilFunc: THREE.EqualStencilFunc }),
      this.mesh(geometry, pass, { ...drawn, side: THREE.BackSide, stencilFunc: THREE.NotEqualStencilFunc }),
    ] as const;
    backsCounted.renderOrder = frontsCounted.renderOrder = -1;
    this.caps.push(backsCounted, frontsCounted, caps);
    return [backsCounted, frontsCounted, fronts, caps];
  }

  private originAttribute(): THREE.BufferAttribute {
    const origins = new Uint16Array(this.surface.corner.length);
    for (let i = 0; i < origins.length; ++i) origins[i] = this.surface.origin[(i / 3) | 0]!;
    const attribute = new THREE.BufferAttribute(origins, 1);
    attribute.gpuType = THREE.IntType;
    return attribute;
  }

  private makeUniforms(data: PageData): Record<string, THREE.IUniform> {
    const origins = numberTexture((n) => new Float32Array(n), 4, data.document.origins.length);
    originColours(data).forEach((rgb, i) => floats(origins).set([...rgb, data.document.origins[i]!.kind], 4 * i));
    const middle = numberTexture((n) => new Float32Array(n), 4, this.surface.blockId.length);
    if (this.motion.middle)
      for (let b = 0; b < this.surface.blockId.length; ++b)
        floats(middle).set(this.motion.middle.subarray(3 * b, 3 * b + 3), 4 * b);
    return {
      uPoint: { value: pointTexture(this.surface) }, uBlock: { value: this.blockTexture }, uValue: { value: this.values.block },
      uValueOf: { value: 0 }, uLow: { value: 0 }, uHigh: { value: 1 }, uJoint: { value: -1 }, uOrigin: { value: origins }, uMiddle: { value: middle },
      uFrom: { value: this.motionTextures[0].texture }, uTo: { value: this.motionTextures[1].texture },
      uUnitFrom: { value: 0 }, uUnitTo: { value: 0 }, uShare: { value: 0 }, uExplode: { value: 0 }, uMagnify: { value: 1 },
      uClip: { value: [new THREE.Vector4(), new THREE.Vector4(), new THREE.Vector4()] }, uMap: { value: this.map },
      uRock: { value: rockTexture() }, uEdges: { value: true }, uTexture: { value: true }, uGhost: { value: 0.1 }, uGhostEdge: { value: 0 }, uDepth: { value: 0.5 },
      uGrain: { value: this.radius / 4 }, uEdgeWidth: { value: 0.9 }, uNone: { value: new THREE.Vector3(0.7, 0.7, 0.7) },
      uInk: { value: new THREE.Vector3() }, uAccent: { value: new THREE.Vector3() },
    };
  }

  private mesh(geometry: THREE.BufferGeometry, pass: number, parameters: THREE.ShaderMaterialParameters): THREE.Mesh<THREE.BufferGeometry, THREE.RawShaderMaterial> {
    const material = new THREE.RawShaderMaterial({
      glslVersion: THREE.GLSL3, vertexShader, fragmentShader, side: THREE.DoubleSide, forceSinglePass: true,
      defines: { MOTION: this.motion.pointMotion ? 1 : this.motion.blockMotion ? 2 : 0 },
      uniforms: { ...this.uniforms, uPass: { value: pass }, uBacks: { value: parameters.side === THREE.BackSide } }, ...parameters,
    });
    const mesh = new THREE.Mesh(geometry, material);
    mesh.frustumCulled = false;
    mesh.matrixAutoUpdate = false;
    return mesh;
  }

  /// [N] of shaders.ts.
  setFlags(flags: Uint8Array): void {
    this.flags = flags;
    ++this.timesFlagged;
    const data = floats(this.blockTexture);
    this.ghostEdges = 0;
    for (let b = 0; b < flags.length; ++b) {
      data[4 * b + 3] = flags[b]!;
      if (flags[b]! & Flag.ghost) this.ghostEdges += this.edgeLength[b]!;
    }
    this.blockTexture.needsUpdate = true;
    this.ghosts.visible = flags.some((f) => (f & Flag.ghost) !== 0);
  }

  /// Values along the map, 0 … 1; NaN: none.
  setValues(of: 'block' | 'point' | 'origin', values: Float32Array, low: number, high: number): void {
    const texture = this.values[of];
    const data = floats(texture);
    const scale = high > low ? 1 / (high - low) : 0;
    for (let i = 0; i < values.length; ++i) {
      const share = (values[i]! - low) * scale;
      data[i] = Number.isNaN(share) ? -1 : Math.min(1, Math.max(0, share));
    }
    texture.needsUpdate = true;
    this.uniforms.uValue!.value = texture;
    this.uniforms.uValueOf!.value = ['block', 'point', 'origin'].indexOf(of);
  }

  /// Colours by the displacement itself, which the shader has anyway.
  setDisplacementValues(which: number, low: number, high: number): void {
    this.uniforms.uValueOf!.value = which;
    this.uniforms.uLow!.value = low;
    this.uniforms.uHigh!.value = high;
  }

  /// 256 colours; names have sharp limits between them.
  setMap(bytes: Uint8Array, names: boolean): void {
    (this.map.image.data as Uint8Array).set(bytes);
    this.uniforms.uDepth!.value = names ? 0.5 : 0.22; // a texture must not hide what a scale says
    this.map.minFilter = this.map.magFilter = names ? THREE.NearestFilter : THREE.LinearFilter;
    this.map.needsUpdate = true;
  }

  setMotion(at: number, magnify: number): void {
    this.uniforms.uMagnify!.value = magnify;
    if (this.motion.states === 0) return;
    const place = placeAt(at, this.motion.states);
    // Going on by one state, what was the second becomes the first: one texture is uploaded, not two.
    if (this.motionTextures[1].state === place.from) this.motionTextures.reverse();
    const [from, to] = this.motionTextures;
    from.show(place.from);
    to.show(place.to);
    this.uniforms.uFrom!.value = from.texture;
    this.uniforms.uTo!.value = to.texture;
    this.uniforms.uUnitFrom!.value = this.motion.unit[place.from] ?? 0;
    this.uniforms.uUnitTo!.value = this.motion.unit[place.to] ?? 0;
    this.uniforms.uShare!.value = place.share;
  }

  /// `lines`: for each plane what sectionLines finds.
  setClip(planes: ClipPlane[], lines: Float32Array[]): void {
    const clip = this.uniforms.uClip!.value as THREE.Vector4[];
    clip.forEach((v, i) => {
      const plane = planes[i];
      if (plane) v.set(...plane.normal, plane.distance);
      else v.set(0, 0, 0, 0);
    });
    const cuts = planes.map((p) => new THREE.Plane(new THREE.Vector3(...p.normal).negate(), p.distance));
    this.extras.traverse((part) => {
      if (part instanceof THREE.Mesh) (part.material as THREE.Material).clippingPlanes = cuts;
    });
    this.sectionLines.show(planes, lines);
  }

  /// Backs of faces are seen through cuts, and from within the rock.
  showBacks(shown: boolean): void {
    for (const mesh of this.caps) mesh.visible = shown;
  }

  setLook(look: { explode: number; edges: boolean; texture: boolean; ghost: number; joint: number }): void {
    this.uniforms.uExplode!.value = look.explode;
    this.uniforms.uEdges!.value = look.edges;
    this.uniforms.uTexture!.value = look.texture;
    this.uniforms.uGhost!.value = look.ghost;
    this.uniforms.uJoint!.value = look.joint;
    this.joints.visible = look.joint !== -1;
  }

  setPalette(palette: Palette): void {
    const put = (uniform: THREE.IUniform, hex: string): void => {
      const n = parseInt(hex.slice(1), 16);
      (uniform.value as THREE.Vector3).set((n >> 16) / 255, ((n >> 8) & 255) / 255, (n & 255) / 255);
    };
    put(this.uniforms.uInk!, palette.ink);
    put(this.uniforms.uNone!, palette.none);
    put(this.uniforms.uAccent!, palette.accent);
    this.renderer.setClearColor(new THREE.Color().setStyle(palette.background, THREE.LinearSRGBColorSpace), 1);
    this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace; // colours are given as the screen shows them
  }

  resize(width: number, height: number, ratio: number): void {
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
    const edge = 0.55 + 0.35 * ratio; // on either side of it
    this.uniforms.uEdgeWidth!.value = edge;
    this.sectionLines.resize(width * ratio, height * ratio, edge);
    this.ratioChanged(ratio);
    this.camera.aspect = width / Math.max(1, height);
    this.camera.updateProjectionMatrix();
  }

  /// Draws with the next frame of the browser, once however often it is asked.
  request(): void {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.draw();
    });
  }

  draw(): void {
    this.beforeFrame();
    this.fitDepth();
    this.thinGhosts();
    this.renderer.render(this.scene, this.camera);
    ++this.frames;
  }

  /// Lines over a place of the screen on average: half of all faces are fronts, a line of random direction is seen at π/4 of its length, and a
  /// cube of this radius R has a mean shadow of 2 R² (Cauchy: a quarter of its surface). All of them together cover no more than `veil`.
  private thinGhosts(): void {
    const metresInPixel = (2 * this.camera.position.length() * Math.tan((this.camera.fov * Math.PI) / 360)) / this.renderer.domElement.height;
    const layers = (0.5 * this.ghostEdges * (Math.PI / 4) * (this.uniforms.uEdgeWidth!.value as number) * metresInPixel) / (2 * this.radius ** 2);
    this.uniforms.uGhostEdge!.value = Math.min(mostGhostEdge, veil / layers);
  }

  /// The nearest and farthest distances that hold the model, exploded and moved.
  private fitDepth(): void {
    const reach = this.reach * (1.1 + 1.2 * (this.uniforms.uExplode!.value as number));
    const distance = this.camera.position.length();
    this.camera.near = Math.max(this.radius * 4e-4, distance - reach);
    this.camera.far = distance + reach;
    this.camera.updateProjectionMatrix();
  }

  /// What is at a place of the canvas (CSS pixels): one pixel is drawn with numbers instead of colours.
  pick(x: number, y: number): Picked | null {
    const size = this.renderer.getSize(new THREE.Vector2());
    this.camera.setViewOffset(size.x, size.y, x, y, 1, 1);
    this.renderer.setRenderTarget(this.target);
    const colour = this.renderer.getClearColor(new THREE.Color());
    this.renderer.setClearColor(0, 0);
    this.renderer.clear();
    this.renderer.render(this.pickScene, this.camera);
    const out = new Float32Array(4);
    this.renderer.readRenderTargetPixels(this.target, 0, 0, 1, 1, out);
    this.renderer.setRenderTarget(null);
    this.renderer.setClearColor(colour, 1);
    this.camera.clearViewOffset();
    return out[3]! > 0 ? { block: Math.round(out[3]!) - 1, at: new THREE.Vector3(out[0], out[1], out[2]) } : null;
  }
}
