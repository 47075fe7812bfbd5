import assert from 'node:assert/strict';
import {test} from 'node:test';

import {ApiError} from '../../studio/page/api.mjs';
import {ColorStore} from '../../studio/page/color_store.mjs';

/** A server whose answers are given by the test, one by one. */
class Server {
  asked = [];
  #answers = [];

  #request = (name) => (body) => new Promise((answer, refuse) => {
    this.asked.push(body === undefined ? name : [name, body]);
    this.#answers.push({answer, refuse});
  });
  changeColors = this.#request('put');
  colors = this.#request('get');
  undo = this.#request('undo');
  redo = this.#request('redo');

  async answer(colors) {
    this.#answers.shift().answer(colors);
    await settled();
  }
  async refuse(error) {
    this.#answers.shift().refuse(error);
    await settled();
  }
}

const settled = () => new Promise(setImmediate);

async function loaded() {
  const server = new Server();
  const store = new ColorStore(server);
  store.refresh();
  await server.answer({revision: 1, gray_threshold: 60, hue_of: 'original'});
  server.asked.length = 0;
  return {server, store};
}

function heard(store, type) {
  const details = [];
  store.addEventListener(type, ({detail}) => details.push(detail));
  return details;
}

test('of changes made while one is under way only the latest is sent', async () => {
  const {server, store} = await loaded();
  for (const gray_threshold of [50, 40, 30]) store.change({gray_threshold});
  assert.equal(store.colors.gray_threshold, 30);
  await server.answer({revision: 2, gray_threshold: 50, hue_of: 'original'});
  assert.equal(store.colors.gray_threshold, 30, 'an older answer does not jump back');
  await server.answer({revision: 3, gray_threshold: 30, hue_of: 'original'});
  assert.deepEqual(
      server.asked,
      [['put', {gray_threshold: 50, revision: 1}], ['put', {gray_threshold: 30, revision: 2}]]);
});

test('changes of different settings go together', async () => {
  const {server, store} = await loaded();
  store.change({gray_threshold: 50});
  store.change({hue_of: 'normalized'});
  store.change({gray_threshold: 45});
  await server.answer({revision: 2, gray_threshold: 50, hue_of: 'original'});
  assert.deepEqual(
      server.asked[1], ['put', {gray_threshold: 45, hue_of: 'normalized', revision: 2}]);
});

test('mistakes leave the settings as they were and are gone with the next success', async () => {
  const {server, store} = await loaded();
  const mistakes = heard(store, 'mistakes');
  store.change({gray_threshold: 50});
  await server.refuse(new ApiError(422, 'no', [{key: 'gray_threshold', message: 'no'}]));
  assert.equal(store.colors.gray_threshold, 60);
  store.change({gray_threshold: 51});
  await server.answer({revision: 2, gray_threshold: 51});
  assert.deepEqual(mistakes, [[{key: 'gray_threshold', message: 'no'}], []]);
});

test('somebody else having been first brings theirs', async () => {
  const {server, store} = await loaded();
  const problems = heard(store, 'problem');
  store.change({gray_threshold: 50});
  store.change({gray_threshold: 49});
  await server.refuse(new ApiError(409, 'changed elsewhere'));
  assert.deepEqual(server.asked.slice(1), ['get']);
  await server.answer({revision: 9, gray_threshold: 77});
  assert.equal(store.colors.gray_threshold, 77);
  assert.deepEqual(problems, ['changed elsewhere']);
});

test('undo waits for the change before it', async () => {
  const {server, store} = await loaded();
  store.change({gray_threshold: 50});
  store.undo();
  assert.equal(server.asked.length, 1);
  await server.answer({revision: 2, gray_threshold: 50});
  assert.equal(server.asked[1], 'undo');
  await server.answer({revision: 3, gray_threshold: 60});
  assert.equal(store.colors.gray_threshold, 60);
});

test('news of its own change are not fetched, those of others are', async () => {
  const {server, store} = await loaded();
  store.change({gray_threshold: 50});
  store.notice(2);
  await server.answer({revision: 2, gray_threshold: 50});
  assert.equal(server.asked.length, 1);
  store.notice(3);
  assert.equal(server.asked[1], 'get');
});

test('without an answer the change is given up and said to be', async () => {
  const {server, store} = await loaded();
  const problems = heard(store, 'problem');
  store.change({gray_threshold: 50});
  await server.refuse(new ApiError(0, 'Maggic does not answer.'));
  assert.equal(store.colors.gray_threshold, 60);
  assert.deepEqual(problems, ['Maggic does not answer.']);
});
