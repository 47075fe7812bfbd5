import {ApiError} from './api.mjs';
import {element, icon} from './element.mjs';

/** Pause and go on; frame by frame while paused, where the source is no camera. */
export class Transport {
  #api;
  #messages;
  #live;
  #running = true;
  #pause = element('button', {type: 'button', onclick: () => this.#toggle()});
  #step = element(
      'button', {
        type: 'button',
        'aria-label': 'Step',
        title: 'One frame on',
        onclick: () => this.#send(this.#api.step)
      },
      icon('step'), element('span', {}, 'Step'));

  constructor(root, {api, messages, live}) {
    this.#api = api;
    this.#messages = messages;
    this.#live = live;
    root.append(this.#pause, this.#step);
    this.show(true);
  }

  show(running) {
    this.#running = running;
    const name = running ? 'Pause' : 'Go on';
    this.#pause.replaceChildren(icon(running ? 'pause' : 'play'), element('span', {}, name));
    this.#pause.setAttribute('aria-label', name);
    this.#step.disabled = running || this.#live;
    this.#step.title = this.#live ? 'A camera cannot be stepped' : 'One frame on, while paused';
  }

  async #toggle() {
    const paused = this.#running;
    if (await this.#send(() => this.#api.pause(paused))) this.show(!paused);
  }

  async #send(request) {
    try {
      await request();
      return true;
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      this.#messages.show('error', error.message);
      return false;
    }
  }
}
