// @ts-check
// Progress of a state that is still being computed; Stop or Escape keeps the part that is drawn.

import { listen, tell } from "../base/bus.js"
import { button, element } from "../base/elements.js"

const SHOWN_AFTER = 300

/** Render the progress bar. @param {{el: HTMLElement}} part */
export function render({ el }) {
  /** @type {number | null} */
  let since = null
  const bar = element("progress", { ariaLabel: "Computed" })
  const stop = button("button.param-stop", () => tell("stop"), { title: "Stop and keep the points computed so far (Escape)" }, "Stop")
  const box = element("div.computing.idle", { role: "status" }, bar, stop)
  el.append(box)
  document.addEventListener("keydown", (event) => {
    if (event.key !== "Escape" || since === null) return
    tell("stop")
    event.preventDefault()
  })
  listen({
    progress(progress) {
      since = progress && (since ?? performance.now())
      box.classList.toggle("idle", progress === null || performance.now() - since < SHOWN_AFTER)
      if (progress !== null) [bar.value, bar.max] = progress
    },
  })
}
