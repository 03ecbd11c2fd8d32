// A canvas of our own over the frame of a Bokeh plot, for what would take Bokeh too long to draw.

import { element } from "../page/elements.js"
import { zoom } from "../page/presenting.js"
import { fit } from "./canvas.js"
import { onDark } from "./looks.js"

/**
 * Put a canvas over a plot, which is drawn again when the axes or the size of the plot change.
 * @param {any} plot Bokeh's view of it
 * @param {Element} before the element of the plot's canvas under which it lies
 * @param {(ctx: CanvasRenderingContext2D, x: any, y: any) => void} paint gets a context that is clipped to the frame, in
 *   Bokeh's pixels, half a pixel aside as Bokeh's own, and the plot's scales
 */
export function frameCanvas(plot, before, paint) {
  const canvas = element("canvas")
  canvas.style.cssText = "position: absolute; inset: 0; width: 100%; height: 100%; pointer-events: none"
  before.before(canvas)
  let stale = true
  let drawn = ""

  // Does nothing where neither data nor axes nor the theme have changed.
  function draw() {
    const { frame: { bbox: { x0, y0, x1, y1 }, x_scale: xScale, y_scale: yScale }, bbox: { width, height } } = plot
    // Out of sight it has no size.
    if (!(x1 > x0 && y1 > y0)) return
    const { x_range: x, y_range: y } = plot.model
    const here = [x.start, x.end, y.start, y.end, x0, y0, x1, y1, width, height, window.devicePixelRatio, onDark(), zoom()].join()
    if (!stale && here === drawn) return
    stale = false
    drawn = here
    const ctx = fit(canvas, width, height)
    ctx.translate(0.5, 0.5)
    ctx.beginPath()
    ctx.rect(x0, y0, x1 - x0, y1 - y0)
    ctx.clip()
    paint(ctx, xScale, yScale)
  }

  plot.repainted.connect(draw)
  return { element: canvas, draw, request: () => { stale = true } }
}
