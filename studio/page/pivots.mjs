/**
 * The pivots of a segmenter as the server has them, {orange: [14], red: [252, 3], …}, and the
 * changes a person makes to them. Every function returns new pivots and leaves the given ones
 * alone.
 */

import {hueDistance, kHues, wrapHue} from './hue.mjs';

/** All of them in the order of the colours: {color, index within the colour, hue}. */
export function listPivots(pivots) {
  return Object.entries(pivots).flatMap(
      ([color, hues]) => hues.map((hue, index) => ({color, index, hue})));
}

/**
 * The hue nearest to the wanted one that no pivot but `except` sits on: two pivots must differ.
 * @param {number} direction +1 or -1 to look that way round only, 0 for either.
 */
export function freeHue(pivots, wanted, direction = 0, except = null) {
  const taken =
      new Set(listPivots(pivots)
                  .filter(({color, index}) => color !== except?.color || index !== except?.index)
                  .map(({hue}) => hue));
  for (let steps = 0; steps < kHues; ++steps) {
    for (const way of direction === 0 ? [1, -1] : [direction]) {
      const hue = wrapHue(wanted + way * steps);
      if (!taken.has(hue)) return hue;
    }
  }
  return wrapHue(wanted);
}

export function movePivot(pivots, {color, index}, hue) {
  return {...pivots, [color]: pivots[color].map((old, i) => (i === index ? hue : old))};
}

/** With one more; its index is the last of its colour. */
export function addPivot(pivots, color, hue) {
  return {...pivots, [color]: [...(pivots[color] ?? []), hue]};
}

/** Without it; a colour without pivots is left out. */
export function removePivot(pivots, {color, index}) {
  const left = pivots[color].filter((_, i) => i !== index);
  const {[color]: _, ...others} = pivots;
  return left.length === 0 ? others : {...pivots, [color]: left};
}

export function reassignPivot(pivots, pivot, color) {
  if (color === pivot.color) return pivots;
  return addPivot(removePivot(pivots, pivot), color, pivots[pivot.color][pivot.index]);
}

/** The pivot of the colour nearest to the hue, or null when it has none. */
export function nearestPivot(pivots, color, hue) {
  const own = listPivots(pivots).filter((pivot) => pivot.color === color);
  if (own.length === 0) return null;
  return own.reduce(
      (best, pivot) => (hueDistance(pivot.hue, hue) < hueDistance(best.hue, hue) ? pivot : best));
}

/**
 * Pivots that give the hue to the colour: its nearest pivot moved there, or one more added.
 * @returns {{pivots: object}|{obstacle: string}} the obstacle is another colour's pivot at that
 *     very hue, by name.
 */
export function claimHue(pivots, color, hue, {add}) {
  const holder = listPivots(pivots).find((pivot) => pivot.hue === hue);
  if (holder?.color === color) return {pivots};
  if (holder !== undefined) return {obstacle: holder.color};
  const nearest = nearestPivot(pivots, color, hue);
  return {
    pivots: add || nearest === null ? addPivot(pivots, color, hue) :
                                      movePivot(pivots, nearest, hue),
  };
}
