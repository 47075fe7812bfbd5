import {element} from './element.mjs';
import {lanesOf} from './handle_lanes.mjs';
import {kHues} from './hue.mjs';
import {openMenu} from './menu.mjs';
import {cssColor, inkOn, swatch} from './palette.mjs';
import {freeHue, listPivots, movePivot, reassignPivot, removePivot} from './pivots.mjs';

const kLanes = 2;
const kNarrow_px = 620;

/**
 * The pivots over the hue plane: a line each, and a handle that is dragged, moved by keys, or
 * asked.
 */
export class PivotHandles {
  #root;
  #store;
  #palette;
  #nodes = new Map();
  #dragged = null;
  #wasDragged = false;

  constructor(root, {store, palette}) {
    this.#root = root;
    this.#store = store;
    this.#palette = palette;
    store.addEventListener('colors', () => this.show());
    new ResizeObserver(() => this.#place()).observe(root);
  }

  show() {
    const pivots = this.#pivots();
    const keys = new Set();
    for (const pivot of listPivots(pivots)) {
      const key = `${pivot.color}/${pivot.index}`;
      keys.add(key);
      if (!this.#nodes.has(key)) this.#nodes.set(key, this.#make(pivot));
      const node = this.#nodes.get(key);
      node.style.left = `${((pivot.hue + 0.5) / kHues) * 100}%`;
      node.dataset.hue = pivot.hue;
      const handle = node.firstElementChild;
      handle.setAttribute('aria-valuenow', pivot.hue);
      handle.setAttribute('aria-valuetext', `${pivot.color} at hue ${pivot.hue}`);
      handle.lastElementChild.textContent = pivot.hue;
    }
    for (const [key, node] of this.#nodes) {
      if (keys.has(key)) continue;
      node.remove();
      this.#nodes.delete(key);
    }
    this.#place();
  }

  /** Gives the focus to a pivot's handle. */
  focus({color, index}) {
    this.#nodes.get(`${color}/${index}`)?.firstElementChild.focus();
  }

  #pivots() {
    const colors = this.#store.colors;
    return (colors?.segmenter === 'hue_pivots' && colors.pivots) || {};
  }

  #make(pivot) {
    const {color} = pivot;
    const rgb = this.#palette.rgb(color);
    const handle = element(
        'button', {
          type: 'button',
          class: 'pivot_handle',
          role: 'slider',
          'aria-label': `Pivot of ${color}`,
          'aria-valuemin': '0',
          'aria-valuemax': String(kHues - 1),
          'aria-orientation': 'horizontal',
          'aria-haspopup': 'menu',
          title: `${color}: drag, or press for more`,
          onkeydown: (event) => this.#key(event, pivot),
        },
        element('span', {class: 'pivot_name'}, color),
        element(
            'span', {class: 'pivot_letters', 'aria-hidden': 'true'}, this.#palette.letters(color)),
        element('span', {class: 'pivot_hue'}));
    const node = element(
        'div', {
          class: 'pivot',
          'data-color': color,
          'data-index': pivot.index,
          onpointerdown: (event) => this.#begin(event, pivot),
          onpointermove: (event) => this.#drag(event),
          onpointerup: () => this.#end(),
          onpointercancel: () => this.#end(),
          onclick: () => this.#press(pivot),
          oncontextmenu: (event) => {
            event.preventDefault();
            this.#openMenu(pivot);
          }
        },
        handle, element('div', {class: 'pivot_line'}));
    node.style.setProperty('--pivot', cssColor(rgb));
    node.style.setProperty('--pivot-ink', inkOn(rgb));
    this.#root.append(node);
    return node;
  }

  #place() {
    const width = this.#root.clientWidth;
    this.#root.classList.toggle('narrow', width < kNarrow_px);
    const nodes = [...this.#nodes.values()];
    const spans = nodes.map((node) => {
      const own = node.firstElementChild.offsetWidth + 2;
      const at = ((Number(node.dataset.hue) + 0.5) / kHues) * width;
      return {at, width: own, center: Math.max(own / 2, Math.min(width - own / 2, at))};
    });
    const lanes = lanesOf(spans, kLanes);
    nodes.forEach((node, i) => {
      node.style.setProperty('--lane', lanes[i]);
      node.style.setProperty('--shift', `${spans[i].center - spans[i].at}px`);
    });
  }

  #begin(event, pivot) {
    if (event.button !== 0 || event.shiftKey) return;
    event.preventDefault();
    event.currentTarget.setPointerCapture(event.pointerId);
    this.focus(pivot);
    this.#dragged = {pivot, from_px: event.clientX, hue: this.#hueOf(pivot), moved: false};
  }

  #drag(event) {
    const drag = this.#dragged;
    if (drag === null) return;
    const way_px = event.clientX - drag.from_px;
    if (!drag.moved && Math.abs(way_px) < 3) return;
    drag.moved = true;
    const hue = Math.round(drag.hue + (way_px / this.#root.clientWidth) * kHues);
    this.#move(drag.pivot, Math.max(0, Math.min(kHues - 1, hue)), 0);
  }

  #end() {
    this.#wasDragged = this.#dragged?.moved ?? false;
    this.#dragged = null;
  }

  // A drag ends in a click as well.
  #press(pivot) {
    if (!this.#wasDragged) this.#openMenu(pivot);
    this.#wasDragged = false;
  }

  #key(event, pivot) {
    const way = {ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1}[event.key];
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (way !== undefined) {
      this.#move(pivot, this.#hueOf(pivot) + way * (event.shiftKey ? 5 : 1), way);
    } else if (event.key === 'Delete' || event.key === 'Backspace') {
      this.#remove(pivot);
    } else {
      return;
    }
    event.preventDefault();
  }

  #hueOf({color, index}) {
    return this.#pivots()[color][index];
  }

  #move(pivot, wanted, direction) {
    const pivots = this.#pivots();
    const hue = freeHue(pivots, wanted, direction, pivot);
    if (hue !== this.#hueOf(pivot)) this.#store.change({pivots: movePivot(pivots, pivot, hue)});
  }

  // Without any pivot the segmenter would take its own.
  #isLast() {
    return listPivots(this.#pivots()).length === 1;
  }

  #remove(pivot) {
    if (this.#isLast()) return;
    this.#store.change({pivots: removePivot(this.#pivots(), pivot)});
    const [next] = listPivots(this.#pivots());
    this.focus(next);
  }

  #openMenu(pivot) {
    const box =
        this.#nodes.get(`${pivot.color}/${pivot.index}`).firstElementChild.getBoundingClientRect();
    const others = this.#palette.names.filter((name) => name !== pivot.color);
    openMenu({x: box.left, y: box.bottom + 4}, `${pivot.color}, hue ${this.#hueOf(pivot)}`, [
      ...others.map(
          (name) => ({
            content: [swatch(this.#palette.rgb(name)), `make it ${name}`],
            choose: () => this.#store.change({pivots: reassignPivot(this.#pivots(), pivot, name)}),
          })),
      {
        content: [this.#isLast() ? 'the only pivot stays' : 'remove'],
        disabled: this.#isLast(),
        choose: () => this.#remove(pivot)
      },
    ]);
  }
}
