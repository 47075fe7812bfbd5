import {element, setText} from './element.mjs';
import {capitalized} from './palette.mjs';

const kColumns = {
  object: '',
  x: 'x mm',
  y: 'y mm',
  heading: 'heading',
  confidence: 'conf.',
  state: 'state',
  'frames since seen': 'age'
};

/** Ball and robots of the newest frame, in the order of teams and numbers. */
export class RobotsTable {
  #body = element('tbody');
  #rows = new Map();
  #empty = element('p', {class: 'hint'}, 'Nothing seen.');

  constructor(root) {
    root.append(
        element(
            'table', {class: 'robots'},
            element(
                'thead', {},
                element(
                    'tr', {},
                    ...Object.entries(kColumns).map(
                        ([name, short]) =>
                            element('th', {scope: 'col', abbr: name, title: name}, short)))),
            this.#body),
        this.#empty);
  }

  show(frame) {
    const rows = rowsOf(frame);
    const kept = new Set();
    rows.forEach((row, i) => {
      let key = row.short;
      while (kept.has(key)) key += '+';
      kept.add(key);
      if (!this.#rows.has(key)) this.#rows.set(key, makeRow(row));
      const node = this.#rows.get(key);
      fillRow(node, row);
      if (this.#body.children[i] !== node)
        this.#body.insertBefore(node, this.#body.children[i] ?? null);
    });
    for (const [key, node] of this.#rows) {
      if (kept.has(key)) continue;
      node.remove();
      this.#rows.delete(key);
    }
    this.#empty.hidden = rows.length > 0;
  }
}

/** Ball first, then the robots by team and number, those without one last. */
function rowsOf({ball, robots}) {
  const rows = robots.map(
      (robot) => ({
        ...robot,
        order: robot.id ?? Infinity,
        short: `${capitalized(robot.team)[0]}${robot.id ?? '?'}`,
        name: robot.id === null ? `a ${robot.team} robot` : `${robot.team} robot ${robot.id}`,
      }));
  rows.sort((a, b) => a.team.localeCompare(b.team) || Math.sign(a.order - b.order) || 0);
  return ball === null ? rows : [{...ball, team: 'ball', short: 'Ball', name: 'ball'}, ...rows];
}

function makeRow({team, short, name}) {
  return element(
      'tr', {},
      element(
          'th', {scope: 'row'},
          element('span', {class: `badge badge_${team}`, title: name}, short)),
      element('td'), element('td'), element('td'),
      element(
          'td', {},
          element(
              'div', {class: 'confidence'},
              element(
                  'meter', {min: '0', max: '1', low: '0.5', 'aria-label': `Confidence in ${name}`}),
              element('span'))),
      element('td'), element('td'));
}

function fillRow(node, {x_mm, y_mm, heading_rad, confidence, state, age_frames}) {
  const [, x, y, heading, sure, stateCell, age] = node.children;
  setText(x, x_mm?.toFixed(0) ?? '–');
  setText(y, y_mm?.toFixed(0) ?? '–');
  setText(heading, heading_rad == null ? '' : `${Math.round((heading_rad * 180) / Math.PI)}°`);
  const [meter, percent] = sure.firstElementChild.children;
  meter.value = confidence;
  setText(percent, `${Math.round(confidence * 100)} %`);
  setText(stateCell, state);
  setText(age, String(age_frames ?? ''));
  node.classList.toggle('predicted', state !== 'seen');
}
