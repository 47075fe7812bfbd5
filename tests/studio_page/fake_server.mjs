/**
 * Stands in for `maggic studio` where only its page is looked at: the same addresses and answers,
 * with made-up frames. `node fake_server.mjs [PORT]` serves it for a look by hand.
 */

import {readFile} from 'node:fs/promises';
import {createServer} from 'node:http';
import {basename, extname} from 'node:path';
import {fileURLToPath} from 'node:url';

import {hueDistance, hueOfRgb, rgbOfHsv} from '../../studio/page/hue.mjs';

const kPage = new URL('../../studio/page/', import.meta.url);
const kPicture = new URL('../../docs/pictures/challenging_light.jpg', import.meta.url);
const kTypes = {
  '.html': 'text/html',
  '.css': 'text/css',
  '.mjs': 'text/javascript',
  '.svg': 'image/svg+xml'
};
const kPolicy = 'default-src \'self\'; img-src \'self\' data: blob:';
const kPalette = {
  background: [0, 0, 0],
  orange: [255, 128, 0],
  blue: [40, 80, 255],
  yellow: [255, 220, 0],
  red: [230, 20, 20],
  green: [0, 170, 60],
  cyan: [0, 200, 210],
  magenta: [220, 40, 200]
};
const kNames = Object.keys(kPalette);
const kSize = 256;

const kState = {
  pipeline: 'maggic_3v3',
  source: {name: 'synthetic_match', width: 960, height: 739, fps: 60, live: false},
  palette: kNames.map((name, label) => ({label, name, rgb: kPalette[name]})),
  views: ['overlay', 'original', 'normalized', 'labels'],
  normalizers: ['none', 'chromatic', 'vector', 'weighted'],
  segmenters: ['hue_pivots', 'yuv_boxes'],
};

const kColors = {
  normalizer: 'weighted',
  segmenter: 'hue_pivots',
  gray_threshold: 60,
  hue_of: 'original',
  pivots: {
    orange: [14],
    blue: [160],
    yellow: [38],
    red: [252],
    green: [100],
    cyan: [136],
    magenta: [230]
  },
  exclude: [{hue: [5, 24], value: [0, 90]}],
  boxes: {
    orange: {y: [60, 200], u: [40, 110], v: [170, 240]},
    blue: {y: [20, 120], u: [150, 255], v: [60, 130]}
  },
};

const kRobots = [
  ['blue', 0, -690, 160, -1.57, 0.97, 'seen', 0, 130, 285],
  ['blue', 1, 10, -30, 2.0, 0.97, 'seen', 0, 485, 380],
  ['blue', 2, -200, -190, 1.3, 0.92, 'seen', 0, 378, 460],
  ['yellow', 0, 680, 150, 1.0, 0.88, 'seen', 0, 822, 278],
  ['yellow', 1, 180, 330, 2.2, 0.41, 'predicted', 4, 570, 189],
  ['yellow', 2, 270, 60, 1.65, 0.95, 'seen', 0, 612, 325],
];

/** What a request is refused with. */
export class Refusal extends Error {
  constructor(status, body) {
    super(JSON.stringify(body));
    this.status = status;
    this.body = body;
  }
}

/** The editable settings, their history and their mistakes. */
class Settings {
  now = structuredClone(kColors);
  revision = 1;
  past = [];
  future = [];
  unsaved = false;

  answer() {
    const {boxes, pivots, exclude, hue_of, ...common} = this.now;
    const byHue = common.segmenter === 'hue_pivots';
    return {
      ...common,
      revision: this.revision,
      hue_of,
      pivots: byHue ? pivots : null,
      exclude: byHue ? exclude : null,
      boxes: byHue ? null : boxes,
      undo: this.past.length,
      redo: this.future.length,
      unsaved: this.unsaved,
      compile_ms: 3.9
    };
  }

