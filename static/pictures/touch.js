// @ts-check
// Drags in a plot.  One finger drags the handle when it begins near it; elsewhere it scrolls the page.  In a picture that takes
// boxes, a drag that does not begin near the handle draws one.
//
// A browser that scrolls cancels the pointer.  Preventing the default of "touchstart" is the only way to stop it near a handle, as
// the style `touch-action` cannot depend on the point.  Two fingers zoom the picture, see "zoom.js".  Bokeh would take the events
// of a second finger for those of the first: they are withheld, and the drag ends where it is.

// A finger covers about 40 pixels, and a ring 20.
const [REACH, REACH_OF_MOUSE] = [30, 14]

/**
 * Return whether a pointer is near one of the points.
 * @param {number[]} pointer
 * @param {number[][]} points
 * @param {number} reach
 */
export const isNear = ([x, y], points, reach = REACH) => points.some(([a, b]) => Math.hypot(a - x, b - y) <= reach)

/**
 * Let fingers drag in a plot.  isDragging() tells whether the current pointer may drag, which a cancelled one may not, and
 * isOnHandle() whether it began near the handle.
 * @param {HTMLElement} host holds the plot
 * @param {PlotView} plot
 * @param {{points: () => number[][], boxes: boolean, isAlone: () => boolean}} handles points() returns the handles in pixels of
 *   the plot; `boxes` tells whether a drag draws a box, isAlone() whether one finger drags
 */
export function connectTouch(host, plot, { points, boxes, isAlone }) {
  let [dragging, isOnHandle] = [false, false]
  /** The first finger on the plot. @type {number | null} */
  let finger = null

  /** @param {PointerEvent} event */
  function grabs(event) {
    const { left, top } = host.getBoundingClientRect()
    const [x, y] = [event.clientX - left, event.clientY - top]
    const { x0, x1, y0, y1 } = plot.frame.bbox
    isOnHandle = isNear([x, y], points(), event.pointerType === "touch" ? REACH : REACH_OF_MOUSE)
    return event.pointerType !== "touch" || isOnHandle || (boxes && x0 <= x && x <= x1 && y0 <= y && y <= y1)
  }

  /** @param {PointerEvent} event */
  function onDown(event) {
    if (event.pointerType !== "touch") dragging = grabs(event)
    else if (finger === null) {
      finger = event.pointerId
      dragging = grabs(event)
    } else event.stopPropagation()
  }

  /** @param {PointerEvent} event */
  function onOther(event) {
    if (event.pointerType === "touch" && event.pointerId !== finger) return event.stopPropagation()
    if (event.type === "pointermove") return
    finger = null
    if (event.type === "pointercancel") dragging = false
  }

  host.addEventListener("pointerdown", onDown, { capture: true })
  for (const name of /** @type {const} */ (["pointermove", "pointerup", "pointercancel"])) {
    host.addEventListener(name, onOther, { capture: true })
  }
  if (boxes) host.style.touchAction = "none"
  else host.addEventListener("touchstart", (event) => { if (dragging) event.preventDefault() }, { passive: false })
  return { isDragging: () => dragging && isAlone(), isOnHandle: () => isOnHandle }
}
