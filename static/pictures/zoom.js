// @ts-check
// Zoom in a planar picture: the wheel and two fingers zoom where they are, two fingers and the second mouse button move, a double
// click and a button show the whole.
//
// The source "<picture>-zoom" holds `axes` [x0, x1, y0, y1] while the picture shows others than those of the state, `whole`.  A
// picture whose window is part of the state is computed anew when the wheel has rested; elsewhere the browser alone zooms,
// until the axes of the state change.

import { listen, tell } from "../base/bus.js"
import { button } from "../base/elements.js"
import { isEmbedded } from "../base/modes.js"

const REST = 250
// Milliseconds that a click waits for a second one.
const DOUBLE = 250
// Logarithm of the factor for a pixel of the wheel; a pinch on a touchpad comes as a slower wheel.
const [WHEEL, PINCH] = [0.002, 0.01]
const LINE = 16
// Least extent of the axes relative to their numbers, which have single precision.
const [LEAST, NUMBER] = [1e-5, 1e-3]
const EVERYTHING = [-1e300, -1e300, 1e300, 1e300]

/** @param {number} low @param {number} high */
const isFine = (low, high) => Math.abs(high - low) > LEAST * Math.max(Math.abs(low), Math.abs(high), NUMBER)

/**
 * Return whether axes contain others.
 * @param {Axes} outer
 * @param {Axes} inner
 */
const contain = ([x0, x1, y0, y1], [a0, a1, b0, b1]) => x0 <= a0 && x1 >= a1 && y0 <= b0 && y1 >= b1

/** @param {number[][]} points */
const middle = (points) => [0, 1].map((i) => points.reduce((sum, point) => sum + point[i], 0) / points.length)
/** @param {number[][]} points */
const apart = ([[x, y], [a, b] = [x + 1, y]]) => Math.max(1, Math.hypot(a - x, b - y))

/**
 * Return the part of a frame that fills it when points of it are dragged to others.
 * @param {Frame} frame
 * @param {number[][]} from one point, or two
 * @param {number[][]} to
 * @param {number} [factor] of the extent of the part
 * @returns {Frame}
 */
export function partOf({ x0, x1, y0, y1 }, from, to, factor = apart(from) / apart(to)) {
  const [[x, y], [a, b]] = [middle(from), middle(to)]
  return { x0: x + (x0 - a) * factor, x1: x + (x1 - a) * factor, y0: y + (y0 - b) * factor, y1: y + (y1 - b) * factor }
}

/**
 * Return the axes that a picture shows: those of its zoom, or those of the state.
 * @param {Source} zoom
 * @param {Axes} whole the axes of the state
 * @returns {Axes}
 */
export function zoomed(zoom, whole) {
  const { axes, whole: before, isComputed } = zoom.data
  if (axes === undefined) return whole
  if (!isComputed && String(before) !== String(whole)) {
    zoom.put({})
    return whole
  }
  zoom.data.whole = whole
  return axes
}

/**
 * Let a visitor zoom in a picture.
 * @param {HTMLElement} host holds the picture
 * @param {Source} zoom
 * @param {{name: string, isComputed: boolean, frame: () => Frame, axes: () => Axes, invert: (x: number, y: number) => number[],
 *   show: (axes: Axes) => void}} picture its name, and whether its window is part of the state; frame() in pixels of the host,
 *   the axes on show, invert(x, y) returns the values at a pixel, show(axes) sets the axes
 */
export function connectZoom(host, zoom, { name, isComputed, frame, axes, invert, show }) {
  // Points of fingers, or of the mouse with its second button.
  /** @type {Map<number, number[]>} */
  const held = new Map()
  let isAlone = true
  /** @type {ReturnType<typeof setTimeout> | null} */
  let resting = null
  /** @type {ReturnType<typeof setTimeout>} */
  let clicked = null

  /** @param {{clientX: number, clientY: number}} event */
  const pointOf = ({ clientX, clientY }) => {
    const { left, top } = host.getBoundingClientRect()
    return [clientX - left, clientY - top]
  }

  /** @param {number[]} corners */
  const compute = (corners) => tell("pick", { pick: [name, ...corners], drag: true })

  function end() {
    const { whole } = zoom.data
    if (whole === undefined) return
    zoom.put({})
    show(whole)
  }

  function restore() {
    clearTimeout(resting)
    resting = null
    end()
    if (isComputed) compute(EVERYTHING)
  }

  /** @param {Frame} part */
  function zoomTo({ x0, x1, y0, y1 }) {
    const [[left, high], [right, low]] = [invert(x0, y0), invert(x1, y1)]
    const { whole = axes() } = zoom.data
    if (!isFine(left, right) || !isFine(low, high)) return
    /** @type {Axes} */
    const next = [left, right, low, high]
    if (!isComputed && contain(next, whole)) return end()
    show(next)
    zoom.put({ axes: next, whole, isComputed })
    if (!isComputed) return
    clearTimeout(resting)
    resting = setTimeout(() => {
      resting = null
      compute([left, low, right, high])
    }, REST)
  }

  host.addEventListener("wheel", (event) => {
    // There the wheel scrolls the page around it, unless it is a pinch.
    if (isEmbedded && !event.ctrlKey) return
    event.preventDefault()
    const point = [pointOf(event)]
    const pixels = event.deltaY * (event.deltaMode === WheelEvent.DOM_DELTA_LINE ? LINE : 1)
    zoomTo(partOf(frame(), point, point, Math.exp(pixels * (event.ctrlKey ? PINCH : WHEEL))))
  }, { passive: false })
  host.addEventListener("contextmenu", (event) => event.preventDefault())
  host.addEventListener("dblclick", () => {
    clearTimeout(clicked)
    restore()
  })

  // Captured: "touch.js" withholds the second finger from Bokeh.
  host.addEventListener("pointerdown", (event) => {
    const isTouch = event.pointerType === "touch"
    if (isTouch || event.button === 2) held.set(event.pointerId, pointOf(event))
    isAlone = held.size < 2
    if (!isTouch && event.button === 2) host.setPointerCapture(event.pointerId)
  }, { capture: true })
  host.addEventListener("pointermove", (event) => {
    if (!held.has(event.pointerId)) return
    const before = [...held.values()]
    held.set(event.pointerId, pointOf(event))
    if (event.pointerType !== "touch" || held.size === 2) zoomTo(partOf(frame(), before, [...held.values()]))
  }, { capture: true })
  for (const type of /** @type {const} */ (["pointerup", "pointercancel"])) {
    host.addEventListener(type, ({ pointerId }) => { held.delete(pointerId) }, { capture: true })
  }
  // Two fingers neither scroll nor zoom the page.
  host.addEventListener("touchstart", (event) => { if (event.touches.length > 1) event.preventDefault() }, { capture: true, passive: false })

  // The state on show answers the last window.
  listen({ painted() { if (isComputed && resting === null) end() } })
  host.after(button("whole", restore, { title: "Show the whole picture (double click)" }, "Whole"))
  zoom.watch(() => host.parentElement.classList.toggle("zoomed", zoom.data.axes !== undefined))

  return {
    /** Whether the current gesture, or the last one, has one finger. */
    isAlone: () => isAlone,
    /** Act on a click unless a second one follows. @param {() => void} act */
    onceSingle(act) {
      clearTimeout(clicked)
      clicked = setTimeout(act, DOUBLE)
    },
    /** Multiply the extent of the axes; a point stays where it is. @param {number} factor @param {number[]} point */
    by: (factor, point) => zoomTo(partOf(frame(), [point], [point], factor)),
    restore,
  }
}
