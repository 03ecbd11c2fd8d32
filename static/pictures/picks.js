// @ts-check
// Pointer events of a Bokeh plot: clicks, drags and boxes choose values; hovering asks about the point under the pointer.

import { tell } from "../base/bus.js"

/** @type {Record<string, number[]>} */
const NOTHING = { left: [], right: [], top: [], bottom: [] }

/**
 * Round a coordinate to the digits that one pixel resolves; the change is at most half a pixel.
 * @param {number} value
 * @param {{start: number, end: number}} range of the axis
 * @param {number} pixels length of the axis
 * @param {{type: string}} scale of the axis; on a logarithmic one a pixel is a factor
 */
export function toPixel(value, { start, end }, pixels, scale) {
  const pixel = (scale.type === "LogScale" ? value * Math.log(end / start) : end - start) / pixels
  const digits = -Math.floor(Math.log10(Math.abs(pixel)))
  return digits >= 0 && digits <= 100 ? Number(value.toFixed(digits)) : value
}

/**
 * Choose a point of a plot.
 * @param {PlotModel} model
 * @param {number} x
 * @param {number} y
 * @param {boolean} drag whether a drag goes on
 */
export function choose(model, x, y, drag) {
  const { name, x_range: across, y_range: up, x_scale: xScale, y_scale: yScale, inner_width: width, inner_height: height } = model
  tell("pick", { pick: [name, toPixel(x, across, width, xScale), toPixel(y, up, height, yScale)], drag })
}

/**
 * Connect the events of a plot.
 * @param {PlotModel} model
 * @param {string[]} picks Bokeh events that choose a point ("tap", "doubletap", "pan"), "box" for a drag that draws a box and
 *   chooses its corners, "hover" for the position of the mouse
 * @param {Source} box gets the box while it is drawn
 * @param {{isDragging: () => boolean, isOnHandle: () => boolean, isAlone: () => boolean, onceSingle: (act: () => void) => void}} touch
 *   see "touch.js" and "zoom.js"
 */
export function connectPicks(model, picks, box, { isDragging, isOnHandle, isAlone, onceSingle }) {
  const { name } = model
  /** @type {Record<string, ((event: BokehEvent) => void)[]>} */
  const callbacks = {}
  /** @param {BokehEvent} event */
  const point = ({ x, y, event_name: event }) => {
    if (event !== "pan") {
      if (isAlone()) onceSingle(() => choose(model, x, y, false))
    } else if (isDragging()) choose(model, x, y, true)
  }
  for (const pick of picks) {
    if (pick === "hover") callbacks.mousemove = [({ x, y }) => tell("hover", [name, x, y])]
    else if (pick === "box") Object.assign(callbacks, boxCallbacks(name, box, isDragging, (event) => {
      if (!picks.includes("pan") || !isOnHandle()) return false
      if (event.event_name === "pan") point(event)
      return true
    }))
    else callbacks[pick] = [point]
  }
  model.setv({ js_event_callbacks: { ...model.js_event_callbacks, ...callbacks } }, { sync: false })
}

/**
 * @param {string} name
 * @param {Source} box
 * @param {() => boolean} isDragging
 * @param {(event: BokehEvent) => boolean} drag moves the handle; tells whether the drag is one of the handle
 * @returns {Record<string, ((event: BokehEvent) => void)[]>}
 */
function boxCallbacks(name, box, isDragging, drag) {
  /** @type {{x: number, y: number} | null} */
  let start = null
  /** @param {BokehEvent} event */
  const draw = (event) => {
    if (!isDragging()) box.put(NOTHING)
    else if (!drag(event)) box.put({ left: [start.x], right: [event.x], top: [start.y], bottom: [event.y] })
  }
  return {
    panstart: [(event) => {
      start = event
      draw(event)
    }],
    pan: [draw],
    panend: [(event) => {
      const { x, y } = event
      box.put(NOTHING)
      if (isDragging() && !drag(event)) tell("pick", { pick: [name, start.x, start.y, x, y], drag: true })
    }],
  }
}
