// @ts-check
// Present mode for lecture halls: larger type, lines and canvases (`zoom`, "shell.css"), and pictures that fill the window.

import { listen, tell } from "./bus.js"
import { isEmbedded } from "./windows.js"

const LARGER = 2
// Edge of a picture whose lines, dots and labels have their usual size, in pixels; those of smaller pictures are smaller.
const USUAL = 280
// Font size in pixels at a desk.
const DESK = 14

let isOn = false
let type = DESK

/** Return whether present mode is on. */
export const isPresenting = () => isOn

/**
 * Set the font size beside the pictures, in pixels, for `zoom`.
 * @param {number} size
 */
export const setType = (size) => { type = size }

/** Return the factor by which lines, dots and labels of a picture are enlarged. @param {number} edge of the picture in pixels */
export function zoom(edge) {
  return Math.min(edge / USUAL, Math.max(isOn ? LARGER : 1, type / DESK))
}

/**
 * Give an element the classes `presenting` and `embedded`.
 * @param {HTMLElement} el
 */
export function wear(el) {
  const follow = () => { el.classList.toggle("presenting", isOn) }
  listen({ presenting: follow })
  follow()
  el.classList.toggle("embedded", isEmbedded)
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
