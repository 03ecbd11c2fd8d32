// A canvas of our own over the frame of a Bokeh plot, for what would take Bokeh too long to draw.

import { zoom } from "../page/presenting.js"
import { onDark } from "./looks.js"

// `before`: the element of the plot's canvas under which it lies.  paint(ctx, x, y): the context is clipped to the
// frame and in Bokeh's pixels, half a pixel aside as Bokeh's own; x and y are the plot's scales.
export function frameCanvas(plot, before, paint) {
  const canvas = document.createElement("canvas")
  canvas.style.cssText = "position: absolute; inset: 0; width: 100%; height: 100%; pointer-events: none"
  before.before(canvas)
  const ctx = canvas.getContext("2d")
  let stale = true
  let drawn = ""

  const place = () => {
    const { x_range: x, y_range: y } = plot.model
    const { x0, y0, x1, y1 } = plot.frame.bbox
    const { width, height } = plot.bbox
    return [
      x.start, x.end, y.start, y.end, x0, y0, x1, y1, width, height, window.devicePixelRatio, onDark(), zoom(),
    ].join()
  }

  // Does nothing where neither data nor axes nor the theme have changed.
  function draw() {
    const { frame: { bbox } } = plot
    // Out of sight it has no size.
    if (!(bbox.x1 > bbox.x0 && bbox.y1 > bbox.y0)) return
    const here = place()
    if (!stale && here === drawn) return
    stale = false
    drawn = here
    const ratio = window.devicePixelRatio || 1
    const { width, height } = plot.bbox
    canvas.width = Math.round(ratio * width)
    canvas.height = Math.round(ratio * height)
    const { x0, y0, x1, y1 } = plot.frame.bbox
    ctx.scale(ratio, ratio)
    ctx.translate(0.5, 0.5)
    ctx.beginPath()
    ctx.rect(x0, y0, x1 - x0, y1 - y0)
    ctx.clip()
    paint(ctx, plot.frame.x_scale, plot.frame.y_scale)
  }

  plot.repainted.connect(draw)
  return { element: canvas, draw, request: () => { stale = true } }
}
