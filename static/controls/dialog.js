// @ts-check
// Dialogs over the page and their common parts: snippets to copy, menus, saving of files.

import { button, element } from "../base/elements.js"

/**
 * Return a dialog with a title, tools and a Close button; a click outside closes it too.
 * @param {string} title
 * @param {string} classes
 * @param {Node[]} tools
 * @param {...Node} parts
 * @returns {HTMLDialogElement}
 */
export function dialogOf(title, classes, tools, ...parts) {
  const dialog = /** @type {HTMLDialogElement} */ (element(`dialog.${classes}`, {
    ariaLabel: title, onclick: (/** @type {Event} */ { target }) => { if (target === dialog) dialog.close() },
    // Keep key events of a dialog from the page below.
    onkeydown: (/** @type {Event} */ event) => event.stopPropagation(),
  }, element("div.head", element("h2", title), ...tools,
    button("button", () => dialog.close(), "Close")), ...parts))
  return dialog
}

/**
 * Return a section of a dialog with a heading.
 * @param {string} ariaLabel
 * @param {string} heading
 * @param {...(Node | string)} children
 */
export const section = (ariaLabel, heading, ...children) => (
  element("section", { ariaLabel }, element("h3", heading), ...children))

/**
 * Return a text field whose text is copied.
 * @param {string} ariaLabel
 * @param {number} rows
 */
export const snippet = (ariaLabel, rows) => (
  element("textarea.snippet", {
    readOnly: true, rows, ariaLabel, onfocus: (/** @type {{target: HTMLTextAreaElement}} */ { target }) => target.select(),
  }))

const SAID_FOR = 2000

/**
 * Return a button that copies a text and confirms it, also to screen readers.
 * @param {string} name
 * @param {string} label
 * @param {() => string} text
 */
export function copyButton(name, label, text) {
  const said = element("output.unseen")
  /** @type {ReturnType<typeof setTimeout>} */
  let timer = null
  /** @param {string} words @param {string} announced */
  const say = (words, announced) => {
    clearTimeout(timer)
    item.textContent = words
    said.textContent = announced
  }
  const item = button(`button.param-${name}`, async () => {
    const copied = text()
    let words = "Copied"
    try {
      await navigator.clipboard.writeText(copied)
    } catch {
      // The clipboard is available only on HTTPS pages and localhost.
      words = "Copy it by hand"
    }
    say(words, words)
    timer = setTimeout(() => say(label, ""), SAID_FOR)
  }, label)
  return element("span", item, said)
}

/**
 * Return the options of a menu.
 * @param {(readonly [value: string, text: string, ...unused: unknown[]])[]} pairs
 */
export const optionsOf = (pairs) => pairs.map(([value, text]) => new Option(text, value))

/**
 * Return a group of check boxes.
 * @param {string} name class of the group
 * @param {string} label
 * @param {() => void} [onchange]
 */
export function choices(name, label, onchange) {
  const list = element("div.choices", { onchange })
  return {
    frame: element(`fieldset.${name}`, element("legend", label), list),
    /** @param {[value: string, words: string, isChecked: boolean][]} items */
    put(items) {
      list.replaceChildren(...items.map(([value, words, checked]) => element("label",
        element("input", { type: "checkbox", value, checked }), words)))
    },
    chosen: () => /** @type {HTMLInputElement[]} */ ([...list.querySelectorAll("input:checked")]).map((box) => box.value),
  }
}

/**
 * Let the browser save a file.
 * @param {Blob} content
 * @param {string} name
 */
export function saveFile(content, name) {
  const href = URL.createObjectURL(content)
  element("a", { href, download: name }).click()
  URL.revokeObjectURL(href)
}
