// What lies over the picture: legend, scale bar, directions, names of monitors. And the picture as a PNG with all of it.
import * as THREE from 'three';
import type { Context } from '../context';
import type { Mark } from '../data';
import { h, svg, textWidth } from './dom';
import { compass, legend, scaleBar } from './legend';
import { overlayStyle, type Theme, variables } from './overlay_style';

const margin = 12;

export class Overlay {
  readonly element = h('div', { class: 'overlay' });
  private readonly corner = { legend: h('div', { class: 'at-legend' }), scale: h('div', { class: 'at-scale' }), compass: h('div', { class: 'at-compass' }) };
  private readonly labels = svg('svg', { class: 'labels' });
  private readonly named: Mark[];
  private legendKey = '';

  constructor(private readonly context: Context) {
    this.named = (context.data.document.answer?.marks ?? []).filter((m) => m.kind === 'monitor' && m.name);
    this.element.append(this.labels, this.corner.legend, this.corner.scale, this.corner.compass);
  }

  /// Follows the camera; the legend is made anew only when it has changed.
  update(theme: string): void {
    const { store, scene } = this.context;
    const [low, high] = this.context.limits();
    const key = [store.state.field, store.state.paint, low, high, theme, store.state.tried.join('_'), scene.timesFlagged].join();
    if (key !== this.legendKey) this.corner.legend.replaceChildren(legend(this.context, true));
    this.legendKey = key;
    this.corner.scale.replaceChildren(scaleBar(this.context));
    this.corner.compass.replaceChildren(compass(this.context));
    this.labels.replaceChildren(...(this.showsNames() ? this.monitorNames() : []));
  }

  private showsNames(): boolean {
    const { symbols, explode } = this.context.store.state;
    return symbols && explode === 0;
  }

  private monitorNames(): SVGTextElement[] {
    const { scene } = this.context;
    const out: SVGTextElement[] = [];
    for (const { name } of this.named.slice(0, 40)) {
      const p = new THREE.Vector3().fromArray(this.context.monitorPlace(name)).project(scene.camera);
      if (p.z > 1 || Math.abs(p.x) > 1 || Math.abs(p.y) > 1) continue;
      const x = (0.5 + 0.5 * p.x) * scene.canvas.clientWidth;
      const fits = x + 10 + textWidth(name, '600 12px') < scene.canvas.clientWidth;
      out.push(svg('text', { x: fits ? x + 10 : x - 10, 'text-anchor': fits ? 'start' : 'end', y: (0.5 - 0.5 * p.y) * scene.canvas.clientHeight + 4, class: 'label' }, name));
    }
    return out;
  }

  /// The picture with title, legend, scale and directions, `ratio` pixels for one of the screen; then what is on the screen is drawn again.
  async picture(theme: Theme, ratio: number, drawAgain = true): Promise<Blob> {
    const { scene, data } = this.context;
    const { clientWidth: width, clientHeight: height } = scene.canvas;
    scene.resize(width, height, ratio);
    scene.draw();
    const canvas = h('canvas', { width: Math.round(width * ratio), height: Math.round(height * ratio) });
    const paint = canvas.getContext('2d')!;
    paint.drawImage(scene.canvas, 0, 0, canvas.width, canvas.height);
    scene.resize(width, height, devicePixelRatio);
    if (drawAgain) scene.draw();
    const picture = svg('svg', { xmlns: 'http://www.w3.org/2000/svg', width: canvas.width, height: canvas.height, viewBox: `0 0 ${width} ${height}` },
      svg('style', {}, `svg { ${variables(theme)} } ${overlayStyle}`),
      svg('text', { x: margin, y: 24, class: 'picture-title label' }, data.document.title),
      at(legend(this.context), (w, hgt) => [margin, height - hgt - margin + 0 * w]),
      at(scaleBar(this.context), (w, hgt) => [width - w - 110 - margin, height - hgt - margin]),
      at(compass(this.context), (w, hgt) => [width - w - margin, height - hgt - margin]),
      ...(this.showsNames() ? this.monitorNames() : []));
    const image = new Image();
    const text = new XMLSerializer().serializeToString(picture);
    image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(text)}`;
    await image.decode();
    paint.drawImage(image, 0, 0, canvas.width, canvas.height);
    return await new Promise((done, fail) => canvas.toBlob((blob) => (blob ? done(blob) : fail(new Error('no picture'))), 'image/png'));
  }
}

function at(drawing: SVGSVGElement, place: (width: number, height: number) => [number, number]): SVGSVGElement {
  const [x, y] = place(Number(drawing.getAttribute('width')), Number(drawing.getAttribute('height')));
  drawing.setAttribute('x', String(x));
  drawing.setAttribute('y', String(y));
  return drawing;
}
