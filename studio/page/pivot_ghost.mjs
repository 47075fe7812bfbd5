import {element} from './element.mjs';
import {kHues, wrapHue} from './hue.mjs';

/** A pivot that is being placed: a line that follows pointer and keys until it is put down. */
export class PivotGhost {
  line = element('div', {class: 'plane_ghost', hidden: true});
  #color = '';
  #hue = 0;

  get color() {
    return this.#color;
  }
  get hue() {
    return this.#hue;
  }

  show(color) {
    this.#color = color;
    this.line.hidden = false;
    this.move(kHues / 2);
  }

  hide() {
    this.line.hidden = true;
  }

  move(hue) {
    this.#hue = wrapHue(hue);
    this.line.style.left = `${((this.#hue + 0.5) / kHues) * 100}%`;
    this.line.textContent = `${this.#color} ${this.#hue}`;
  }
}
