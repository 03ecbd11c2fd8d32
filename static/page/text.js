// @ts-check
// A short text that changes often, set as text and never as HTML.  Screen readers announce a paragraph when it changes.

import { listen } from "../base/bus.js"
import { element, update } from "../base/elements.js"

/**
 * Render the text of a key.
 * @param {{key: string, tag?: string, el: HTMLElement}} part
 */
export function render({ key, tag = "p", el }) {
  const item = element(`${tag}.text.${key}`, tag === "p" ? { role: "status" } : {})
  /** @param {string} text */
  const show = (text) => {
    update(item, { textContent: text, hidden: text === "" })
  }
  listen({ texts(texts) { if (key in texts) show(texts[key]) } })
  show("")
  el.append(item)
}
