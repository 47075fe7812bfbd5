import {element} from './element.mjs';

/**
 * Opens a menu at a point of the window and closes it after a choice, Escape or a press elsewhere;
 * the focus then returns to where it was.
 * @param {{x: number, y: number}} at_px
 * @param {{content: (Node|string)[], choose: function(), disabled: boolean}[]} items
 */
export function openMenu(at_px, title, items) {
  const before = document.activeElement;
  const menu = element(
      'div', {class: 'menu', popover: 'auto', role: 'menu', 'aria-label': title},
      element('p', {class: 'menu_title', 'aria-hidden': 'true'}, title));
  for (const {content, choose, disabled} of items) {
    menu.append(element(
        'button', {
          type: 'button',
          role: 'menuitem',
          disabled,
          onclick: () => {
            menu.hidePopover();
            choose();
          }
        },
        ...content));
  }
  const buttons = [...menu.querySelectorAll('button:not([disabled])')];
  menu.addEventListener('keydown', (event) => {
    const step = {ArrowDown: 1, ArrowUp: -1}[event.key];
    if (step === undefined) return;
    const now = buttons.indexOf(document.activeElement);
    buttons.at((now + step) % buttons.length).focus();
    event.preventDefault();
  });
  menu.addEventListener('toggle', (event) => {
    if (event.newState !== 'closed') return;
    const hadFocus =
        menu.contains(document.activeElement) || document.activeElement === document.body;
    menu.remove();
    if (hadFocus) before?.focus();
  });
  document.body.append(menu);
  menu.showPopover();
  const size = menu.getBoundingClientRect();
  menu.style.left = `${Math.max(8, Math.min(at_px.x, innerWidth - size.width - 8))}px`;
  menu.style.top = `${Math.max(8, Math.min(at_px.y, innerHeight - size.height - 8))}px`;
  buttons[0]?.focus();
}
