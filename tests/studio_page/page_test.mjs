import assert from 'node:assert/strict';
import {after, afterEach, before, beforeEach, describe, test} from 'node:test';

import {launchBrowser, noBrowser} from './browser.mjs';
import {FakeServer, Refusal} from './fake_server.mjs';

const kLaptop = {
  viewport: {width: 1280, height: 720}
};
const kPhone = {
  viewport: {width: 390, height: 844},
  hasTouch: true,
  isMobile: true,
  deviceScaleFactor: 2
};

describe('the page', {skip: noBrowser}, () => {
  let browser;
  let context;
  let page;
  let server;
  let address;
  let complaints;

  before(async () => {
    browser = await launchBrowser();
  });
  after(async () => {
    await browser.close();
  });

  beforeEach(async () => {
    server = new FakeServer();
    address = await server.start();
  });
  afterEach(async () => {
    await context.close();
    await server.stop();
  });

  async function open(room, device = kLaptop) {
    context = await browser.newContext(device);
    page = await context.newPage();
    page.setDefaultTimeout(5000);
    complaints = [];
    page.on('pageerror', (error) => complaints.push(error.stack));
    page.on('console', (line) => line.type() === 'error' && complaints.push(line.text()));
    await page.goto(`${address}#${room}`);
    await page.locator('.unsaved', {hasText: 'saved'}).waitFor();
  }

  const pivot = (color) => page.getByRole('slider', {name: `Pivot of ${color}`});
  const hueOf = async (color) => Number(await pivot(color).first().getAttribute('aria-valuenow'));
  const changes = () =>
      server.requests.filter(({method}) => method === 'PUT').map(({body}) => body);

  async function until(holds, what) {
    for (let tries = 0; tries < 100; ++tries) {
      if (await holds()) return;
      await new Promise((done) => setTimeout(done, 50));
    }
    assert.fail(`waited in vain for ${what}`);
  }

  async function inPlane(x, y) {
    const box = await page.locator('.plane_area').boundingBox();
    return [box.x + box.width * x, box.y + box.height * y];
  }

  test('shows frames, times and robots as they come', async () => {
    await open('live');
    await page.locator('[data-figure="total/p50"]', {hasText: '0.79'}).waitFor();
    await page.getByRole('row', {name: /Y1 .* 41 % predicted 4/}).waitFor();
    assert.equal(await page.locator('.robots tbody tr').count(), 7);
    const before_frame = await page.locator('[data-figure=frame]').textContent();
    await until(
        async () => (await page.locator('[data-figure=frame]').textContent()) !== before_frame,
        'a new frame');
    assert.deepEqual(complaints, []);
  });

  test('waits for the first frame', async () => {
    server.hasFrame = false;
    context = await browser.newContext(kLaptop);
    page = await context.newPage();
    await page.goto(address);
    await page.getByText('waiting for the first frame').waitFor();
    server.hasFrame = true;
    await page.getByText('960 × 739').waitFor();
  });

  test('asks for no picture nobody sees', async () => {
    await open('live');
    await until(() => server.streams.join() === 'overlay', 'one stream');
    await page.getByRole('link', {name: 'Colours'}).click();
    await until(() => server.streams.join() === 'labels,overlay', 'both streams');
    await page.getByLabel('View of the picture').selectOption('original');
    await until(() => server.streams.join() === 'labels,original', 'the chosen stream');
    await page.getByRole('link', {name: 'Live'}).click();
    await until(() => server.streams.join() === 'original', 'one stream again');
  });

  test('a dragged pivot is sent at once and ends where it was let go', async () => {
    await open('colors');
    const box = await pivot('green').boundingBox();
    const area = await page.locator('.plane_area').boundingBox();
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.mouse.down();
    for (let hues = 1; hues <= 12; ++hues) {
      await page.mouse.move(
          box.x + box.width / 2 + (hues / 256) * area.width, box.y + box.height / 2);
    }
    assert.ok(changes().length > 0, 'sent while dragging');
    await page.mouse.up();
    await until(() => server.settings.now.pivots.green[0] === 112, 'green at 112');
    assert.equal(await hueOf('green'), 112);
    assert.equal(await page.locator('.menu').count(), 0, 'a drag opens no menu');
    assert.deepEqual(complaints, []);
  });

  test('arrow keys move a pivot, past the hue of another', async () => {
    await open('colors');
    await pivot('orange').focus();
    await page.keyboard.press('ArrowRight');
    await until(() => server.settings.now.pivots.orange[0] === 15, 'orange at 15');
    await page.keyboard.press('Shift+ArrowLeft');
    await until(() => server.settings.now.pivots.orange[0] === 10, 'orange at 10');
    for (let presses = 0; presses < 14; ++presses) await page.keyboard.press('ArrowLeft');
    await until(
        () => server.settings.now.pivots.orange[0] === 251, 'orange at 251, red being at 252');
  });

  test('pivots are added, given to another colour and removed', async () => {
    await open('colors');
    await page.mouse.dblclick(...await inPlane(200.5 / 256, 0.1));
    await page.getByRole('menuitem', {name: 'blue', exact: true}).click();
    await until(() => server.settings.now.pivots.blue.join() === '160,200', 'a second blue pivot');

    await page.getByRole('button', {name: 'Add a pivot'}).click();
    await page.getByRole('menuitem', {name: 'red', exact: true}).click();
    await page.keyboard.press('ArrowRight');
    await page.keyboard.press('Enter');
    await until(() => server.settings.now.pivots.red.join() === '252,129', 'a second red pivot');

    await pivot('cyan').focus();
    await page.keyboard.press('Enter');
    await page.getByRole('menuitem', {name: 'make it green'}).click();
    await until(() => server.settings.now.pivots.green.join() === '100,136', 'cyan given to green');
    assert.equal(server.settings.now.pivots.cyan, undefined);

    await pivot('magenta').focus();
    await page.keyboard.press('Delete');
    await until(() => server.settings.now.pivots.magenta === undefined, 'magenta gone');
    assert.equal(await pivot('magenta').count(), 0);
  });

  test('the gray threshold follows slider and number', async () => {
    await open('colors');
    await page.getByRole('slider', {name: 'Gray threshold'}).fill('80');
    await until(() => server.settings.now.gray_threshold === 80, 'threshold 80');
    await page.getByRole('spinbutton', {name: 'Gray threshold'}).fill('33');
    await until(() => server.settings.now.gray_threshold === 33, 'threshold 33');
    assert.equal(await page.getByRole('slider', {name: 'Gray threshold'}).inputValue(), '33');
  });

  test('shift-drag ignores an area, numbers correct it, and it can go again', async () => {
    await open('colors');
    await page.keyboard.down('Shift');
    await page.mouse.move(...await inPlane(100.5 / 256, 200.5 / 256));
    await page.mouse.down();
    await page.mouse.move(...await inPlane(120.5 / 256, 254.5 / 256), {steps: 3});
    await page.mouse.up();
    await page.keyboard.up('Shift');
    await until(() => server.settings.now.exclude.length === 2, 'a second area');
    assert.deepEqual(server.settings.now.exclude[1].hue, [100, 120]);
    assert.deepEqual(Object.keys(server.settings.now.exclude[1]), ['hue', 'saturation']);

    await page.getByLabel('Area 2, hue to').fill('130');
    await page.keyboard.press('Tab');
    await until(() => server.settings.now.exclude[1].hue[1] === 130, 'hue to 130');
    await page.getByRole('button', {name: 'Remove ignored area 1'}).click();
    await until(() => server.settings.now.exclude.length === 1, 'one area');
    assert.deepEqual(server.settings.now.exclude[0].hue, [100, 130]);
  });

  test('an area can be given by numbers alone', async () => {
    await open('colors');
    await page.getByRole('button', {name: 'By numbers'}).focus();
    await page.keyboard.press('Enter');
    await page.keyboard.type('20');
    await page.keyboard.press('Tab');
    await page.keyboard.type('30');
    await page.keyboard.press('Tab');
    await until(() => server.settings.now.exclude.at(-1).hue.join() === '20,30', 'hue 20 … 30');
  });

  test('the regions follow a change', async () => {
    await open('colors');
    const read = async () => {
      await page.mouse.move(...await inPlane(205.5 / 256, 0.05));
      await page.mouse.move(...await inPlane(206.5 / 256, 0.05));
      return page.locator('.plane_readout').textContent();
    };
    await until(
        async () =>
            (await read()).startsWith('hue 206, value') && (await read()).endsWith('magenta'),
        'magenta at 206');
    await pivot('blue').focus();
    for (let presses = 0; presses < 8; ++presses) await page.keyboard.press('Shift+ArrowRight');
    await until(async () => (await read()).endsWith('blue'), 'blue at 206');
  });

  test('a refused setting is told where it is set, and put back', async () => {
    await open('colors');
    server.settings.change = () => {
      throw new Refusal(
          422, {mistakes: [{key: 'segmenter.hue_pivots.gray_threshold', message: 'too gray'}]});
    };
    await page.getByRole('slider', {name: 'Gray threshold'}).fill('80');
    await page.locator('#method .mistake', {hasText: 'too gray'}).waitFor();
    assert.equal(await page.getByRole('slider', {name: 'Gray threshold'}).inputValue(), '60');
  });

  test('a mistake without a place of its own is told as well', async () => {
    await open('colors');
    server.settings.change = () => {
      throw new Refusal(422, {mistakes: [{key: 'field', message: 'no such field'}]});
    };
    await page.getByRole('slider', {name: 'Gray threshold'}).fill('80');
    await page.locator('.message', {hasText: 'no such field'}).waitFor();
  });

  test('a pressed pixel is explained, and its hue given to a colour', async () => {
    await open('live');
    const frame = page.locator('.picture_frame').first();
    const box = await frame.boundingBox();
    await frame.click({position: {x: box.width / 4, y: box.height / 2}});
    await page.locator('.pixel_stages').getByText(/orange: hue 18/).waitFor();
    const {query} = server.requests.find(({path}) => path === '/api/explain');
    assert.ok(
        Math.abs(query.get('x') - 240) <= 1 && Math.abs(query.get('y') - 369) <= 1, `${query}`);

    await page.getByRole('button', {name: 'Make this red'}).click();
    await until(() => server.settings.now.pivots.red[0] === 18, 'red at 18');
    await page.locator('.pixel_stages').getByText(/red: hue 18/).waitFor();
    await page.getByLabel('as one more pivot of that colour').check();
    await page.getByRole('button', {name: 'Make this green'}).click();
    await page.getByText('The pivot of red sits on this very hue').waitFor();
    assert.deepEqual(server.settings.now.pivots.green, [100]);
  });

  test('the crosshair moves by keys', async () => {
    await open('live');
    await page.locator('.picture_frame').first().focus();
    await page.keyboard.press('Enter');
    await page.keyboard.press('Shift+ArrowRight');
    await page.keyboard.press('ArrowUp');
    await page.locator('.pixel_head', {hasText: '490, 368'}).waitFor();
  });

  test('undo and redo by button and key', async () => {
    await open('colors');
    const undo = page.getByRole('button', {name: 'Undo'});
    assert.ok(await undo.isDisabled());
    await pivot('orange').focus();
    await page.keyboard.press('ArrowRight');
    await page.locator('.unsaved_now').waitFor();
    await undo.click();
    await until(async () => await hueOf('orange') === 14, 'orange back at 14');
    await page.keyboard.press('Control+Shift+Z');
    await until(async () => await hueOf('orange') === 15, 'orange at 15 again');
    await page.keyboard.press('Control+z');
    await until(async () => await hueOf('orange') === 14, 'orange back at 14 again');
  });

  test('saving asks for a name where there is none, and says what is wrong with it', async () => {
    await open('colors');
    await page.getByRole('slider', {name: 'Gray threshold'}).fill('70');
    await page.locator('.unsaved_now').waitFor();
    await page.getByRole('button', {name: 'Save'}).click();
    const dialog = page.getByRole('dialog');
    await dialog.getByRole('textbox').fill('/etc/venue.yaml');
    await dialog.getByRole('button', {name: 'Save'}).click();
    await dialog.getByText('lies outside of the current folder').waitFor();
    await dialog.getByRole('textbox').fill('venue.yaml');
    await page.keyboard.press('Enter');
    await page.getByText('Saved to /home/team/venue.yaml').waitFor();
    await page.locator('.unsaved', {hasText: /^saved$/}).waitFor();
    assert.ok(!(await dialog.isVisible()));
  });

  test('what another browser changes is shown here', async () => {
    await open('colors');
    server.send('settings', {revision: server.settings.change({gray_threshold: 91}).revision});
    await until(
        async () =>
            (await page.getByRole('slider', {name: 'Gray threshold'}).inputValue()) === '91',
        '91');
  });

  test('pause holds the frames, step goes one on', async () => {
    await open('live');
    const step = page.getByRole('button', {name: 'Step'});
    assert.ok(await step.isDisabled());
    await page.getByRole('button', {name: 'Pause'}).click();
    await page.getByRole('button', {name: 'Go on'}).waitFor();
    assert.equal(server.running, false);
    const {frame} = server;
    await step.click();
    await until(() => server.frame === frame + 1, 'one frame on');
  });

  test('says when the server is gone, and goes on when it is back', async () => {
    await open('colors');
    await server.stop();
    const banner = page.getByRole('alert');
    await banner.getByText('No connection to Maggic').waitFor();
    server.settings.change({gray_threshold: 42});
    await server.start();
    await banner.waitFor({state: 'hidden'});
    await until(
        async () =>
            (await page.getByRole('slider', {name: 'Gray threshold'}).inputValue()) === '42',
        '42');
    await until(() => server.streams.join() === 'labels,overlay', 'both streams again');
  });

  test('says that a token is missing', async () => {
    await open('live');
    server.locked = true;
    await server.stop();
    await server.start();
    await page.getByRole('alert').getByText('open the address it printed').waitFor();
  });

  test('says when too many pictures are watched, and shows one when it may', async () => {
    await open('live');
    await until(() => server.streams.join() === 'overlay', 'one stream');
    server.maxStreams = 1;
    await page.getByRole('link', {name: 'Colours'}).click();
    await page.getByText('All 1 pictures are being watched').waitFor();
    server.maxStreams = 2;
    await until(() => server.streams.join() === 'labels,overlay', 'both streams');
    await page.getByText('All 1 pictures are being watched').waitFor({state: 'hidden'});
  });

  test('undo reaches the number that is being looked at', async () => {
    await open('colors');
    const number = page.getByRole('spinbutton', {name: 'Gray threshold'});
    await number.fill('33');
    await until(() => server.settings.now.gray_threshold === 33, 'threshold 33');
    await page.keyboard.press('Control+z');
    await until(async () => await number.inputValue() === '60', 'the number back at 60');
  });

  test('what the server tells is shown until it is closed', async () => {
    await open('live');
    server.send('message', {level: 'error', text: 'camera: <b>unplugged</b>'});
    const message = page.locator('.message', {hasText: 'camera: <b>unplugged</b>'});
    await message.getByRole('button', {name: 'Close'}).click();
    await message.waitFor({state: 'detached'});
  });

  test('YUV boxes have six sliders a colour, whose ends do not cross', async () => {
    await open('colors');
    await page.getByLabel('Segmenter').selectOption('yuv_boxes');
    await page.locator('#boxes').getByRole('button', {name: 'blue', exact: true}).click();
    await page.getByRole('slider', {name: 'U from'}).fill('200');
    await until(() => server.settings.now.boxes.blue.u[0] === 200, 'u from 200');
    await page.getByRole('slider', {name: 'U to'}).fill('180');
    await until(() => server.settings.now.boxes.blue.u.join() === '180,180', 'u 180 … 180');
    await page.locator('#boxes').getByRole('button', {name: 'green', exact: true}).click();
    await page.getByRole('button', {name: 'Remove the box of green'}).click();
    await until(() => server.settings.now.boxes.green === undefined, 'no box for green');
    await page.getByRole('button', {name: 'Give green a box'}).click();
    await until(() => server.settings.now.boxes.green !== undefined, 'a box for green');
    assert.equal(await page.locator('.pivot').count(), 0);
    await page.getByLabel('Segmenter').selectOption('hue_pivots');
    await until(async () => await page.locator('.pivot').count() === 7, 'the pivots again');
  });

  for (const room of ['live', 'colors']) {
    test(`fits a phone without scrolling sideways (${room})`, async () => {
      await open(room, kPhone);
      await page.locator('.picture_frame').first().tap();
      await page.locator('.pixel_stages dd').first().waitFor();
      const {wide, seen} = await page.evaluate(() => ({
                                                 wide: document.documentElement.scrollWidth,
                                                 seen: document.documentElement.clientWidth
                                               }));
      assert.equal(seen, 390);
      assert.ok(wide <= seen, `${wide} px wide`);
      assert.deepEqual(complaints, []);
    });
  }
});
