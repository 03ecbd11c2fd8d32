// @ts-check
// The animation of a lesson step: it moves a parameter of the scene, or the time of the player.

import { tell } from "../base/bus.js"
import { written } from "../base/numbers.js"

const TIME = "time"
// Number of digits that a box can show.
const DIGITS = 4

/**
 * Return an animation with its label; a touch of the page stops it.
 * @param {AnimationDescription} description
 */
export function createAnimation({ name, start: from, end: to, seconds }) {
  /** @type {number | null} */
  let running = null

  function stop() {
    if (running === null) return
    cancelAnimationFrame(running)
    running = null
    document.removeEventListener("pointerdown", stop, true)
    if (name === TIME) tell("run", null)
  }

  function start() {
    stop()
    document.addEventListener("pointerdown", stop, true)
    if (name === TIME) tell("run", { from, to, seconds })
    const begun = performance.now()
    /** @param {number} now */
    const step = (now) => {
      const share = Math.min(1, (now - begun) / (1000 * seconds))
      // Drop outdated values: the animation runs as fast as states are painted.
      if (name !== TIME) tell("change", { [name]: share === 1 ? to : Number((from + share * (to - from)).toPrecision(DIGITS)) })
      if (share < 1) running = requestAnimationFrame(step)
      else stop()
    }
    running = requestAnimationFrame(step)
  }

  const what = name === TIME ? "t" : name
  return { label: `Play: ${what} from ${written(from, DIGITS)} to ${written(to, DIGITS)}`, start, stop }
}
