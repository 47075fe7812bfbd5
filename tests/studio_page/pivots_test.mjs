import assert from 'node:assert/strict';
import {test} from 'node:test';

import * as pivotsModule from '../../studio/page/pivots.mjs';

const {addPivot, claimHue, freeHue, listPivots} = pivotsModule;
const {movePivot, nearestPivot, reassignPivot, removePivot} = pivotsModule;

const kPivots = Object.freeze({orange: [14], red: [252, 3], blue: [160]});

test('a change leaves the pivots it was made from alone', () => {
  assert.deepEqual(
      movePivot(kPivots, {color: 'red', index: 1}, 5), {orange: [14], red: [252, 5], blue: [160]});
  assert.deepEqual(addPivot(kPivots, 'cyan', 136).cyan, [136]);
  assert.deepEqual(kPivots, {orange: [14], red: [252, 3], blue: [160]});
});

test('a colour whose last pivot goes is left out', () => {
  assert.deepEqual(removePivot(kPivots, {color: 'orange', index: 0}), {red: [252, 3], blue: [160]});
  assert.deepEqual(removePivot(kPivots, {color: 'red', index: 0}).red, [3]);
});

test('a pivot given to another colour keeps its hue', () => {
  const pivots = reassignPivot(kPivots, {color: 'red', index: 0}, 'blue');
  assert.deepEqual(pivots, {orange: [14], red: [3], blue: [160, 252]});
  assert.equal(reassignPivot(kPivots, {color: 'red', index: 0}, 'red'), kPivots);
});

test('the nearest pivot is looked for around the circle', () => {
  assert.deepEqual(nearestPivot(kPivots, 'red', 255), {color: 'red', index: 0, hue: 252});
  assert.equal(nearestPivot(kPivots, 'cyan', 1), null);
});

test('no two pivots come to the same hue', () => {
  assert.equal(freeHue(kPivots, 20), 20);
  assert.ok([13, 15].includes(freeHue(kPivots, 14)));
  assert.equal(freeHue(kPivots, 14, 0, {color: 'orange', index: 0}), 14);
  assert.equal(freeHue({a: [254, 255, 0]}, 254, 1), 1);
  for (let hue = -3; hue < 259; ++hue) {
    const free = freeHue(kPivots, hue);
    assert.ok(listPivots(kPivots).every((pivot) => pivot.hue !== free));
  }
});

test('a claimed hue takes the nearest pivot of the colour, or one more', () => {
  assert.deepEqual(claimHue(kPivots, 'red', 245, {add: false}).pivots.red, [245, 3]);
  assert.deepEqual(claimHue(kPivots, 'red', 245, {add: true}).pivots.red, [252, 3, 245]);
  assert.deepEqual(claimHue(kPivots, 'cyan', 130, {add: false}).pivots.cyan, [130]);
  assert.deepEqual(claimHue(kPivots, 'orange', 14, {add: true}).pivots, kPivots);
  assert.deepEqual(claimHue(kPivots, 'orange', 160, {add: false}), {obstacle: 'blue'});
});
