import {element, setText} from './element.mjs';

const kStages = ['segment', 'blobs', 'track', 'total'];

/** Frames a second, frames dropped, and what each stage takes of a frame. */
export class Figures {
  #cells = new Map();
  #stages = element('tbody');

  constructor(root) {
    const figure = (key, name) =>
        element('div', {class: 'figure'}, this.#cell(key, 'strong'), element('span', {}, name));
    root.append(element(
        'div', {class: 'figures'},
        element(
            'div', {class: 'figure_row'}, figure('fps', 'frames/s'), figure('frame', 'frame'),
            figure('t', 'seconds'), figure('dropped', 'dropped')),
        element(
            'table', {class: 'stages'},
            element(
                'thead', {},
                element(
                    'tr', {}, element('th', {scope: 'col'}, 'ms a frame'),
                    ...kStages.map((name) => element('th', {scope: 'col'}, name)))),
            this.#stages)));
    for (const [quantile, name] of [['p50', 'median'], ['p99', '99 %']]) {
      this.#stages.append(element(
          'tr', {}, element('th', {scope: 'row', title: `${quantile} of the latest frames`}, name),
          ...kStages.map((stage) => this.#cell(`${stage}/${quantile}`, 'td'))));
    }
  }

  show({frame, t_capture, fps, dropped, ms}) {
    this.#set('fps', fps?.toFixed(1) ?? '–');
    this.#set('frame', String(frame));
    this.#set('t', t_capture?.toFixed(1) ?? '–');
    this.#set('dropped', String(dropped));
    this.#cells.get('dropped').classList.toggle('warn', dropped > 0);
    for (const stage of kStages) {
      for (const quantile of ['p50', 'p99']) {
        this.#set(`${stage}/${quantile}`, ms[stage]?.[quantile]?.toFixed(2) ?? '–');
      }
    }
  }

  #cell(key, tag) {
    const made = element(tag, {'data-figure': key}, '–');
    this.#cells.set(key, made);
    return made;
  }

  #set(key, text) {
    setText(this.#cells.get(key), text);
  }
}