  change({revision, ...settings}) {
    if (revision !== undefined && revision < this.revision) {
      throw new Refusal(
          409, {error: 'The colours were changed elsewhere; here is what they are now.'});
    }
    const next = {...this.now, ...settings};
    const mistakes = mistakesIn(next);
    if (mistakes.length > 0) throw new Refusal(422, {mistakes});
    this.past.push(this.now);
    this.future = [];
    return this.#use(next);
  }

  undo() {
    return this.#walk(this.past, this.future, 'undo');
  }
  redo() {
    return this.#walk(this.future, this.past, 'redo');
  }

  #walk(from, to, what) {
    if (from.length === 0) throw new Refusal(409, {error: `Nothing to ${what}.`});
    to.push(this.now);
    return this.#use(from.pop());
  }

  #use(next) {
    this.now = next;
    ++this.revision;
    this.unsaved = true;
    return this.answer();
  }
}

function mistakesIn({gray_threshold, pivots}) {
  const mistakes = [];
  if (!Number.isInteger(gray_threshold) || gray_threshold < 0 || gray_threshold > 255) {
    mistakes.push(
        {key: 'segmenter.hue_pivots.gray_threshold', message: 'expected a whole number, 0 … 255'});
  }
  const owners = new Map();
  for (const [color, hues] of Object.entries(pivots)) {
    for (const hue of hues) {
      if (owners.has(hue)) {
        mistakes.push({
          key: `segmenter.hue_pivots.pivots.${color}`,
          message: `${color} and ${owners.get(hue)} have the same hue, ${hue}`
        });
      }
      owners.set(hue, color);
    }
  }
  return mistakes;
}

function labelOf([r, g, b], {gray_threshold, pivots}) {
  const length = Math.hypot(r, g, b) || 1;
  const weighted = [r, g, b].map((channel) => (channel * channel) / length);
  const hue = hueOfRgb([r, g, b]);
  if (hue === null || Math.max(...weighted) - Math.min(...weighted) <= gray_threshold) return 0;
  let best = [Infinity, 0];
  for (const [color, hues] of Object.entries(pivots)) {
    for (const pivot of hues) {
      const distance = hueDistance(pivot, hue);
      if (distance < best[0]) best = [distance, kNames.indexOf(color)];
    }
  }
  return best[1];
}

function colorOfCell(hue, row) {
  const level = 255 - (row % 128) * 2;
  return row < 128 ? rgbOfHsv(hue, 255, level) : rgbOfHsv(hue, level, 255);
}

function planeOf(settings) {
  const labels = new Uint8Array(kSize * kSize);
  for (let i = 0; i < labels.length; ++i)
    labels[i] = labelOf(colorOfCell(i % kSize, i >> 8), settings);
  return {width: kSize, height: kSize, labels: Buffer.from(labels).toString('base64')};
}

function densityAround(clusters) {
  const counts = new Uint8Array(kSize * 128);
  for (let i = 0; i < counts.length; ++i) {
    const [hue, row] = [i % kSize, i >> 8];
    const sum = clusters.reduce(
        (all, [at, level, wide, high]) =>
            all + Math.exp(-((hueDistance(hue, at) / wide) ** 2) - (((row - level) / high) ** 2)),
        0);
    counts[i] = sum < 0.08 ? 0 : Math.min(255, 60 + 170 * sum);
  }
  return {width: kSize, height: 128, counts: Buffer.from(counts).toString('base64')};
}

const kDensity = {
  hue_value: densityAround([
    [14, 60, 3, 14], [160, 55, 4, 20], [36, 30, 4, 14], [250, 50, 4, 18], [101, 66, 5, 16],
    [134, 62, 5, 16], [205, 70, 4, 12], [19, 100, 6, 16]
  ]),
  hue_saturation: densityAround([
    [14, 20, 3, 16], [160, 26, 4, 14], [36, 34, 4, 18], [250, 22, 4, 14], [101, 34, 5, 18],
    [134, 40, 5, 20], [205, 52, 4, 14], [19, 60, 6, 26]
  ]),
};

