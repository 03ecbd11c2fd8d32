// @ts-check
// Moves a slider to and fro, one slider at a time.  Touching the slider, Escape, or choosing another state stops it.

import { button, element, icon, relabel } from "../base/elements.js"
import { listen, tell } from "../base/bus.js"
import { within } from "../base/numbers.js"

// Milliseconds from one end to the other at pace 1.
const SWEEP = 8000
const PACES = [0.25, 0.5, 1, 2, 4]
const PLAY = "M7 12 3 8v3H1v2h2v3zm10 0 4-4v3h2v2h-2v3zM9 7h6v10H9z"
const STOP = "M6 6h12v12H6z"

// Stops the animation that is running.
/** @type {(() => void) | null} */
let stop = null
let pace = 1

for (const name of /** @type {(keyof PageEvents)[]} */ (["preset", "reset", "undo", "redo", "restore", "scene", "enter"])) {
  listen({ [name]: () => stop?.() })
}
// Before Escape restores the layout of the pictures.
window.addEventListener("keydown", (event) => {
  if (event.key !== "Escape" || stop === null) return
  stop()
  event.preventDefault()
}, { capture: true })

/**
 * Return the button that moves a slider, and its menu of paces.
 * @param {HTMLElement} frame the whole control
 * @param {import("./number.js").Controlled} number
 * @returns {[HTMLButtonElement, HTMLSelectElement]}
 */
export function animation(frame, { symbol, value, limits, stepOf, move }) {
  const sway = button("sway", () => (stop === end ? end : begin)(), { innerHTML: icon("", "1.2em") })
  const menu = element("select.pace", {
    ariaLabel: `Pace of ${symbol}`, title: "Pace", onchange: () => { pace = Number(menu.value) },
  }, ...PACES.map((value) => new Option(`${value}×`, String(value))))

  /** @param {boolean} on */
  function show(on) {
    relabel(sway, on ? STOP : PLAY, on ? `Stop ${symbol} (Escape)` : `Move ${symbol} to and fro`)
    sway.ariaPressed = String(on)
    menu.hidden = !on
    menu.value = String(pace)
  }

  function end() {
    if (stop !== end) return
    stop = null
    show(false)
    tell("animated", false)
  }

  function begin() {
    stop?.()
    stop = end
    show(true)
    tell("animated", true)
    const [from, to] = limits()
    // The phase is 0 at the lower end and π at the upper end.
    let phase = to > from ? Math.acos(1 - 2 * within((value() - from) / (to - from), 0, 1)) : 0
    /** @type {number | null} */
    let last = null
    /** @param {number} now */
    const step = (now) => {
      if (stop !== end) return
      if (last !== null) phase += (Math.PI * pace * Math.min(100, now - last)) / SWEEP
      last = now
      const [low, high] = limits()
      const place = low + (high - low) * (1 - Math.cos(phase)) / 2
      move(Math.round(place / stepOf()) * stepOf())
      requestAnimationFrame(step)
    }
    requestAnimationFrame(step)
  }

  show(false)
  for (const name of ["pointerdown", "keydown"]) {
    frame.addEventListener(name, ({ target }) => {
      if (!sway.contains(/** @type {Node} */ (target)) && target !== menu) end()
    }, { capture: true })
  }
  return [sway, menu]
}
