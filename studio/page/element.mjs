/** Small pieces of the page, made without HTML text: nothing a server sends is ever parsed. */

const kSvg = 'http://www.w3.org/2000/svg';

/**
 * An element with attributes, listeners (`onclick: …`) and children (nodes or text). Attributes
 * that are null, undefined or false are left out; true is an attribute without a value.
 */
export function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === 'function')
      made.addEventListener(name.slice(2), value);
    else if (value === true)
      made.setAttribute(name, '');
    else if (value !== false && value != null)
      made.setAttribute(name, value);
  }
  made.append(...children);
  return made;
}

/** A picture of icons.svg; it says nothing to a screen reader. */
export function icon(name) {
  const svg = document.createElementNS(kSvg, 'svg');
  svg.setAttribute('class', 'icon');
  svg.setAttribute('aria-hidden', 'true');
  const use = document.createElementNS(kSvg, 'use');
  use.setAttribute('href', `icons.svg#${name}`);
  svg.append(use);
  return svg;
}

/** Writes a text only where it differs, so that ten updates a second disturb no selection. */
export function setText(node, text) {
  if (node.textContent !== text) node.textContent = text;
}
