// Plays a scene gently when it is first shown, so that newcomers see what moves.  The first touch ends it.
//
// Not where the user prefers reduced motion, nor inside another page, nor in a lesson, which says itself what moves.

import { listen } from "../page/bus.js"
import { isEmbedded } from "../page/embedding.js"
import { CALM } from "../page/windows.js"

const TOUCHES = ["pointerdown", "keydown", "wheel"]

/**
 * Return {enter(name): the scene is on show; rest(): the first one begins at rest}.
 * @param {{begin: () => void, end: () => void, isOwn: (event: any) => boolean}} player begin() sets it going, end() stops
 *   it; isOwn(event): it answers this touch itself
 */
export function opening({ begin, end, isOwn }) {
  // Scenes that have begun once.
  const begun = new Set()
  let isResting = false
  let isWaiting = false
  let isReading = false

  listen({
    reading(on) { isReading = on },
    painted() {
      if (isWaiting && !isReading) begin()
      isWaiting = false
    },
  })
  for (const name of TOUCHES) {
    document.addEventListener(name, (event) => {
      isWaiting = false
      if (!isOwn(event)) end()
    }, { capture: true, passive: true })
  }
  return {
    enter(name) {
      end()
      isWaiting = !isResting && !begun.has(name) && !CALM.matches && !isEmbedded()
      isResting = false
      begun.add(name)
    },
    rest() { isResting = true },
  }
}
