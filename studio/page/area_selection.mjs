import {element} from './element.mjs';
import {exclusionBetween, kHalf, kPlaneSize} from './exclusions.mjs';

/** The frame drawn over the hue plane while an area is dragged. */
export class AreaSelection {
  frame = element('div', {class: 'plane_selection', hidden: true});
  #corner = null;

  get active() {
    return this.#corner !== null;
  }

  begin(cell) {
    this.#corner = cell;
  }

  extend(cell) {
    const {row, hue} = this.#corner;
    const [first, last] = row < kHalf ? [0, kHalf - 1] : [kHalf, kPlaneSize - 1];
    const end = Math.max(first, Math.min(last, cell.row));
    const percent = (cells) => `${(cells / kPlaneSize) * 100}%`;
    Object.assign(this.frame.style, {
      left: percent(Math.min(hue, cell.hue)),
      width: percent(Math.abs(hue - cell.hue) + 1),
      top: percent(Math.min(row, end)),
      height: percent(Math.abs(row - end) + 1),
    });
    this.frame.hidden = false;
  }

  /** Ends the drag. @returns the exclusion; null for a press without a drag */
  end(cell) {
    const corner = this.#corner;
    this.cancel();
    const stayed = corner.hue === cell.hue && corner.row === cell.row;
    return stayed ? null : exclusionBetween(corner, cell);
  }

  cancel() {
    this.#corner = null;
    this.frame.hidden = true;
  }
}
