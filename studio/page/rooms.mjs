/**
 * Which of the page's rooms is shown: the address's fragment, so that it can be kept and gone back
 * to.
 */

const kRooms = ['live', 'colors'];

/** @param {function(string)} entered called now and at every change */
export function followRooms(entered) {
  const enter = () => {
    const asked = location.hash.slice(1);
    const room = kRooms.includes(asked) ? asked : kRooms[0];
    document.body.dataset.room = room;
    for (const link of document.querySelectorAll('.rooms a')) {
      if (link.hash === `#${room}`)
        link.setAttribute('aria-current', 'page');
      else
        link.removeAttribute('aria-current');
    }
    entered(room);
  };
  addEventListener('hashchange', enter);
  enter();
}
