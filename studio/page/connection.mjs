const kRetryMs = 1000;
const kSilenceMs = 4000;

/**
 * The server's events, for as long as the page is looked at; opened again by itself.
 *
 * Events: `up` when the server is there (again), `down` (detail: why, as a sentence) when it is
 * not, and the server's own `frame`, `settings` and `message` with their JSON as detail.
 */
export class Connection extends EventTarget {
  #api;
  #events = null;
  #timer = 0;
  #isUp = null;
  #heardAt_ms = 0;

  constructor(api) {
    super();
    this.#api = api;
    // A page nobody sees holds no connection: a browser has only six for all pages of a server.
    document.addEventListener(
        'visibilitychange', () => (document.hidden ? this.close() : this.open()));
    setInterval(() => this.#checkSilence(), kSilenceMs / 2);
  }

  open() {
    this.close();
    this.#heardAt_ms = performance.now();
    const events = new EventSource('/api/events');
    this.#events = events;
    events.addEventListener('open', () => this.#up());
    events.addEventListener('error', () => this.#lost());
    for (const type of ['frame', 'settings', 'message']) {
      events.addEventListener(type, ({data}) => {
        this.#heardAt_ms = performance.now();
        this.dispatchEvent(new CustomEvent(type, {detail: JSON.parse(data)}));
      });
    }
  }

  close() {
    clearTimeout(this.#timer);
    this.#events?.close();
    this.#events = null;
  }

  #up() {
    this.#heardAt_ms = performance.now();
    if (this.#isUp === true) return;
    this.#isUp = true;
    this.dispatchEvent(new CustomEvent('up'));
  }

  async #lost() {
    this.close();
    this.#timer = setTimeout(() => this.open(), kRetryMs);
    let reason = 'The connection broke.';
    try {
      await this.#api.state();
    } catch (error) {
      reason = error.status === 401 ?
          'This server wants its token: open the address it printed when it was started.' :
          error.message;
    }
    if (this.#events?.readyState === EventSource.OPEN) return;
    this.#isUp = false;
    this.dispatchEvent(new CustomEvent('down', {detail: reason}));
  }

  // A network that swallows packets breaks no connection; a paused pipeline is silent as well.
  async #checkSilence() {
    if (this.#events?.readyState !== EventSource.OPEN) return;
    if (performance.now() - this.#heardAt_ms < kSilenceMs) return;
    this.#heardAt_ms = performance.now();
    await this.#api.state().catch(() => this.#lost());
  }
}
