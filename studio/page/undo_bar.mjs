import {element, icon} from './element.mjs';

/** Undo, redo, whether all is saved, save; with their keys. */
export class UndoBar {
  #store;
  #save;
  #undo;
  #redo;
  #mark = element('span', {class: 'unsaved', role: 'status'});

  /** @param {function()} save */
  constructor(root, {store, save}) {
    this.#store = store;
    this.#save = save;
    this.#undo = element(
        'button', {
          type: 'button',
          title: 'Undo (Ctrl-Z)',
          'aria-label': 'Undo',
          disabled: true,
          onclick: () => store.undo()
        },
        icon('undo'));
    this.#redo = element(
        'button', {
          type: 'button',
          title: 'Redo (Ctrl-Shift-Z)',
          'aria-label': 'Redo',
          disabled: true,
          onclick: () => store.redo()
        },
        icon('redo'));
    root.append(
        this.#undo, this.#redo, this.#mark,
        element(
            'button', {
              type: 'button',
              class: 'primary',
              title: 'Save the calibration (Ctrl-S)',
              'aria-label': 'Save',
              onclick: () => save(),
            },
            icon('save'), element('span', {}, 'Save')));
    store.addEventListener('colors', () => this.#show());
    document.addEventListener('keydown', (event) => this.#key(event));
  }

  #show() {
    const {undo, redo, unsaved} = this.#store.colors;
    this.#undo.disabled = undo === 0;
    this.#redo.disabled = redo === 0;
    this.#mark.textContent = unsaved ? 'unsaved' : 'saved';
    this.#mark.classList.toggle('unsaved_now', unsaved);
  }

  #key(event) {
    if (!event.ctrlKey && !event.metaKey) return;
    if (event.altKey || event.target.closest?.('dialog, input[type=text]')) return;
    const key = event.key.toLowerCase();
    if (key === 'z' && event.shiftKey || key === 'y')
      this.#store.redo();
    else if (key === 'z')
      this.#store.undo();
    else if (key === 's')
      this.#save();
    else
      return;
    event.preventDefault();
  }
}
