import {element} from './element.mjs';
import {concerning, mistakeLine} from './mistakes.mjs';
import {numberSlider} from './number_slider.mjs';
import {swatch} from './palette.mjs';

const kChannels = ['y', 'u', 'v'];
const kEnds = ['from', 'to'];
const kNewBox = {
  y: [64, 191],
  u: [64, 191],
  v: [64, 191]
};

/** A box in YUV space for each colour: one colour at a time, six sliders. */
export class YuvBoxes {
  #store;
  #color;
  #chips = new Map();
  #sliders = [];
  #box = element('div', {class: 'box'});
  #toggle = element('button', {type: 'button', onclick: () => this.#toggleBox()});

  constructor(root, {store, palette}) {
    this.#store = store;
    this.#color = palette.names[0];
    const chips = element('div', {class: 'chips', role: 'group', 'aria-label': 'Colour'});
    for (const name of palette.names) {
      const chip = element(
          'button', {
            type: 'button',
            class: 'chip',
            'aria-pressed': 'false',
            onclick: () => this.#choose(name)
          },
          swatch(palette.rgb(name)), name);
      this.#chips.set(name, chip);
      chips.append(chip);
    }
    for (const channel of kChannels) {
      kEnds.forEach((word, end) => {
        const slider = numberSlider(
            `${channel.toUpperCase()} ${word}`, (value) => this.#change(channel, end, value));
        this.#sliders.push({channel, end, slider});
        this.#box.append(slider.root);
      });
    }
    root.append(chips, this.#box, this.#toggle, mistakeLine(store, concerning('boxes')));
    store.addEventListener('colors', () => this.#show());
  }

  #boxes() {
    return this.#store.colors?.boxes ?? {};
  }

  #choose(color) {
    this.#color = color;
    this.#show();
  }

  #show() {
    const boxes = this.#boxes();
    for (const [name, chip] of this.#chips) {
      chip.setAttribute('aria-pressed', String(name === this.#color));
      chip.classList.toggle('chip_absent', boxes[name] === undefined);
    }
    const box = boxes[this.#color];
    this.#box.hidden = box === undefined;
    if (box !== undefined) {
      for (const {channel, end, slider} of this.#sliders) slider.show(box[channel][end]);
    }
    const isLast = box !== undefined && Object.keys(boxes).length === 1;
    this.#toggle.textContent =
        box === undefined ? `Give ${this.#color} a box` : `Remove the box of ${this.#color}`;
    this.#toggle.disabled = isLast;
  }

  // An end pushed past the other takes it along.
  #change(channel, end, value) {
    const boxes = this.#boxes();
    const span = [...boxes[this.#color][channel]];
    span[end] = value;
    if (span[0] > span[1]) span[1 - end] = value;
    this.#store.change(
        {boxes: {...boxes, [this.#color]: {...boxes[this.#color], [channel]: span}}});
  }

  #toggleBox() {
    const {[this.#color]: box, ...others} = this.#boxes();
    this.#store.change({boxes: box === undefined ? {...others, [this.#color]: kNewBox} : others});
  }
}