/** Serves the page at 127.0.0.1; `requests` keeps what was asked, `streams` who watches. */
export class FakeServer {
  settings = new Settings();
  requests = [];
  running = true;
  frame = 95;
  /** Without one, saving without a file name is refused. */
  calibration = null;
  maxStreams = 8;
  /** Before the first frame nobody knows its size. */
  hasFrame = true;
  /** Whether a token is missing. */
  locked = false;
  #pixels = [[200, 90, 10], [30, 60, 190]];
  #picture = null;
  #watchers = new Set();
  #listeners = new Set();
  #server = null;
  #ticker = 0;

  /** @returns {Promise<string>} where it is; port 0 takes a free one, and a later start the same */
  async start(port = this.port ?? 0) {
    this.#picture ??= await readFile(kPicture);
    this.#server = createServer((request, response) => this.#serve(request, response));
    await new Promise(
        (done, failed) => this.#server.once('error', failed).listen(port, '127.0.0.1', done));
    this.port = this.#server.address().port;
    this.#ticker = setInterval(() => this.#tick(), 100);
    return `http://127.0.0.1:${this.port}/`;
  }

  async stop() {
    clearInterval(this.#ticker);
    const closed = new Promise((done) => this.#server.close(done));
    this.#server.closeAllConnections();
    this.#watchers.clear();
    this.#listeners.clear();
    await closed;
  }

  get streams() {
    return [...this.#watchers].map(({view}) => view).sort();
  }

  /** Tells all pages something, as the server does. */
  send(event, data) {
    for (const listener of this.#listeners)
      listener.write(`event: ${event}\ndata: ${JSON.stringify(data)}\n\n`);
  }

  #tick() {
    if (this.running) this.frame += 6;
    for (const {response} of this.#watchers) this.#writePicture(response);
    if (this.running) this.send('frame', this.#frameEvent());
  }

  #frameEvent() {
    const wave = Math.sin(this.frame / 40);
    return {
      frame: this.frame,
      t_capture: this.frame / 60,
      fps: 59.9 + 0.1 * wave,
      dropped: 0,
      processed: this.frame,
      ms: {
        segment: {p50: 0.56, p99: 0.81},
        blobs: {p50: 0.17, p99: 0.22},
        track: {p50: 0.05, p99: 0.09},
        total: {p50: 0.79, p99: 1.12}
      },
      ball: {
        x_mm: -420 + 30 * wave,
        y_mm: 500,
        x_px: 272,
        y_px: 103,
        confidence: 0.93,
        state: 'seen'
      },
      robots: kRobots.map(
          ([team, id, x_mm, y_mm, heading_rad, confidence, state, age_frames, x_px, y_px]) => ({
            team,
            id,
            x_mm: x_mm + 3 * wave,
            y_mm,
            heading_rad,
            confidence,
            state,
            age_frames,
            x_px,
            y_px
          })),
    };
  }

  #writePicture(response) {
    response.write(
        `--frame\r\nContent-Type: image/jpeg\r\nContent-Length: ${this.#picture.length}\r\n\r\n`);
    response.write(this.#picture);
    response.write('\r\n');
  }

  async #serve(request, response) {
    const url = new URL(request.url, 'http://fake');
    let text = '';
    for await (const part of request) text += part;
    const body = text === '' ? undefined : JSON.parse(text);
    this.requests.push({method: request.method, path: url.pathname, query: url.searchParams, body});
    try {
      if (this.locked && url.pathname.startsWith('/api/')) {
        throw new Refusal(401, {error: 'The token is missing.'});
      }
      if (url.pathname === '/api/events')
        this.#openEvents(response);
      else if (url.pathname.startsWith('/api/stream/'))
        this.#openStream(url, response);
      else if (url.pathname.startsWith('/api/'))
        this.#json(response, 200, this.#answer(request.method, url, body));
      else
        await this.#file(url.pathname, response);
    } catch (error) {
      if (!(error instanceof Refusal)) throw error;
      this.#json(response, error.status, error.body);
    }
  }

  #answer(method, url, body) {
    const answers = {
      'GET /api/state': () => ({
        ...kState,
        source: this.hasFrame ? kState.source : {...kState.source, width: 0, height: 0},
        running: this.running,
        streams: {open: this.#watchers.size, max: this.maxStreams}
      }),
      'GET /api/colors': () => this.settings.answer(),
      'PUT /api/colors': () => this.#changed(() => this.settings.change(body)),
      'POST /api/undo': () => this.#changed(() => this.settings.undo()),
      'POST /api/redo': () => this.#changed(() => this.settings.redo()),
      'GET /api/plane': () => planeOf(this.settings.now),
      'GET /api/density': () => kDensity,
      'GET /api/explain': () =>
          this.#explain(Number(url.searchParams.get('x')), Number(url.searchParams.get('y'))),
      'POST /api/save': () => this.#save(body?.file ?? this.calibration),
      'POST /api/pause': () => ({paused: !(this.running = !body.paused)}),
      'POST /api/step': () => ({frame: ++this.frame}),
    };
    const answer = answers[`${method} ${url.pathname}`];
    if (answer === undefined) throw new Refusal(404, {error: `Nothing at ${url.pathname}.`});
    return answer();
  }

  #changed(change) {
    const answer = change();
    this.send('settings', {revision: answer.revision});
    return answer;
  }

  // The left half of the picture is one colour to it, the right half another.
  #explain(x, y) {
    const rgb = this.#pixels[x < kState.source.width / 2 ? 0 : 1];
    const label = kNames[labelOf(rgb, this.settings.now)];
    return {
      x,
      y,
      rgb,
      hue: hueOfRgb(rgb),
      answers: [
        {stage: 'pixel', text: `RGB ${rgb.join(' ')}, hue ${hueOfRgb(rgb)}`},
        {stage: 'normalized', text: 'RGB 181 36 0 by weighted'}, {
          stage: 'label',
          text: `${label}: hue ${hueOfRgb(rgb)} of the original colour is nearest to its pivot`
        },
        {stage: 'blob', text: `98 px of ${label}, 42 × 19 mm`},
        {stage: 'tracker', text: 'team patch of robot 0 at 12 mm from where it was expected'}
      ]
    };
  }

  #save(file) {
    if (file === null)
      throw new Refusal(422, {error: 'Where to? There is no calibration file yet.'});
    if (file.startsWith('/'))
      throw new Refusal(422, {error: `${file} lies outside of the current folder.`});
    this.settings.unsaved = false;
    return {file: `/home/team/${file}`};
  }

  #openEvents(response) {
    response.writeHead(200, {'Content-Type': 'text/event-stream', 'Cache-Control': 'no-store'});
    response.write(': hello\n\n');
    this.#listeners.add(response);
    response.on('close', () => this.#listeners.delete(response));
  }

  #openStream(url, response) {
    const view = basename(url.pathname, '.mjpg');
    if (this.#watchers.size >= this.maxStreams) {
      throw new Refusal(503, {error: 'Too many pictures are being watched.'});
    }
    if (!kState.views.includes(view)) throw new Refusal(404, {error: `No view ${view}.`});
    response.writeHead(
        200,
        {'Content-Type': 'multipart/x-mixed-replace; boundary=frame', 'Cache-Control': 'no-store'});
    const watcher = {view, response};
    this.#watchers.add(watcher);
    response.on('close', () => this.#watchers.delete(watcher));
    this.#writePicture(response);
  }

  async #file(path, response) {
    const name = path === '/' ? 'index.html' : basename(path);
    const bytes = await readFile(new URL(name, kPage)).catch(() => {
      throw new Refusal(404, {error: `Nothing at ${path}.`});
    });
    response.writeHead(200, {
      'Content-Type': kTypes[extname(name)],
      'Content-Security-Policy': kPolicy,
      'X-Content-Type-Options': 'nosniff',
      'Cache-Control': 'no-cache'
    });
    response.end(bytes);
  }

  #json(response, status, body) {
    response.writeHead(status, {'Content-Type': 'application/json'});
    response.end(JSON.stringify(body));
  }
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  console.log(await new FakeServer().start(Number(process.argv[2] ?? 8642)));
}
