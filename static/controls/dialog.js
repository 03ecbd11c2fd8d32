// Dialogs over the page, and what they have in common: fields to copy from, menus, files that are saved.

import { button } from "../page/buttons.js"
import { element } from "../page/mount.js"

/** Return a dialog with its title, tools and Close in its head; a click beside it closes it too. */
export function dialogOf(title, className, tools, ...parts) {
  const dialog = element("dialog", {
    className, ariaLabel: title, onclick: ({ target }) => { if (target === dialog) dialog.close() },
    // Nothing of it is for the page beneath.
    onkeydown: (event) => event.stopPropagation(),
  }, element("div", { className: "head" }, element("h2", { textContent: title }), ...tools,
    button("button", () => dialog.close(), { textContent: "Close" })), ...parts)
  return dialog
}

/** Return a part of a dialog, with its heading. */
export const section = (ariaLabel, heading, ...children) => (
  element("section", { ariaLabel }, element("h3", { textContent: heading }), ...children))

/** Return a field of text that is copied. */
export const snippet = (ariaLabel, rows) => (
  element("textarea", { className: "snippet", readOnly: true, rows, ariaLabel, onfocus: ({ target }) => target.select() }))

/** Return the options of a menu for [[value, text], …]. */
export const optionsOf = (pairs) => pairs.map(([value, text]) => new Option(text, value))

/** Save a file by the browser's own way. */
export function saveFile(content, name) {
  const href = URL.createObjectURL(content)
  element("a", { href, download: name }).click()
  URL.revokeObjectURL(href)
}
