// @ts-check
// Plays a scene slowly when it has first been drawn whole, so that newcomers see what moves; the first touch ends it.
//
// It does not play if the user prefers reduced motion, in an embedded page, or in a lesson beside all pictures.

import { listen } from "../base/bus.js"
import { isEmbedded } from "../base/embedding.js"
import { CALM } from "../base/windows.js"

const TOUCHES = ["pointerdown", "keydown", "wheel"]

/**
 * Return enter(name), for a scene on show, and rest(), with which the first scene does not play.
 * @param {{begin: () => void, end: () => void, isOwn: (event: KeyboardEvent) => boolean}} player begin() starts it, end() stops it,
 *   isOwn(event) says whether it handles a touch itself
 */
export function opening({ begin, end, isOwn }) {
  // Scenes that were played.
  const begun = new Set()
  let isResting = false
  let isWaiting = false
  // Motion takes the time of the browser, and on some machines that of the computation.
  let isComputing = false
  let isReading = false
  // Beside pictures that are shown alone the motion goes on under the hand.
  let isAlone = false

  listen({
    alone(names) { isAlone = names.length > 0 },
    reading(on) { isReading = on },
    progress(progress) { isComputing = progress !== null },
    painted() {
      if (isComputing) return
      if (isWaiting && (isAlone || !isReading)) begin()
      isWaiting = false
    },
  })
  for (const name of TOUCHES) {
    document.addEventListener(name, (event) => {
      if (isAlone) return
      isWaiting = false
      if (!isOwn(/** @type {KeyboardEvent} */ (event))) end()
    }, { capture: true, passive: true })
  }
  return {
    /** @param {string} name */
    enter(name) {
      end()
      isWaiting = !isResting && !begun.has(name) && !CALM.matches && !isEmbedded()
      isResting = false
      begun.add(name)
    },
    rest() { isResting = true },
  }
}
