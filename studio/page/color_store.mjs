import {ApiError} from './api.mjs';

/**
 * The colour settings: what the server has, and over it what this page has changed and not yet been
 * answered for. One request is under way at a time; of the changes made meanwhile the latest of
 * each setting is sent.
 *
 * Events: `colors` when `colors` differs, `in-use` (detail: the server's answer) when the server
 * has new ones in use, `mistakes` (detail: [{key, message}], empty when all is well), `problem`
 * (detail: a sentence).
 */
export class ColorStore extends EventTarget {
  #api;
  #confirmed = null;
  #sent = null;
  #waiting = null;
  #commands = [];
  #working = false;
  #newestRevision = -1;

  constructor(api) {
    super();
    this.#api = api;
  }

  /** As they should look now; null before the first answer. */
  get colors() {
    return this.#confirmed && {...this.#confirmed, ...this.#sent, ...this.#waiting};
  }

  /** Changes some settings ({gray_threshold: 40}); returns at once. */
  change(settings) {
    this.#waiting = {...this.#waiting, ...settings};
    this.#tell('colors');
    this.#work();
  }

  undo() {
    this.#do(this.#api.undo);
  }
  redo() {
    this.#do(this.#api.redo);
  }
  refresh() {
    this.#do(this.#api.colors);
  }

  /** Takes note of a revision somebody made; fetches it unless it is this page's own. */
  notice(revision) {
    this.#newestRevision = Math.max(this.#newestRevision, revision);
    if (!this.#working && revision > (this.#confirmed?.revision ?? -1)) this.refresh();
  }

#do(command) {
  this.#commands.push(command);
  this.#work();
}

async #work() {
  if (this.#working) return;
  this.#working = true;
  while (this.#waiting !== null || this.#commands.length > 0) {
    if (this.#waiting !== null)
      await this.#put();
    else
      await this.#run(this.#commands.shift());
  }
  this.#working = false;
  if (this.#newestRevision > (this.#confirmed?.revision ?? -1)) {
    this.#newestRevision = -1;
    this.refresh();
  }
}

async #put() {
  this.#sent = this.#waiting;
  this.#waiting = null;
  try {
    this.#accept(
        await this.#api.changeColors({...this.#sent, revision: this.#confirmed?.revision}));
  } catch (error) {
    this.#sent = null;
    this.#refused(error);
  }
}

async #run(command) {
  try {
    this.#accept(await command());
  } catch (error) {
    this.#refused(error);
  }
}

#accept(colors) {
  this.#sent = null;
  const fresh = colors.revision !== this.#confirmed?.revision;
  this.#confirmed = colors;
  this.#tell('mistakes', []);
  this.#tell('colors');
  if (fresh) this.#tell('in-use', colors);
}

#refused(error) {
  if (!(error instanceof ApiError)) throw error;
  if (error.mistakes.length > 0) {
    this.#tell('mistakes', error.mistakes);
  } else if (error.status === 409) {
    this.#waiting = null;
    this.#commands = [this.#api.colors];
    this.#tell('problem', error.message);
  } else {
    this.#tell('problem', error.message);
  }
  this.#tell('colors');
}

#tell(type, detail) {
  this.dispatchEvent(new CustomEvent(type, {detail}));
}
}
