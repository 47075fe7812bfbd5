import {AreaSelection} from './area_selection.mjs';
import {element, icon} from './element.mjs';
import {kMaxExclusions, kPlaneSize, levelOfRow} from './exclusions.mjs';
import {openMenu} from './menu.mjs';
import {concerning, mistakeLine} from './mistakes.mjs';
import {swatch} from './palette.mjs';
import {PivotGhost} from './pivot_ghost.mjs';
import {PivotHandles} from './pivot_handles.mjs';
import {addPivot, freeHue} from './pivots.mjs';
import {PlaneMap} from './plane_map.mjs';

const kHints = {
  look: 'Drag a pivot · double-click adds one · shift-drag ignores an area',
  area: 'Drag over the pixels to ignore. Escape leaves it.',
  place: 'Press its place, or arrow keys and Enter. Escape leaves it.',
};

const kTouch = matchMedia('(pointer: coarse)');
const kTouchHint = 'Drag a pivot, or tap it for more.';

/**
 * All hues from left to right; above, value 255 → 0 at full saturation, below, saturation 255 → 0
 * at full value. Pivots are placed in it and areas ignored.
 */
export class HuePlane {
  #store;
  #palette;
  #handles;
  #map;
  #selection = new AreaSelection();
  #ghost = new PivotGhost();
  #area;
  #body;
  #readout = element('p', {class: 'plane_readout'});
  #hint = element('p', {class: 'hint', role: 'status'});
  #tools = element('div', {class: 'plane_tools'});
  #areaTool;
  #mode = 'look';

  constructor(root, {store, palette}) {
    this.#store = store;
    this.#palette = palette;
    this.#map = new PlaneMap(palette);
    this.#area = element(
        'div', {
          class: 'plane_area',
          tabindex: '0',
          role: 'application',
          'aria-label': 'Hue plane',
          ondblclick: (event) => this.#addAt(event),
          onkeydown: (event) => this.#key(event),
        },
        this.#map.canvas, element('span', {class: 'plane_axis'}, '↑ value'),
        element('span', {class: 'plane_axis plane_axis_low'}, '↑ saturation'),
        this.#selection.frame, this.#ghost.line);
    // On the body, for the lines of the pivots lie over the area.
    this.#body = element(
        'div', {
          class: 'plane_body',
          onpointerdown: (event) => this.#down(event),
          onpointermove: (event) => this.#over(event),
          onpointerup: (event) => this.#up(event),
          onpointercancel: () => this.#setMode('look'),
          onpointerleave: () => {
            this.#readout.textContent = '';
          },
        },
        this.#area);
    this.#areaTool = element(
        'button', {type: 'button', 'aria-pressed': 'false', onclick: () => this.#toggleArea()},
        icon('area'), 'Ignore an area');
    this.#tools.append(
        element(
            'button',
            {type: 'button', 'aria-haspopup': 'menu', onclick: (event) => this.#chooseAdded(event)},
            icon('add'), 'Add a pivot'),
        this.#areaTool);
    root.append(
        element('div', {class: 'plane_head'}, element('h2', {}, 'Hues'), this.#hint, this.#tools),
        this.#body, element('div', {class: 'plane_strip', 'aria-hidden': 'true'}),
        element(
            'div', {class: 'plane_foot'}, element('span', {class: 'hint'}, 'hue 0'), this.#readout,
            element('span', {class: 'hint'}, '255')),
        mistakeLine(store, concerning('pivots')));
    this.#handles = new PivotHandles(this.#body, {store, palette});
    this.#setMode('look');
    store.addEventListener('colors', () => this.#showColors());
  }

  /** What its pixels and regions are shown on. */
  get map() {
    return this.#map;
  }

  #showColors() {
    const {segmenter, exclude} = this.#store.colors;
    const byHue = segmenter === 'hue_pivots';
    this.#tools.hidden = !byHue;
    this.#hint.hidden = !byHue;
    this.#body.classList.toggle('without_pivots', !byHue);
    this.#map.setExclusions((byHue && exclude) || []);
  }

  #setMode(mode) {
    this.#mode = mode;
    this.#body.dataset.mode = mode;
    this.#hint.textContent = mode === 'look' && kTouch.matches ? kTouchHint : kHints[mode];
    this.#areaTool.setAttribute('aria-pressed', String(mode === 'area'));
    this.#selection.cancel();
    if (mode !== 'place') this.#ghost.hide();
  }

  #cell(event) {
    const box = this.#area.getBoundingClientRect();
    const cell = (at, size) =>
        Math.max(0, Math.min(kPlaneSize - 1, Math.floor((at / size) * kPlaneSize)));
    return {
      hue: cell(event.clientX - box.left, box.width),
      row: cell(event.clientY - box.top, box.height)
    };
  }

