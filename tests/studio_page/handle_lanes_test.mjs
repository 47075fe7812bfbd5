import assert from 'node:assert/strict';
import {test} from 'node:test';

import {lanesOf} from '../../studio/page/handle_lanes.mjs';

const kWidth = 30;
const handles = (...centers) => centers.map((center) => ({center, width: kWidth}));

test('handles with room stay in the first lane', () => {
  assert.deepEqual(lanesOf(handles(15, 45, 100), 2), [0, 0, 0]);
});

test('neighbours go to different lanes, whatever order they come in', () => {
  assert.deepEqual(lanesOf(handles(40, 20, 60), 2), [1, 0, 0]);
});

test('more than the lanes can hold still get a lane each', () => {
  const lanes = lanesOf(handles(10, 11, 12, 13), 2);
  assert.ok(lanes.every((lane) => lane === 0 || lane === 1));
});
