// The status line: one sentence, and on a click all that it sums up.

import { listen } from "./bus.js"
import { element } from "./mount.js"

export function render({ el, signal }) {
  const summary = element("span", { role: "status" })
  const details = element("div", { className: "text details" })
  const item = element("details", { className: "text status" }, element("summary", {}, summary), details)
  const show = (texts) => {
    if ("summary" in texts) summary.textContent = texts.summary
    if ("status" in texts) details.textContent = texts.status
  }
  listen("texts", show, signal)
  document.addEventListener("pointerdown", (event) => {
    if (!event.composedPath().includes(item)) item.open = false
  }, { signal })
  el.append(item)
}
