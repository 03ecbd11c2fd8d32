// @ts-check
// Short texts that change often, set as text and never as HTML: notes and numbers, the status line, and the progress of a state.

import { listen, tell } from "../base/bus.js"
import { button, element, say, update } from "../base/elements.js"

const SHOWN_AFTER = 300

/**
 * Render the text of a key.  Screen readers announce a paragraph when it changes.
 * @param {{key: string, tag?: string, el: HTMLElement}} part
 */
export function renderText({ key, tag = "p", el }) {
  const item = element(`${tag}.text.${key}`, { role: tag === "p" ? "status" : null, hidden: true })
  listen({ texts({ [key]: text }) { if (text !== undefined) say(item, text) } })
  el.append(item)
}

/** Render the status line: a summary that unfolds into its details. @param {{el: HTMLElement}} part */
export function renderStatus({ el }) {
  const shown = element("output")
  const details = element("div.text.details")
  const item = element("details.text.status", element("summary", shown), details)
  listen({
    texts({ summary, status }) {
      if (summary !== undefined) update(shown, { textContent: summary })
      if (status !== undefined) update(details, { textContent: status })
    },
  })
  document.addEventListener("pointerdown", (event) => {
    if (!event.composedPath().includes(item)) item.open = false
  })
  el.append(item)
}

/**
 * Render the progress of a state that is still being computed; Stop or Escape keeps the part that is drawn.
 * @param {{el: HTMLElement}} part
 */
export function renderProgress({ el }) {
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
