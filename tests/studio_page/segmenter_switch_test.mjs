import assert from 'node:assert/strict';
import {test} from 'node:test';

import {boxesAround, SegmenterSwitch} from '../../studio/page/segmenter_switch.mjs';

const kByHue = {
  segmenter: 'hue_pivots',
  gray_threshold: 60,
  hue_of: 'original',
  pivots: {orange: [14], blue: [160]},
  exclude: [],
  boxes: null,
};

test('boxes to begin with lie around the pivots, apart from each other', () => {
  const {boxes, ...others} = new SegmenterSwitch().changeTo('yuv_boxes', kByHue);
  assert.deepEqual(others, {segmenter: 'yuv_boxes'});
  assert.deepEqual(Object.keys(boxes), ['orange', 'blue']);
  assert.ok(boxes.orange.v[0] > boxes.blue.v[1], 'orange is redder than blue');
  assert.ok(boxes.orange.u[1] < boxes.blue.u[0], 'blue is bluer than orange');
});

test('no box leaves 0 … 255 or is turned round, and there are at most eight', () => {
  const hues = Array.from({length: 256}, (_, hue) => hue);
  for (const hue of hues) {
    for (const [from, to] of Object.values(boxesAround({any: [hue]}).any)) {
      assert.ok(0 <= from && from < to && to <= 255, `hue ${hue}: ${from} … ${to}`);
    }
  }
  const many = Object.fromEntries(hues.slice(0, 12).map((hue) => [`color${hue}`, [hue]]));
  assert.equal(Object.keys(boxesAround(many)).length, 8);
});

test('the way back brings what was there before', () => {
  const others = new SegmenterSwitch();
  others.remember(kByHue);
  const change = others.changeTo('hue_pivots', {segmenter: 'yuv_boxes', boxes: {}, pivots: null});
  assert.deepEqual(change, {
    segmenter: 'hue_pivots',
    gray_threshold: 60,
    hue_of: 'original',
    pivots: {orange: [14], blue: [160]},
    exclude: [],
  });
});
