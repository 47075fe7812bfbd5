/** What goes along with another segmenter, so that a look at it and back loses nothing. */

import {rgbOfHsv} from './hue.mjs';

const kOwn = ['gray_threshold', 'hue_of', 'pivots', 'exclude', 'boxes'];
const kMostBoxes = 8;
// A full colour as a tag in the light of a hall shows it, and how far others may be from it.
const kSaturation = 200;
const kValue = 150;
const kReach = 32;
const kLuma = [16, 255];

/** Settings of the segmenters seen so far. */
export class SegmenterSwitch {
  #seen = new Map();

  /** Takes note of the settings in use. */
  remember(colors) {
    const own = kOwn.filter((key) => colors[key] != null).map((key) => [key, colors[key]]);
    this.#seen.set(colors.segmenter, Object.fromEntries(own));
  }

  /** The change to another segmenter: as it was last, or boxes around the pivots to begin with. */
  changeTo(segmenter, colors) {
    const seen = this.#seen.get(segmenter);
    if (seen !== undefined) return {segmenter, ...seen};
    return segmenter === 'yuv_boxes' ? {segmenter, boxes: boxesAround(colors.pivots ?? {})} :
                                       {segmenter};
  }
}

/** A box for each colour around its first pivot. */
export function boxesAround(pivots) {
  return Object.fromEntries(Object.entries(pivots).slice(0, kMostBoxes).map(([color, [hue]]) => {
    const {u, v} = chromaOf(rgbOfHsv(hue, kSaturation, kValue));
    return [color, {y: kLuma, u: around(u), v: around(v)}];
  }));
}

/** U and V of full-range BT.601 in integers, as yuv_boxes has them. */
function chromaOf([r, g, b]) {
  return {
    u: ((-172 * r - 340 * g + 512 * b) >> 10) + 128,
    v: ((512 * r - 419 * g - 83 * b) >> 10) + 128,
  };
}

function around(level) {
  return [Math.max(0, level - kReach), Math.min(255, level + kReach)];
}
