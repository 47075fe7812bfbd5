import {element, icon} from './element.mjs';
import {kMaxExclusions} from './exclusions.mjs';
import {concerning, mistakeLine} from './mistakes.mjs';

const kAxes = ['hue', 'value', 'saturation'];
const kWhole = [0, 255];
// Black has no hue and is no colour already: adding this changes nothing before it is edited.
const kHarmless = {
  hue: [0, 0],
  value: [0, 0]
};

function showEnd(input, value) {
  input.value = value;
  input.dataset.shown = value;
}

/** The ignored areas of the hue plane as numbers, to be corrected or removed. */
export class ExclusionList {
  #store;
  #list = element('ol', {class: 'exclusions'});
  #empty = element('p', {class: 'hint'}, 'None. Shift-drag over the hues ignores one.');
  #add = element(
      'button', {type: 'button', onclick: () => this.#addHarmless()}, icon('add'), 'By numbers');

  constructor(root, {store}) {
    this.#store = store;
    root.append(this.#empty, this.#list, this.#add, mistakeLine(store, concerning('exclude')));
    store.addEventListener('colors', () => this.#show());
  }

  #exclusions() {
    return this.#store.colors?.exclude ?? [];
  }

  #show() {
    const exclusions = this.#exclusions();
    this.#empty.hidden = exclusions.length > 0;
    this.#add.disabled = exclusions.length >= kMaxExclusions;
    while (this.#list.children.length > exclusions.length) this.#list.lastElementChild.remove();
    while (this.#list.children.length < exclusions.length) {
      this.#list.append(this.#row(this.#list.children.length));
    }
    exclusions.forEach((exclusion, i) => {
      for (const input of this.#list.children[i].querySelectorAll('input')) {
        const [axis, end] = [input.dataset.axis, Number(input.dataset.end)];
        const beingTyped = document.activeElement === input && input.value !== input.dataset.shown;
        if (!beingTyped) showEnd(input, (exclusion[axis] ?? kWhole)[end]);
      }
    });
  }

  #row(i) {
    return element(
        'li', {},
        ...kAxes.map(
            (axis) => element(
                'span', {class: 'span'}, element('span', {class: 'span_name'}, axis),
                this.#end(i, axis, 0), '–', this.#end(i, axis, 1))),
        element(
            'button', {
              type: 'button',
              class: 'quiet',
              'aria-label': `Remove ignored area ${i + 1}`,
              onclick: () => this.#remove(i)
            },
            icon('remove')));
  }

  #end(i, axis, end) {
    return element('input', {
      type: 'number',
      min: '0',
      max: '255',
      'data-axis': axis,
      'data-end': end,
      'aria-label': `Area ${i + 1}, ${axis} ${end === 0 ? 'from' : 'to'}`,
      onchange: (event) => this.#change(i, axis, end, event.target)
    });
  }

  #change(i, axis, end, input) {
    const value = Number(input.value);
    if (input.value === '' || !Number.isInteger(value) || value < 0 || value > 255) {
      showEnd(input, (this.#exclusions()[i][axis] ?? kWhole)[end]);
      return;
    }
    input.dataset.shown = input.value;
    this.#store.change({
      exclude: this.#exclusions().map((old, each) => {
        if (each !== i) return old;
        const span = [...(old[axis] ?? kWhole)];
        span[end] = value;
        return {...old, [axis]: span};
      })
    });
  }

  #addHarmless() {
    this.#store.change({exclude: [...this.#exclusions(), kHarmless]});
    this.#list.lastElementChild.querySelector('input').focus();
  }

  #remove(i) {
    this.#store.change({exclude: this.#exclusions().filter((_, each) => each !== i)});
  }
}
