// @ts-check
// How the page is shown: embedded in another one, in a window of some size, and in present mode.

import { listen, tell } from "./bus.js"

/** Whether the page is embedded in another one (embed=1). */
export const isEmbedded = new URLSearchParams(location.search).get("embed") === "1"

// Width and height below which a page has the layout of a phone.  The style sheets contain those of a whole page; an embedded
// page needs less room.
const [WIDTH, HEIGHT] = isEmbedded ? ["480px", "320px"] : ["800px", "500px"]

export const PHONE = matchMedia(`(width < ${WIDTH}), (height < ${HEIGHT})`)
// Controls and text share a column as tabs.
export const NARROW = matchMedia("(width < 1500px)")
// The text has room beside the pictures.
export const ROOMY = matchMedia("(width >= 1800px)")
const HAND = matchMedia("(pointer: coarse)")
/** Return instructions for this device: on a touch screen "click" becomes "tap". @param {string} words */
export const byHand = (words) => (HAND.matches ? words.replaceAll(/\b([Cc])lick\b/g, (_, letter) => (letter === "C" ? "Tap" : "tap")) : words)
export const CALM = matchMedia("(prefers-reduced-motion: reduce)")

/** Return a style sheet, written for a whole page, with the phone sizes of this page. @param {string} sheet */
export const sized = (sheet) => (
  sheet.replaceAll(/(?<=width (<|>=) )800px/g, WIDTH).replaceAll(/(?<=height (<|>=) )500px/g, HEIGHT))

// Present mode for lecture halls: larger type, lines and canvases (`zoom`, "shell.css"), and pictures that fill the window.

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
