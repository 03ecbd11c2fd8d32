// Pointer events of a Bokeh plot: a click, a drag or a box chooses values; hovering asks what is under the pointer.

import { tell } from "../page/bus.js"

const NOTHING = { left: [], right: [], top: [], bottom: [] }

/**
 * Connect the events of a plot.
 * @param {any} model Bokeh's model of it
 * @param {string[]} picks Bokeh's events that choose a point ("tap", "doubletap", "pan"); "box": a drag draws a box and
 *   chooses its corners; "hover": where the mouse is
 * @param {import("./sources.js").Source} box gets the box that is drawn
 */
export function connectPicks(model, picks, box) {
  const { name } = model
  const callbacks = {}
  const point = ({ x, y, event_name: event }) => tell("pick", { pick: [name, x, y], drag: event === "pan" })
  for (const pick of picks) {
    if (pick === "hover") callbacks.mousemove = [({ x, y }) => tell("hover", [name, x, y])]
    else if (pick === "box") Object.assign(callbacks, boxCallbacks(name, box))
    else callbacks[pick] = [point]
  }
  model.setv({ js_event_callbacks: { ...model.js_event_callbacks, ...callbacks } }, { sync: false })
}

function boxCallbacks(name, box) {
  let start = null
  const draw = ({ x, y }) => box.put({ left: [start.x], right: [x], top: [start.y], bottom: [y] })
  return {
    panstart: [({ x, y }) => {
      start = { x, y }
      draw(start)
    }],
    pan: [draw],
    panend: [({ x, y }) => {
      box.put(NOTHING)
      tell("pick", { pick: [name, start.x, start.y, x, y], drag: true })
    }],
  }
}
