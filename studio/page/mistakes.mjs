import {element} from './element.mjs';

const told = new WeakSet();

/**
 * A line for the mistakes in one setting, where it is set.
 * @param {function(string): boolean} concerns whether the mistake with this key belongs here, as
 *     "segmenter.hue_pivots.pivots.red"
 */
export function mistakeLine(store, concerns) {
  const line = element('p', {class: 'mistake', role: 'status'});
  store.addEventListener('mistakes', ({detail}) => {
    const own = detail.filter(({key}) => concerns(key));
    line.textContent = own.map(({message}) => message).join(' ');
    if (!line.checkVisibility()) return;
    for (const mistake of own) told.add(mistake);
  });
  return line;
}

/** Those of the mistakes no line in sight tells; for listeners added after all lines. */
export function untold(mistakes) {
  return mistakes.filter((mistake) => !told.has(mistake));
}

/** Whether a setting of that name is on the mistake's way. */
export function concerning(...names) {
  return (key) => names.some((name) => key.split(/[.[]/).includes(name));
}
