import {element, icon} from './element.mjs';

const kNoteMs = 6000;
const kMost = 3;
const kTitles = {
  error: 'Error',
  warning: 'Warning',
  note: 'Note'
};

/** Short messages over the page's lower edge; notes go by themselves, the others when closed. */
export class Messages {
  #root;

  constructor(root) {
    this.#root = root;
    root.setAttribute('aria-live', 'polite');
  }

  /** @param {'error'|'warning'|'note'} level */
  show(level, text) {
    const same = [...this.#root.children].find((message) => message.dataset.text === text);
    same?.remove();
    const message = element(
        'div', {class: `message message_${level}`, 'data-text': text},
        element('strong', {}, `${kTitles[level] ?? kTitles.note}: `), element('span', {}, text),
        element(
            'button', {
              class: 'quiet',
              type: 'button',
              'aria-label': 'Close',
              onclick: () => message.remove()
            },
            icon('remove')));
    this.#root.append(message);
    while (this.#root.children.length > kMost) this.#root.firstElementChild.remove();
    if (level === 'note') setTimeout(() => message.remove(), kNoteMs);
  }
}
