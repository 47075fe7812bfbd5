import {streamAddress} from './api.mjs';
import {element} from './element.mjs';
import {capitalized} from './palette.mjs';

const kRetryMs = 2000;
const kWidths_px = [320, 480, 640, 960, 1280, 1920];

/**
 * A moving picture with a choice of views and a crosshair to point at a pixel: by a press, or by
 * the arrow keys (one pixel, with shift ten).
 *
 * Events: `pick` (detail: {x, y} in pixels of the camera's picture).
 */
export class StreamPicture extends EventTarget {
  #image = element('img', {alt: '', draggable: 'false'});
  #note = element('p', {class: 'picture_note', hidden: true});
  #crosshair = element('div', {class: 'crosshair', hidden: true});
  #frame;
  #views;
  #whyNone;
  #size_px;
  #playing = false;
  #width_px = 0;
  #retry = 0;

  /**
   * @param {{name: string, views: string[], view: string, size_px: {width, height},
   *     whyNone: function(): Promise<string>}} options `whyNone` is asked when no picture comes
   */
  constructor(root, {name, views, view, size_px, whyNone}) {
    super();
    this.#whyNone = whyNone;
    this.#size_px = size_px;
    this.#views = element(
        'select', {'aria-label': `View of the ${name}`, onchange: () => this.#load()},
        ...views.map((each) => element('option', {value: each}, capitalized(each))));
    this.#views.value = views.includes(view) ? view : views[0];
    this.#frame = element(
        'div', {
          class: 'picture_frame',
          tabindex: '0',
          role: 'application',
          'aria-label':
              `${capitalized(name)}: press on a pixel, or move the crosshair with the arrow keys`,
          onpointerdown: (event) => this.#press(event),
          onkeydown: (event) => this.#key(event),
        },
        this.#image, this.#crosshair, this.#note);
    this.#frame.style.aspectRatio = `${size_px.width} / ${size_px.height}`;
    this.#image.addEventListener('load', () => this.#say(''));
    this.#image.addEventListener('error', () => this.#failed());
    root.append(
        element('figure', {class: 'picture'}, element('figcaption', {}, this.#views), this.#frame));
  }

  /** Shows the picture; one that is shown already, and large enough, goes on as it is. */
  play() {
    if (this.#playing && this.#wantedWidth_px() <= this.#width_px) return;
    this.#playing = true;
    this.#load();
  }

  /** Lets go of the stream and keeps the last picture's place. */
  stop() {
    this.#playing = false;
    clearTimeout(this.#retry);
    this.#image.removeAttribute('src');
  }

  /** Puts the crosshair on a pixel without telling anybody. */
  mark({x, y}) {
    this.#crosshair.hidden = false;
    this.#crosshair.style.left = `${((x + 0.5) / this.#size_px.width) * 100}%`;
    this.#crosshair.style.top = `${((y + 0.5) / this.#size_px.height) * 100}%`;
    this.#crosshair.dataset.x = x;
    this.#crosshair.dataset.y = y;
  }

  #load() {
    if (!this.#playing) return;
    clearTimeout(this.#retry);
    this.#width_px = this.#wantedWidth_px();
    this.#image.src = streamAddress(
        this.#views.value, this.#width_px < this.#size_px.width ? this.#width_px : undefined);
  }

  // No more pixels than the screen shows: a phone at the far end of the hall's network is slow.
  #wantedWidth_px() {
    const shown = this.#frame.clientWidth * devicePixelRatio;
    const width = kWidths_px.find((each) => each >= shown) ?? Infinity;
    return Math.min(width, this.#size_px.width);
  }

  async #failed() {
    if (!this.#playing) return;
    clearTimeout(this.#retry);
    this.#retry = setTimeout(() => this.#load(), kRetryMs);
    this.#say(await this.#whyNone());
  }

  #say(text) {
    this.#note.textContent = text;
    this.#note.hidden = text === '';
  }

  #press(event) {
    if (event.button !== 0) return;
    const box = this.#frame.getBoundingClientRect();
    this.#pick({
      x: Math.floor(((event.clientX - box.left) / box.width) * this.#size_px.width),
      y: Math.floor(((event.clientY - box.top) / box.height) * this.#size_px.height),
    });
  }

  #key(event) {
    const step = event.shiftKey ? 10 : 1;
    const moves = {
      ArrowLeft: [-step, 0],
      ArrowRight: [step, 0],
      ArrowUp: [0, -step],
      ArrowDown: [0, step],
      Enter: [0, 0],
      ' ': [0, 0]
    };
    const move = moves[event.key];
    if (move === undefined || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    const {width, height} = this.#size_px;
    const from = this.#crosshair.hidden ?
        {x: width >> 1, y: height >> 1} :
        {x: Number(this.#crosshair.dataset.x), y: Number(this.#crosshair.dataset.y)};
    this.#pick({x: from.x + move[0], y: from.y + move[1]});
  }

  #pick({x, y}) {
    const inside = {
      x: Math.max(0, Math.min(this.#size_px.width - 1, x)),
      y: Math.max(0, Math.min(this.#size_px.height - 1, y)),
    };
    this.mark(inside);
    this.dispatchEvent(new CustomEvent('pick', {detail: inside}));
  }
}
