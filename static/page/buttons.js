// Buttons and their icons, as the whole page has them.

import { element } from "./mount.js"

/**
 * Return a button.
 * @param {string} className says by `param-…` what the button is for; tests find it by that
 * @param {((event: MouseEvent) => void) | null} onclick
 * @param {object} [properties] see `element`
 * @param {...(Node | string)} children
 */
export function button(className, onclick, properties = {}, ...children) {
  return element("button", { type: "button", className, onclick, ...properties }, ...children)
}

/** Return the HTML of an icon; its path is drawn on 24 × 24 units. */
export function icon(path = "", size = "1.4em") {
  return `<svg viewBox="0 0 24 24" width="${size}" height="${size}" aria-hidden="true"><path fill="currentColor" d="${path}"/></svg>`
}

/** Give a button another icon, tooltip and accessible name. */
export function relabel(item, path, title, ariaLabel = title) {
  item.querySelector("path").setAttribute("d", path)
  Object.assign(item, { title, ariaLabel })
}
