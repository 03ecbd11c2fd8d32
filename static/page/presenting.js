// @ts-check
// Present mode for lecture halls: larger type, lines and canvases (`zoom`, "shell.css"), pictures that fill the window, a
// drawer with bar, controls, player and legend, and a spot that follows the pointer.

import { listen, tell } from "./bus.js"
import { isEmbedded } from "./embedding.js"
import { button, element, icon } from "./elements.js"
import { onKeys } from "./keys.js"

const LARGER = 2
// Font size in pixels at a desk.
const DESK = 14
const REST = 3000
const SLIDERS = "M4 7h9v2H4zm13 0h3v2h-3zM14 5h2v6h-2zM4 15h3v2H4zm7 0h9v2h-9zM8 13h2v6H8z"

let isOn = false
let type = DESK

/** Return whether present mode is on. */
export const isPresenting = () => isOn

/**
 * Set the font size beside the pictures, in pixels, for `zoom`.
 * @param {number} size
 */
export const setType = (size) => { type = size }

/** Return the factor by which lines, dots and labels on canvases are enlarged. */
export function zoom() {
  return Math.max(isOn ? LARGER : 1, type / DESK)
}

/**
 * Keep the classes `presenting` and `embedded` of an element up to date.
 * @param {HTMLElement} el
 */
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

/**
 * Enter or leave present mode.
 * @param {boolean} on
 */
export function present(on) {
  if (on === isOn) return
  isOn = on
  document.documentElement.toggleAttribute("data-present", on)
  tell("presenting", on)
}

/** Return the button that opens and closes the drawer of present mode. @param {HTMLElement} el the frame of the page */
export function drawer(el) {
  const item = button("drawer", () => draw(!isDrawn), { title: "Controls and legend (M)", ariaLabel: "Controls and legend", innerHTML: icon(SLIDERS) })
  let isDrawn = false
  /** @param {boolean} on */
  const draw = (on) => {
    isDrawn = on
    item.ariaExpanded = String(on)
    el.classList.toggle("drawn-out", on)
  }
  draw(false)
  listen({ presenting: () => draw(false) })
  onKeys({ m: () => isOn && draw(!isDrawn) })
  return item
}

/** Return a spot that follows the pointer and hides while it rests; Escape leaves present mode. */
export function spot() {
  const item = element("div.spot", { ariaHidden: true })
  /** @type {ReturnType<typeof setTimeout>} */
  let resting = null
  document.addEventListener("pointermove", ({ clientX, clientY }) => {
    if (!isOn) return
    clearTimeout(resting)
    item.style.translate = `${clientX}px ${clientY}px`
    item.classList.add("moving")
    resting = setTimeout(() => item.classList.remove("moving"), REST)
  })
  // Older listeners of Escape come first.
  onKeys({ escape: () => isOn && tell("present") }, window)
  return item
}
