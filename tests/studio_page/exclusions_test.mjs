import assert from 'node:assert/strict';
import {test} from 'node:test';

import {exclusionBetween, levelOfRow, rectanglesOf} from '../../studio/page/exclusions.mjs';

test('the rows are value above and saturation below, each from 255 down to 0', () => {
  assert.deepEqual(levelOfRow(0), {axis: 'value', level: 255});
  assert.deepEqual(levelOfRow(127), {axis: 'value', level: 0});
  assert.deepEqual(levelOfRow(128), {axis: 'saturation', level: 255});
  assert.deepEqual(levelOfRow(255), {axis: 'saturation', level: 0});
});

test('a drag in any direction gives the same area', () => {
  const [a, b] = [{hue: 10, row: 100}, {hue: 40, row: 127}];
  assert.deepEqual(exclusionBetween(a, b), {hue: [10, 40], value: [0, 54]});
  assert.deepEqual(exclusionBetween(b, a), exclusionBetween(a, b));
});

test('a drag stays in the half it began in', () => {
  assert.deepEqual(exclusionBetween({hue: 1, row: 120}, {hue: 2, row: 200}).value[0], 0);
  assert.deepEqual(exclusionBetween({hue: 1, row: 200}, {hue: 2, row: 5}).saturation[1], 255);
});

test('an area is drawn where it was dragged', () => {
  for (const [from, to] of [[0, 127], [30, 31], [64, 64], [128, 255], [140, 200]]) {
    const exclusion = exclusionBetween({hue: 3, row: from}, {hue: 9, row: to});
    assert.deepEqual(
        rectanglesOf(exclusion),
        from === 0 || from === 128 ? rectanglesOf({hue: [3, 9]}) :
                                     [{x: 3, y: from, width: 7, height: to - from + 1}]);
  }
});

test('a hue span through 255 is drawn as two parts', () => {
  assert.deepEqual(
      rectanglesOf({hue: [250, 10], saturation: [0, 255], value: [0, 0]}),
      [{x: 250, y: 127, width: 6, height: 1}, {x: 0, y: 127, width: 11, height: 1}]);
});
