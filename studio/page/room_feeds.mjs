import {latestOnly} from './latest_only.mjs';
import {countsOf, labelsOf} from './plane_painter.mjs';
import {quietly} from './quietly.mjs';

const kDensityEvery_ms = 1000;

/** Pictures and hue plane of the room one is in, fed while somebody can see them. */
export class RoomFeeds {
  #pictures;
  #room = null;
  #askPlane;
  #askDensity;

  /**
   * @param {{pictures: StreamPicture[], map: PlaneMap}} displays the second picture is of colors
   */
  constructor({api, pictures, map}) {
    this.#pictures = pictures;
    this.#askPlane = latestOnly(quietly(async () => map.setLabels(labelsOf(await api.plane()))));
    this.#askDensity =
        latestOnly(quietly(async () => map.setCounts(countsOf(await api.density()))));
    setInterval(() => this.#planeIsSeen() && this.#askDensity(), kDensityEvery_ms);
    document.addEventListener('visibilitychange', () => this.#feed());
  }

  get room() {
    return this.#room;
  }

  enter(room) {
    this.#room = room;
    this.#feed();
  }

  /** Asks for everything anew: the server was gone. */
  restart() {
    for (const picture of this.#pictures) picture.stop();
    this.#feed();
  }

  /** The labels have changed. */
  showPlane() {
    if (this.#planeIsSeen()) this.#askPlane();
  }

  #planeIsSeen() {
    return this.#room === 'colors' && !document.hidden;
  }

  #feed() {
    const [first, second] = this.#pictures;
    if (document.hidden)
      first.stop();
    else
      first.play();
    if (!this.#planeIsSeen()) {
      second.stop();
      return;
    }
    second.play();
    this.#askPlane();
    this.#askDensity();
  }
}
