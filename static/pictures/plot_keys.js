// @ts-check
// The keyboard in a plot: arrow keys move the handle by a pixel, with Shift by ten.  A plot without a handle has a cross, which
// Enter chooses.  The plot is zoomed at the handle or the cross.

import { listen, tell } from "../base/bus.js"
import { element } from "../base/elements.js"
import { arrowOf } from "../base/keys.js"
import { within } from "../base/numbers.js"
import { toValues } from "./frame.js"
import { choose } from "./picks.js"

const FAR = 10
/** @type {Record<string, number>} */
const FACTORS = { "+": 0.8, "=": 0.8, "-": 1.25 }

/**
 * Let the keyboard choose in a plot.
 * @param {HTMLElement} host holds the plot
 * @param {PlotView} plot
 * @param {{picks: string[], points: (() => number[][]) | null, zoom: {by: (factor: number, point: number[]) => void, restore: () => void}}} what
 *   the events of the plot, see "picks.js", the points of its handle in pixels, and its zoom
 */
export function connectKeys(host, plot, { picks, points, zoom }) {
  const { frame, model } = plot
  const cross = element("span.cross", { ariaHidden: true, hidden: true })
  host.append(cross)
  Object.assign(host, { tabIndex: 0, role: "application" })
  // Pixels of the plot; a handle has moved on when its last step is painted.
  /** @type {number[] | null} */
  let at = null
  let isPointed = false

  function put() {
    cross.hidden = at === null
    if (at !== null) Object.assign(cross.style, { left: `${at[0]}px`, top: `${at[1]}px` })
  }

  function leave() {
    at = null
    put()
  }

  function here() {
    const { x0, x1, y0, y1 } = frame.bbox
    return at ?? points?.()[0] ?? [(x0 + x1) / 2, (y0 + y1) / 2]
  }

  /** @param {number[]} arrow @param {number} step */
  function move([across, up], step) {
    const { x0, x1, y0, y1 } = frame.bbox
    const from = here()
    at = [within(from[0] + step * across, x0, x1), within(from[1] - step * up, y0, y1)]
    const [x, y] = toValues(plot, at)
    if (points !== null) return choose(model, x, y, false)
    put()
    if (picks.includes("hover")) tell("hover", [model.name, x, y])
  }

  host.addEventListener("keydown", (event) => {
    if (isPointed || event.ctrlKey || event.metaKey || event.altKey) return
    const arrow = arrowOf(event)
    if (arrow !== undefined) move(arrow, event.shiftKey ? FAR : 1)
    else if (event.key in FACTORS) zoom.by(FACTORS[event.key], here())
    else if (event.key === "0") zoom.restore()
    else if (event.key === "Enter" && at !== null && points === null) {
      choose(model, ...toValues(plot, at), false)
    } else return
    event.preventDefault()
    event.stopPropagation()
  })
  host.addEventListener("blur", () => {
    isPointed = false
    leave()
  })
  // A click brings the focus too, but leaves the arrow keys to the player.
  host.addEventListener("pointerdown", () => {
    isPointed = true
    leave()
  })
  listen({ painted() { if (points !== null) at = null } })
}
