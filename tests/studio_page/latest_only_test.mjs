import assert from 'node:assert/strict';
import {test} from 'node:test';

import {latestOnly} from '../../studio/page/latest_only.mjs';

test('of calls made meanwhile only the last one is made', async () => {
  const asked = [];
  const answers = [];
  const call = latestOnly((x) => new Promise((done) => {
                            asked.push(x);
                            answers.push(done);
                          }));
  const all = [1, 2, 3].map((x) => call(x));
  answers[0]();
  await new Promise(setImmediate);
  answers[1]();
  await Promise.all(all);
  assert.deepEqual(asked, [1, 3]);
});

test('a call that fails does not hold up the next', async () => {
  let fails = true;
  const asked = [];
  const call = latestOnly(async (x) => {
    asked.push(x);
    if (fails) throw new Error('no');
  });
  await assert.rejects(call(1), /no/);
  fails = false;
  await call(2);
  assert.deepEqual(asked, [1, 2]);
});
