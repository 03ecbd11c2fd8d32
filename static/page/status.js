// @ts-check
// The status line: a summary that unfolds into its details.

import { listen } from "../base/bus.js"
import { element, update } from "../base/elements.js"

/** Render the status line. @param {{el: HTMLElement}} part */
export function render({ el }) {
  const summary = element("span", { role: "status" })
  const details = element("div.text.details")
  const item = element("details.text.status", element("summary", summary), details)
  /** @param {Texts} texts */
  const show = (texts) => {
    if ("summary" in texts) update(summary, { textContent: texts.summary })
    if ("status" in texts) update(details, { textContent: texts.status })
  }
  listen({ texts: show })
  document.addEventListener("pointerdown", (event) => {
    if (!event.composedPath().includes(item)) item.open = false
  })
  el.append(item)
}
