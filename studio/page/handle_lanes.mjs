/**
 * Spreads handles over lanes so that they do not cover each other: each goes to the first lane with
 * room for it, or to the one with the most room where no lane has enough.
 * @param {{center: number, width: number}[]} handles
 * @returns {number[]} a lane for each, in the order given
 */
export function lanesOf(handles, laneCount) {
  const ends = Array(laneCount).fill(-Infinity);
  const lanes = Array(handles.length);
  const fromLeft = handles.map((_, i) => i).sort((a, b) => handles[a].center - handles[b].center);
  for (const i of fromLeft) {
    const begin = handles[i].center - handles[i].width / 2;
    const free = ends.findIndex((end) => end <= begin);
    lanes[i] = free >= 0 ? free : ends.indexOf(Math.min(...ends));
    ends[lanes[i]] = handles[i].center + handles[i].width / 2;
  }
  return lanes;
}
