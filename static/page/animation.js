// What a step of a lesson animates: a number of the scene, or the time of the player.

import { tell } from "./bus.js"

const TIME = "time"
const shown = (value) => String(Number(value.toPrecision(4))).replace("-", "−")

// {name, start, end, seconds}.  Any touch of the page ends it where it is.
export function createAnimation({ name, start: from, end: to, seconds }) {
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
    const step = (now) => {
      const share = Math.min(1, (now - begun) / (1000 * seconds))
      // The newest value wins, so that it runs as fast as states are painted.
      if (name !== TIME) tell("change", { [name]: share === 1 ? to : from + share * (to - from) })
      if (share < 1) running = requestAnimationFrame(step)
      else stop()
    }
    running = requestAnimationFrame(step)
  }

  const what = name === TIME ? "t" : name
  return { label: `Play: ${what} from ${shown(from)} to ${shown(to)}`, start, stop }
}
