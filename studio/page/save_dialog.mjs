import {ApiError} from './api.mjs';
import {element} from './element.mjs';

/** Saves; asks for a file name where the server has none. */
export class SaveDialog {
  #api;
  #saved;
  #failed;
  #name = element('input', {
    type: 'text',
    value: 'calibration.yaml',
    required: true,
    autocomplete: 'off',
    spellcheck: 'false',
    'aria-describedby': 'save-problem'
  });
  #problem = element('p', {class: 'mistake', id: 'save-problem', role: 'status'});
  #dialog;

  /**
   * @param {{saved: function(string), failed: function(string)}} handlers file written; sentence
   */
  constructor({api, saved, failed}) {
    this.#api = api;
    this.#saved = saved;
    this.#failed = failed;
    this.#dialog = element(
        'dialog', {'aria-labelledby': 'save-title'},
        element(
            'form', {
              method: 'dialog',
              onsubmit: (event) => {
                event.preventDefault();
                this.#saveAs(this.#name.value.trim());
              }
            },
            element('h2', {id: 'save-title'}, 'Save the calibration'),
            element(
                'label', {class: 'field'},
                element('span', {}, 'File, in the folder Maggic was started in'), this.#name),
            this.#problem,
            element(
                'div', {class: 'dialog_buttons'},
                element('button', {type: 'button', onclick: () => this.#dialog.close()}, 'Cancel'),
                element('button', {type: 'submit', class: 'primary'}, 'Save'))));
    document.body.append(this.#dialog);
  }

  async save() {
    try {
      this.#saved((await this.#api.save()).file);
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      if (error.status === 422)
        this.#ask();
      else
        this.#failed(error.message);
    }
  }

  #ask() {
    this.#problem.textContent = '';
    this.#dialog.showModal();
    this.#name.select();
  }

  async #saveAs(file) {
    try {
      this.#saved((await this.#api.save(file)).file);
      this.#dialog.close();
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      this.#problem.textContent = error.message;
    }
  }
}
