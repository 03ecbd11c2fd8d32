// A slider is moved to and fro, one at a time, at a chosen pace.  It stops at the first touch of that slider, at Escape,
// and where another state is chosen.

import { listen, tell } from "../page/bus.js"
import { element } from "../page/mount.js"

// From one end to the other at the pace 1, in milliseconds.
const SWEEP = 8000
const PACES = [0.25, 0.5, 1, 2, 4]
const PLAY = "M7 12 3 8v3H1v2h2v3zm10 0 4-4v3h2v2h-2v3zM9 7h6v10H9z"
const STOP = "M6 6h12v12H6z"

let stop = () => {}
let pace = 1

for (const name of ["preset", "reset", "undo", "redo", "restore", "scene", "enter"]) listen(name, () => stop())
// Before it brings all pictures back.
window.addEventListener("keydown", (event) => {
  if (event.key !== "Escape" || !stop.isRunning) return
  stop()
  event.preventDefault()
}, { capture: true })

// frame: all of the control; limits() → [low, high, value]; move(value) takes a place between them.  [button, menu of paces].
export function animation(frame, label, limits, move) {
  const button = element("button", { type: "button", className: "sway" })
  button.innerHTML = `<svg viewBox="0 0 24 24" width="1.2em" height="1.2em" aria-hidden="true"><path fill="currentColor"/></svg>`
  const menu = element("select", { className: "pace", "aria-label": `Pace of ${label}`, title: "Pace", hidden: true },
    ...PACES.map((value) => new Option(`${value}×`, value)))
  let isRunning = false

  function set(on) {
    isRunning = on
    const says = on ? `Stop ${label} (Escape)` : `Move ${label} to and fro`
    button.title = says
    button.setAttribute("aria-label", says)
    button.setAttribute("aria-pressed", String(on))
    button.querySelector("path").setAttribute("d", on ? STOP : PLAY)
    menu.hidden = !on
    menu.value = pace
  }

  function end() {
    if (!isRunning) return
    set(false)
    stop = () => {}
    tell("animated", false)
  }

  function begin() {
    stop()
    stop = Object.assign(end, { isRunning: true })
    set(true)
    tell("animated", true)
    const [from, to, value] = limits()
    // 0 at the lower end, π at the upper one.
    let phase = to > from ? Math.acos(1 - 2 * Math.min(1, Math.max(0, (value - from) / (to - from)))) : 0
    let last = null
    const step = (now) => {
      if (!isRunning) return
      if (last !== null) phase += (Math.PI * pace * Math.min(100, now - last)) / SWEEP
      last = now
      const [low, high] = limits()
      move(low + (high - low) * (1 - Math.cos(phase)) / 2)
      requestAnimationFrame(step)
    }
    requestAnimationFrame(step)
  }

  set(false)
  button.addEventListener("click", () => { (isRunning ? end : begin)() })
  menu.addEventListener("change", () => { pace = Number(menu.value) })
  for (const name of ["pointerdown", "keydown"]) {
    frame.addEventListener(name, ({ target }) => { if (!button.contains(target) && target !== menu) end() }, { capture: true })
  }
  return [button, menu]
}
