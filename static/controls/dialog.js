// Dialogs over the page, and what they have in common: fields to copy from, menus, files that are saved.

import { button, element } from "../page/elements.js"

/** Return a dialog with its title, tools and Close in its head; a click beside it closes it too. */
export function dialogOf(title, classes, tools, ...parts) {
  const dialog = element(`dialog.${classes}`, {
    ariaLabel: title, onclick: ({ target }) => { if (target === dialog) dialog.close() },
    // Nothing of it is for the page beneath.
    onkeydown: (event) => event.stopPropagation(),
  }, element("div.head", element("h2", title), ...tools,
    button("button", () => dialog.close(), "Close")), ...parts)
  return dialog
}

/** Return a part of a dialog, with its heading. */
export const section = (ariaLabel, heading, ...children) => (
  element("section", { ariaLabel }, element("h3", heading), ...children))

/** Return a field of text that is copied. */
export const snippet = (ariaLabel, rows) => (
  element("textarea.snippet", { readOnly: true, rows, ariaLabel, onfocus: ({ target }) => target.select() }))

/** Return the options of a menu for [[value, text], …]. */
export const optionsOf = (pairs) => pairs.map(([value, text]) => new Option(text, value))

/** Save a file by the browser's own way. */
export function saveFile(content, name) {
  const href = URL.createObjectURL(content)
  element("a", { href, download: name }).click()
  URL.revokeObjectURL(href)
}
