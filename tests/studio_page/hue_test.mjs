import assert from 'node:assert/strict';
import {test} from 'node:test';

import {hueDistance, hueOfRgb, rgbOfHsv, wrapHue} from '../../studio/page/hue.mjs';

test('a hue is what OpenCV makes of the colour, bit for bit', () => {
  // RGB and hue from cv::cvtColor with COLOR_BGR2HSV_FULL, OpenCV 4.6.
  const colors = [
    [[255, 0, 0], 0],       [[255, 0, 1], 0],       [[40, 40, 200], 171],  [[200, 90, 10], 18],
    [[151, 214, 60], 60],   [[251, 220, 83], 35],   [[174, 136, 55], 29],  [[26, 18, 81], 176],
    [[33, 181, 149], 119],  [[97, 67, 192], 181],   [[238, 45, 85], 247],  [[251, 99, 140], 244],
    [[119, 254, 224], 119], [[182, 245, 249], 131], [[39, 95, 175], 153],  [[41, 126, 44], 87],
    [[151, 223, 84], 65],   [[4, 243, 59], 95],     [[212, 6, 98], 237],   [[11, 88, 33], 98],
    [[207, 104, 37], 17],   [[156, 203, 238], 146], [[2, 7, 255], 170],    [[205, 116, 100], 7],
    [[171, 247, 187], 94],  [[125, 106, 37], 33],   [[230, 191, 162], 18], [[148, 137, 13], 39],
    [[107, 144, 242], 159], [[86, 198, 70], 80],
  ];
  for (const [rgb, hue] of colors) assert.equal(hueOfRgb(rgb), hue, `RGB ${rgb}`);
});

test('gray has no hue', () => {
  for (const level of [0, 1, 128, 255]) assert.equal(hueOfRgb([level, level, level]), null);
});

test('the full colour of every hue has that hue', () => {
  for (let hue = 0; hue < 256; ++hue) {
    assert.ok(hueDistance(hueOfRgb(rgbOfHsv(hue, 255, 255)), hue) <= 1, `hue ${hue}`);
  }
});

test('distances go the short way round and wrapping comes back onto the circle', () => {
  assert.equal(hueDistance(250, 4), 10);
  assert.equal(hueDistance(0, 128), 128);
  assert.equal(wrapHue(-1), 255);
  assert.equal(wrapHue(256), 0);
  for (let a = 0; a < 256; a += 7) {
    for (let b = 0; b < 256; b += 5) {
      assert.equal(hueDistance(a, b), hueDistance(b, a));
      assert.ok(wrapHue(a + hueDistance(a, b)) === b || wrapHue(a - hueDistance(a, b)) === b);
    }
  }
});
