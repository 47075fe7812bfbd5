import {element} from './element.mjs';

/**
 * A slider with its number beside it, 0 … 255.
 * @param {function(number)} changed called at every move
 * @returns {{root: HTMLElement, show: function(?number)}} null shows as "off"
 */
export function numberSlider(name, changed, {short = name} = {}) {
  const take = (input) => {
    const value = Math.round(Number(input.value));
    if (input.value !== '' && value >= 0 && value <= 255) changed(value);
  };
  const options = {min: '0', max: '255', step: '1', oninput: (event) => take(event.target)};
  const slider = element('input', {type: 'range', 'aria-label': name, ...options});
  const number = element(
      'input', {type: 'number', 'aria-label': `${name}, number`, placeholder: 'off', ...options});
  return {
    root: element(
        'div', {class: 'slider'}, element('span', {class: 'slider_name'}, short), slider, number),
    show(value) {
      slider.value = value ?? 0;
      const shown = String(value ?? '');
      const beingTyped = document.activeElement === number && number.value === '';
      if (!beingTyped && number.value !== shown) number.value = shown;
    },
  };
}
