/** The server's HTTP interface: one function a request, answers as the server's JSON. */

const kTimeoutMs = 8000;

/** What a request was refused with, in words for the person at the page. */
export class ApiError extends Error {
  /**
   * @param {number} status HTTP status; 0 when there was no answer at all.
   * @param {string} sentence
   * @param {{key: string, message: string}[]} mistakes by setting; empty for other errors.
   */
  constructor(status, sentence, mistakes = []) {
    super(sentence);
    this.status = status;
    this.mistakes = mistakes;
  }
}

async function request(method, path, body) {
  const options = {method, cache: 'no-store', signal: AbortSignal.timeout(kTimeoutMs)};
  if (body !== undefined) {
    options.body = JSON.stringify(body);
    options.headers = {'Content-Type': 'application/json'};
  }
  let response;
  let answer;
  try {
    response = await fetch(path, options);
    answer = await response.json().catch(() => null);
  } catch {
    throw new ApiError(0, 'Maggic does not answer.');
  }
  if (response.ok && answer !== null) return answer;
  const mistakes = answer?.mistakes ?? [];
  const sentence = answer?.error ?? mistakes.map((mistake) => mistake.message).join(' ');
  throw new ApiError(
      response.status, sentence || `The server answered ${response.status}.`, mistakes);
}

export const api = {
  state: () => request('GET', '/api/state'),
  colors: () => request('GET', '/api/colors'),
  changeColors: (change) => request('PUT', '/api/colors', change),
  undo: () => request('POST', '/api/undo', {}),
  redo: () => request('POST', '/api/redo', {}),
  density: () => request('GET', '/api/density'),
  plane: () => request('GET', '/api/plane'),
  explain: (x, y) => request('GET', `/api/explain?x=${x}&y=${y}`),
  save: (file) => request('POST', '/api/save', file === undefined ? {} : {file}),
  pause: (paused) => request('POST', '/api/pause', {paused}),
  step: () => request('POST', '/api/step', {}),
};

/** Where the moving picture of a view is; without a width it comes as large as the camera's. */
export function streamAddress(view, width_px) {
  const size = width_px === undefined ? '' : `?width=${width_px}`;
  return `/api/stream/${encodeURIComponent(view)}.mjpg${size}`;
}

/** The bytes of a base64 text. */
export function bytesOf(base64) {
  return Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
}
