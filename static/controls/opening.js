// @ts-check
// Plays a scene slowly when it has first been drawn whole, so that newcomers see what moves.
//
// It does not play if the user prefers reduced motion, in an embedded page, or in a lesson beside all pictures.

import { listen } from "../base/bus.js"
import { isEmbedded } from "../base/embedding.js"
import { CALM } from "../base/windows.js"

/**
 * Return enter(name), for a scene on show, and rest(), with which the first scene does not play.
 * @param {{begin: () => void, end: () => void}} player begin() starts it, end() stops it
 */
export function opening({ begin, end }) {
  // Scenes that have been played.
  const begun = new Set()
  let isResting = false
  let isWaiting = false
  // Animation costs time in the browser, and on some machines delays the computation.
  let isComputing = false
  let isReading = false
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
