/**
 * Rectangles of the hue plane that are never a colour: {hue, value, saturation}, each [from, to]
 * with both ends included; a span left out is the whole range, and a hue span may run through 255.
 *
 * The plane has 256 columns (hue) and 256 rows: rows 0 … 127 are value 255 → 0, rows 128 … 255
 * saturation 255 → 0.
 */

export const kPlaneSize = 256;
export const kHalf = kPlaneSize / 2;
export const kMaxExclusions = 32;

const kWhole = [0, 255];

/** What a row of the plane stands for. */
export function levelOfRow(row) {
  const axis = row < kHalf ? 'value' : 'saturation';
  return {axis, level: Math.round(255 - ((row % kHalf) * 255) / (kHalf - 1))};
}

function rowOfLevel(level) {
  return Math.round(((255 - level) * (kHalf - 1)) / 255);
}

/** The exclusion dragged from one cell to another; it stays in the half it began in. */
export function exclusionBetween(from, to) {
  const {axis} = levelOfRow(from.row);
  const [first, last] = axis === 'value' ? [0, kHalf - 1] : [kHalf, kPlaneSize - 1];
  const end = Math.min(Math.max(to.row, first), last);
  return {
    hue: [Math.min(from.hue, to.hue), Math.max(from.hue, to.hue)],
    [axis]: [levelOfRow(Math.max(from.row, end)).level, levelOfRow(Math.min(from.row, end)).level],
  };
}

/**
 * Where an exclusion lies in the plane, as {x, y, width, height} in cells; two for a wrapped hue.
 */
export function rectanglesOf({hue = kWhole, value = kWhole, saturation = kWhole}) {
  const columns = hue[0] <= hue[1] ? [hue] : [[hue[0], 255], [0, hue[1]]];
  const whole = ([from, to]) => from === 0 && to === 255;
  const halves = [];
  if (!whole(value) || whole(saturation)) halves.push([0, value]);
  if (!whole(saturation) || whole(value)) halves.push([kHalf, saturation]);
  return halves.flatMap(
      ([top, [from, to]]) => columns.map(([left, right]) => ({
                                           x: left,
                                           y: top + rowOfLevel(to),
                                           width: right - left + 1,
                                           height: rowOfLevel(from) - rowOfLevel(to) + 1,
                                         })));
}
