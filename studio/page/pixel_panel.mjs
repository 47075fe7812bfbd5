import {ApiError} from './api.mjs';
import {element} from './element.mjs';
import {hueOfRgb} from './hue.mjs';
import {latestOnly} from './latest_only.mjs';
import {swatch} from './palette.mjs';
import {claimHue} from './pivots.mjs';

/**
 * What every stage makes of a pixel, the deciding answer last, and the buttons that give the
 * pixel's hue to a colour.
 *
 * Events: `answered` when the answer for another pixel is shown.
 */
export class PixelPanel extends EventTarget {
  #api;
  #store;
  #palette;
  #pixel_px = null;
  #answer = null;
  #fresh = false;
  #head = element('p', {class: 'pixel_head'});
  #stages = element('dl', {class: 'pixel_stages', 'aria-live': 'polite'});
  #problem = element('p', {class: 'mistake', role: 'status'});
  #claim;
  #add = element('input', {type: 'checkbox'});
  #ask = latestOnly(() => this.#explain());

  constructor(root, {api, store, palette}) {
    super();
    this.#api = api;
    this.#store = store;
    this.#palette = palette;
    this.#head.textContent = 'Press on the picture to see why a pixel is, or is not, a colour.';
    this.#claim = element(
        'fieldset', {class: 'claim', hidden: true}, element('legend', {}, 'Make this …'),
        element(
            'div', {class: 'chips'},
            ...palette.names.map(
                (name) => element(
                    'button', {
                      type: 'button',
                      class: 'chip',
                      'data-color': name,
                      'aria-label': `Make this ${name}`,
                      onclick: () => this.#make(name)
                    },
                    swatch(palette.rgb(name)), name))),
        element('label', {class: 'check'}, this.#add, 'as one more pivot of that colour'));
    root.append(this.#head, this.#claim, this.#problem, this.#stages);
    store.addEventListener('in-use', () => this.refresh());
    store.addEventListener('colors', () => this.#showClaim());
  }

  show(pixel_px) {
    this.#pixel_px = pixel_px;
    this.#fresh = true;
    this.#problem.textContent = '';
    this.refresh();
  }

  /** Asks again for the same pixel: colours or frames have changed. */
  refresh() {
    if (this.#pixel_px !== null) this.#ask();
  }

  async #explain() {
    const {x, y} = this.#pixel_px;
    try {
      this.#answer = await this.#api.explain(x, y);
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      this.#problem.textContent = error.message;
      return;
    }
    this.#showAnswer();
    this.#showClaim();
    if (this.#fresh) this.dispatchEvent(new CustomEvent('answered'));
    this.#fresh = false;
  }

  #showAnswer() {
    const {x, y, rgb, answers} = this.#answer;
    this.#head.replaceChildren(
        swatch(rgb), element('strong', {}, `${x}, ${y}`), ` RGB ${rgb.join(' ')}`);
    this.#stages.replaceChildren(...answers.flatMap(
        ({stage, text}, i) =>
            [element('dt', {}, stage),
             element('dd', {class: i === answers.length - 1 ? 'pixel_verdict' : null}, text),
    ]));
  }

  // The server knows what light and normalizer made of the pixel; the picture's own colour is the
  // same only where hues are taken of that.
  #hue() {
    if (this.#answer?.hue !== undefined) return this.#answer.hue;
    return this.#store.colors?.hue_of === 'original' ? hueOfRgb(this.#answer.rgb) : null;
  }

  #showClaim() {
    const byHue = this.#answer !== null && this.#store.colors?.segmenter === 'hue_pivots';
    this.#claim.hidden = !byHue;
    if (!byHue) return;
    const hue = this.#hue();
    this.#claim.disabled = hue === null;
    this.#claim.firstElementChild.textContent =
        hue === null ? 'This pixel has no hue to give to a colour' : `Give hue ${hue} to …`;
  }

  #make(color) {
    const claimed =
        claimHue(this.#store.colors.pivots, color, this.#hue(), {add: this.#add.checked});
    this.#problem.textContent = claimed.obstacle === undefined ?
        '' :
        `The pivot of ${claimed.obstacle} sits on this very hue. Move that one first.`;
    if (claimed.pivots !== undefined) this.#store.change({pivots: claimed.pivots});
  }
}
