// The status line: one sentence, and on a click all that it sums up.

import { listen, tell } from "./bus.js"
import { element, lifetime } from "./mount.js"

export function render({ model, view, el }) {
  const signal = lifetime({ model, view })
  const summary = element("span", { role: "status" })
  const details = element("div", { className: "text details" })
  const item = element("details", { className: "text status" }, element("summary", {}, summary), details)
  const show = (texts) => {
    if ("summary" in texts) summary.textContent = texts.summary
    if ("status" in texts) details.textContent = texts.status
  }
  listen("texts", show, signal)
  for (const key of ["summary", "status"]) tell("mounted", { kind: "texts", key, show: (text) => show({ [key]: text }) })
  document.addEventListener("pointerdown", (event) => {
    if (!event.composedPath().includes(item)) item.open = false
  }, { signal })
  el.append(item)
}
