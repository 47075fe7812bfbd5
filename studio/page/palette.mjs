/** Colours by name: swatches, letters, and what can be read on them. */

import {element} from './element.mjs';

/** The pipeline's palette, [{label, name, rgb}], label 0 being no colour. */
export class Palette {
  #entries;

  constructor(entries) {
    this.#entries = entries;
  }

  /** Names in the order of the labels. */
  get names() {
    return this.#entries.map(({name}) => name);
  }

  /** [r, g, b]; a middle gray for a name the palette has not. */
  rgb(name) {
    return this.#entries.find((entry) => entry.name === name)?.rgb ?? [128, 128, 128];
  }

  /** null for background. */
  nameOfLabel(label) {
    return this.#entries.find((entry) => entry.label === label)?.name ?? null;
  }

  /** The fewest letters that tell the name from all others, the first one large: "B", "Bl". */
  letters(name) {
    for (let count = 1; count < name.length; ++count) {
      const start = name.slice(0, count);
      if (this.names.every((other) => other === name || !other.startsWith(start))) {
        return capitalized(start);
      }
    }
    return capitalized(name);
  }
}

export function capitalized(text) {
  return text.charAt(0).toUpperCase() + text.slice(1);
}

export function cssColor([r, g, b]) {
  return `rgb(${r} ${g} ${b})`;
}

/** Black or white, whichever stands out more on the colour (WCAG relative luminance). */
export function inkOn(rgb) {
  const [r, g, b] = rgb.map((channel) => {
    const part = channel / 255;
    return part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4;
  });
  return 0.2126 * r + 0.7152 * g + 0.0722 * b > 0.179 ? '#000' : '#fff';
}

/** A small square of a colour; its name has to stand beside it. */
export function swatch(rgb) {
  const made = element('span', {class: 'swatch', 'aria-hidden': 'true'});
  made.style.backgroundColor = cssColor(rgb);
  return made;
}
