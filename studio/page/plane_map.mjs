import {element} from './element.mjs';
import {kPlaneSize} from './exclusions.mjs';
import {paintPlane} from './plane_painter.mjs';

/** The picture of the hue plane; painted anew with everything that is in it. */
export class PlaneMap {
  canvas = element('canvas', {class: 'plane_canvas', 'aria-hidden': 'true'});
  #palette;
  #labels = null;
  #counts = null;
  #exclusions = [];
  #dark = matchMedia('(prefers-color-scheme: dark)');

  constructor(palette) {
    this.#palette = palette;
    this.#dark.addEventListener('change', () => this.#paint());
    new ResizeObserver(() => this.#paint()).observe(this.canvas);
  }

  /** @param {Uint8Array} labels of the cells, row by row */
  setLabels(labels) {
    this.#labels = labels;
    this.#paint();
  }

  /** @param {Uint8Array} counts of the frame's pixels in the cells, log-scaled */
  setCounts(counts) {
    this.#counts = counts;
    this.#paint();
  }

  setExclusions(exclusions) {
    this.#exclusions = exclusions;
    this.#paint();
  }

  /** The name of the colour a cell belongs to; null for none, or before there are labels. */
  colorAt({hue, row}) {
    return this.#palette.nameOfLabel(this.#labels?.[row * kPlaneSize + hue] ?? 0);
  }

  #paint() {
    if (this.canvas.clientWidth === 0) return;
    paintPlane(this.canvas, {
      labels: this.#labels,
      counts: this.#counts,
      exclusions: this.#exclusions,
      palette: this.#palette,
      dark: this.#dark.matches,
    });
  }
}
