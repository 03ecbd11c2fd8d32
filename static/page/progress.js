// How much of the state on show is computed while the rest is on its way.  Stop, or Escape, leaves it at that.

import { listen, tell } from "./bus.js"
import { element } from "./mount.js"

const SHOWN_AFTER = 300

export function render({ el, signal }) {
  const bar = element("progress", { "aria-label": "Computed" })
  const stop = element("button", {
    type: "button", className: "button param-stop", textContent: "Stop", title: "Leave it at what is drawn (Escape)",
  })
  const box = element("div", { className: "computing", role: "status", hidden: true }, bar, stop)
  el.append(box)
  let since = null
  const end = () => { if (since !== null) tell("stop") }
  stop.addEventListener("click", end)
  document.addEventListener("keydown", (event) => { if (event.key === "Escape" && since !== null) {
    end()
    event.preventDefault()
  } }, { signal })
  listen("progress", (progress) => {
    if (progress === null) {
      since = null
      box.hidden = true
      return
    }
    since ??= performance.now()
    const [done, of] = progress
    bar.max = of
    bar.value = done
    box.hidden = performance.now() - since < SHOWN_AFTER
  }, signal)
}
