// Present mode: what a lecture hall needs to see.  Type, lines and canvases are as large as `zoom` and "shell.css" say,
// of the controls only the essential ones stay, and a spot goes with the pointer.

import { listen, tell } from "./bus.js"
import { isEmbedded } from "./embedding.js"
import { element } from "./elements.js"
import { onKeys } from "./keys.js"

const LARGER = 2
// Type of this size, in pixels, is read at a desk.
const DESK = 14
const REST = 3000

let isOn = false
let type = DESK

export const isPresenting = () => isOn

// The size of the type beside the pictures, in pixels, for `zoom`: whoever places them has looked it up.
export const setType = (size) => { type = size }

// How much wider than beside a desk lines, dots and what is written on canvases are: with the type of a large screen.
export function zoom() {
  return Math.max(isOn ? LARGER : 1, type / DESK)
}

// The component wears the classes `presenting` and `embedded` where that is so.
export function wear(el) {
  const follow = () => {
    el.classList.toggle("presenting", isOn)
    el.classList.toggle("embedded", isEmbedded())
  }
  listen({
    presenting: follow,
    embedding: follow,
  })
  follow()
}

// Enter it, or leave it.
export function present(on) {
  if (on === isOn) return
  isOn = on
  document.documentElement.toggleAttribute("data-present", on)
  tell("presenting", on)
}

// A spot that follows the pointer and hides while it rests; Escape leaves present mode.
export function spot() {
  const item = element("div.spot", { ariaHidden: true })
  let resting = null
  document.addEventListener("pointermove", ({ clientX, clientY }) => {
    if (!isOn) return
    clearTimeout(resting)
    item.style.translate = `${clientX}px ${clientY}px`
    item.classList.add("moving")
    resting = setTimeout(() => item.classList.remove("moving"), REST)
  })
  // After whatever else Escape is for: their listeners are older.
  onKeys({ escape: () => isOn && tell("present") }, window)
  return item
}