  #down(event) {
    if (event.button !== 0 || this.#tools.hidden || event.target.closest('button')) return;
    if (this.#mode === 'place') {
      this.#place(this.#cell(event).hue);
      return;
    }
    if (this.#mode !== 'area' && !event.shiftKey) return;
    event.preventDefault();
    this.#area.setPointerCapture(event.pointerId);
    this.#setMode('area');
    this.#selection.begin(this.#cell(event));
  }

  #over(event) {
    const cell = this.#cell(event);
    this.#read(cell);
    if (this.#mode === 'place') this.#ghost.move(cell.hue);
    if (this.#selection.active) this.#selection.extend(cell);
  }

  #up(event) {
    if (!this.#selection.active) return;
    const area = this.#selection.end(this.#cell(event));
    this.#setMode('look');
    if (area === null) return;
    const exclude = this.#store.colors.exclude ?? [];
    if (exclude.length < kMaxExclusions) {
      this.#store.change({exclude: [...exclude, area]});
    } else {
      this.#hint.textContent = `No more than ${kMaxExclusions} areas can be ignored.`;
    }
  }

  #read(cell) {
    const {axis, level} = levelOfRow(cell.row);
    this.#readout.textContent =
        `hue ${cell.hue}, ${axis} ${level}: ${this.#map.colorAt(cell) ?? 'no colour'}`;
  }

  #toggleArea() {
    this.#setMode(this.#mode === 'area' ? 'look' : 'area');
  }

  #choices(choose) {
    return this.#palette.names.map(
        (name) => ({content: [swatch(this.#palette.rgb(name)), name], choose: () => choose(name)}));
  }

  #addAt(event) {
    if (this.#tools.hidden) return;
    const {hue} = this.#cell(event);
    openMenu(
        {x: event.clientX, y: event.clientY}, `New pivot at hue ${hue}`,
        this.#choices((color) => this.#add(color, hue)));
  }

  #chooseAdded(event) {
    const box = event.currentTarget.getBoundingClientRect();
    openMenu({x: box.left, y: box.bottom + 4}, 'New pivot of …', this.#choices((color) => {
      this.#setMode('place');
      this.#ghost.show(color);
      this.#area.focus();
    }));
  }

  #key(event) {
    const way = {ArrowLeft: -1, ArrowRight: 1}[event.key];
    if (event.key === 'Escape' && this.#mode !== 'look') {
      this.#setMode('look');
    } else if (this.#mode === 'place' && way !== undefined) {
      this.#ghost.move(this.#ghost.hue + way * (event.shiftKey ? 5 : 1));
    } else if (this.#mode === 'place' && event.key === 'Enter') {
      this.#place(this.#ghost.hue);
    } else {
      return;
    }
    event.preventDefault();
  }

  #place(hue) {
    this.#setMode('look');
    this.#add(this.#ghost.color, hue);
  }

  #add(color, wanted) {
    const pivots = this.#store.colors.pivots ?? {};
    const added = addPivot(pivots, color, freeHue(pivots, wanted));
    this.#store.change({pivots: added});
    this.#handles.focus({color, index: added[color].length - 1});
  }
}
