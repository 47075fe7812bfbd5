import {element} from './element.mjs';
import {concerning, mistakeLine} from './mistakes.mjs';
import {numberSlider} from './number_slider.mjs';
import {SegmenterSwitch} from './segmenter_switch.mjs';

function choice(name, options, changed) {
  const select = element(
      'select', {onchange: () => changed(select.value)},
      ...options.map((option) => element('option', {}, option)));
  return {select, root: element('label', {class: 'field'}, element('span', {}, name), select)};
}

/** Normalizer, segmenter, whose hue, and the gray threshold. */
export function methodChoice(root, {store, normalizers, segmenters}) {
  const others = new SegmenterSwitch();
  const normalizer =
      choice('Normalizer', normalizers, (value) => store.change({normalizer: value}));
  const segmenter = choice(
      'Segmenter', segmenters, (value) => store.change(others.changeTo(value, store.colors)));
  const hueOf =
      choice('Hue of', ['original', 'normalized'], (value) => store.change({hue_of: value}));
  const threshold =
      numberSlider('Gray threshold', (value) => store.change({gray_threshold: value}));
  const compiled = element('p', {class: 'hint compiled'});
  root.append(
      threshold.root, element('p', {class: 'hint'}, 'channels this close together count as gray'),
      mistakeLine(store, concerning('gray_threshold')),
      element('div', {class: 'fields'}, normalizer.root, hueOf.root, segmenter.root),
      mistakeLine(store, (key) => /^(normalizer|segmenter)$|hue_of/.test(key)), compiled);
  store.addEventListener('in-use', ({detail}) => others.remember(detail));
  store.addEventListener('colors', () => {
    const colors = store.colors;
    normalizer.select.value = colors.normalizer;
    segmenter.select.value = colors.segmenter;
    hueOf.select.value = colors.hue_of ?? 'original';
    hueOf.select.disabled = colors.segmenter !== 'hue_pivots';
    threshold.show(colors.gray_threshold);
    compiled.textContent = colors.compile_ms === undefined ?
        '' :
        `all colours worked out anew in ${colors.compile_ms.toFixed(1)} ms`;
  });
}
