/** Puts the page together. */

import {api, ApiError} from './api.mjs';
import {ColorStore} from './color_store.mjs';
import {Connection} from './connection.mjs';
import {ExclusionList} from './exclusion_list.mjs';
import {Figures} from './figures.mjs';
import {HuePlane} from './hue_plane.mjs';
import {latestOnly} from './latest_only.mjs';
import {Messages} from './messages.mjs';
import {methodChoice} from './method_choice.mjs';
import {untold} from './mistakes.mjs';
import {Palette} from './palette.mjs';
import {PixelPanel} from './pixel_panel.mjs';
import {quietly} from './quietly.mjs';
import {RobotsTable} from './robots_table.mjs';
import {RoomFeeds} from './room_feeds.mjs';
import {followRooms} from './rooms.mjs';
import {SaveDialog} from './save_dialog.mjs';
import {StreamPicture} from './stream_picture.mjs';
import {Transport} from './transport.mjs';
import {UndoBar} from './undo_bar.mjs';
import {YuvBoxes} from './yuv_boxes.mjs';

const kFirstFrameEvery_ms = 300;
const kBeside = matchMedia('(min-width: 1000px)');

const place = (id) => document.getElementById(id);
const connection = new Connection(api);
const messages = new Messages(place('messages'));

/** What to say where a picture should be and none comes. */
async function whyNone() {
  try {
    const {open, max} = (await api.state()).streams;
    return open >= max ? `All ${max} pictures are being watched. Close another page.` :
                         'No picture; trying again …';
  } catch (error) {
    if (!(error instanceof ApiError)) throw error;
    return error.message;
  }
}

function build(state) {
  const {source} = state;
  const palette = new Palette(state.palette.filter(({label}) => label > 0));
  const store = new ColorStore(api);
  const figures = new Figures(place('figures'));
  const robots = new RobotsTable(place('robots'));
  const pixel = new PixelPanel(place('pixel'), {api, store, palette});
  const plane = new HuePlane(place('hue-plane'), {store, palette});
  const transport = new Transport(place('transport'), {api, messages, live: source.live});
  methodChoice(place('method'), {store, ...state});
  new ExclusionList(place('exclusions'), {store});
  new YuvBoxes(place('boxes'), {store, palette});

  const dialog = new SaveDialog({
    api,
    saved: (file) => {
      messages.show('note', `Saved to ${file}`);
      store.refresh();
    },
    failed: (sentence) => messages.show('error', sentence),
  });
  new UndoBar(place('history'), {store, save: () => dialog.save()});

  const pictures =
      [['first-picture', 'picture', 'overlay'], ['second-picture', 'second picture', 'labels']].map(
          ([id, name, view]) => new StreamPicture(
              place(id), {name, view, views: state.views, size_px: source, whyNone}));
  for (const picture of pictures) {
    picture.addEventListener('pick', ({detail}) => {
      for (const each of pictures) each.mark(detail);
      pixel.show(detail);
    });
  }

  const feeds = new RoomFeeds({api, pictures, map: plane.map});
  const showRunning = latestOnly(quietly(async () => transport.show((await api.state()).running)));
  document.addEventListener('visibilitychange', () => document.hidden || store.refresh());

  // Beside the picture the answer can come into view and leave the picture where it is; the hue
  // plane is not to be moved away.
  pixel.addEventListener('answered', () => {
    if (kBeside.matches && feeds.room === 'live') place('pixel').scrollIntoView({block: 'nearest'});
  });

  store.addEventListener('in-use', () => feeds.showPlane());
  store.addEventListener('mistakes', ({detail}) => {
    for (const {message} of untold(detail)) messages.show('warning', message);
  });
  store.addEventListener('problem', ({detail}) => messages.show('warning', detail));
  store.addEventListener('colors', () => {
    place('exclusions-card').hidden = store.colors.segmenter !== 'hue_pivots';
    place('boxes-card').hidden = store.colors.segmenter !== 'yuv_boxes';
  });

  connection.addEventListener('frame', ({detail}) => {
    figures.show(detail);
    robots.show(detail);
  });
  connection.addEventListener('settings', ({detail}) => store.notice(detail.revision));
  connection.addEventListener('message', ({detail}) => messages.show(detail.level, detail.text));
  connection.addEventListener('up', () => {
    store.refresh();
    feeds.restart();
    showRunning();
  });

  document.documentElement.style.setProperty('--aspect', source.width / source.height);
  place('source').textContent =
      `${state.pipeline} · ${source.name} ${source.width} × ${source.height}`;
  place('source').title = place('source').textContent;
  document.title = `${state.pipeline} – Maggic Studio`;
  transport.show(state.running);
  store.refresh();
  followRooms((room) => {
    feeds.enter(room);
    scrollTo({top: 0, behavior: 'instant'});
  });
}

const banner = place('banner');
connection.addEventListener('up', () => {
  banner.hidden = true;
});
connection.addEventListener('down', ({detail}) => {
  banner.textContent = `No connection to Maggic, trying again … ${detail}`;
  banner.hidden = false;
});

/** The state once a frame has come: before, nobody knows how large the pictures are. */
async function stateWithFrame() {
  for (;;) {
    const state = await api.state();
    if (state.source.width > 0) return state;
    place('source').textContent = `${state.source.name}: waiting for the first frame …`;
    await new Promise((done) => setTimeout(done, kFirstFrameEvery_ms));
  }
}

async function begin() {
  try {
    build(await stateWithFrame());
  } catch (error) {
    if (!(error instanceof ApiError)) throw error;
    messages.show('error', error.message);
    connection.addEventListener('up', begin, {once: true});
  }
}
connection.addEventListener('up', begin, {once: true});
connection.open();
