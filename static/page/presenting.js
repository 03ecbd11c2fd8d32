// Present mode: what a lecture hall needs to see.  Type, lines and canvases are as large as `zoom` and "shell.css" say,
// of the controls only the essential ones stay, and a spot goes with the pointer.

import { listen, tell } from "./bus.js"
import { isEmbedded } from "./embedding.js"
import { isTaken } from "./keys.js"
import { element } from "./mount.js"

const LARGER = 2
// Type of this size, in pixels, is read at a desk.
const DESK = 14
const REST = 3000

const root = document.documentElement
let leaving = null
let type = DESK

export const isPresenting = () => leaving !== null

// The size of the type beside the pictures, in pixels, for `zoom`: whoever places them has looked it up.
export const setType = (size) => { type = size }

// How much wider than beside a desk lines, dots and what is written on canvases are: with the type of a large screen.
export function zoom() {
  return Math.max(isPresenting() ? LARGER : 1, type / DESK)
}

// The component wears the classes `presenting` and `embedded` where that is so.
export function wear(el, signal) {
  const follow = () => {
    el.classList.toggle("presenting", isPresenting())
    el.classList.toggle("embedded", isEmbedded())
  }
  for (const mode of ["presenting", "embedding"]) listen(mode, follow, signal)
  follow()
}

// Enter it, or leave it.
export function present(on) {
  if (on === isPresenting()) return
  leaving?.abort()
  leaving = on ? new AbortController() : null
  root.toggleAttribute("data-present", on)
  tell("presenting", on)
  // After whoever else Escape is for: their listeners are older.
  if (on) window.addEventListener("keydown", (event) => {
    if (event.key !== "Escape" || isTaken(event)) return
    event.preventDefault()
    tell("present")
  }, { signal: leaving.signal })
}

// What goes with the pointer, and is not seen while that rests.
export function spot(signal) {
  const item = element("div", { className: "spot", "aria-hidden": "true" })
  let resting = null
  document.addEventListener("pointermove", ({ clientX, clientY }) => {
    if (!isPresenting()) return
    clearTimeout(resting)
    item.style.translate = `${clientX}px ${clientY}px`
    item.classList.add("moving")
    resting = setTimeout(() => item.classList.remove("moving"), REST)
  }, { signal })
  return item
}
