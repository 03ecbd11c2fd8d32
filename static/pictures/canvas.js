// @ts-check
// Canvases that repaint themselves when their data, their size or the theme changes.  Some lie over the frame of a Bokeh
// plot and draw what Bokeh would draw slowly.

import { listen } from "../base/bus.js"
import { element } from "../base/elements.js"
import { zoom } from "../base/modes.js"
import { clipTo, covering } from "./frame.js"
import { inks, onDark } from "./looks.js"
import { largerOf } from "./plot_looks.js"

/**
 * Resize a canvas to the pixels of the screen, and return its empty context in CSS pixels.
 * @param {HTMLCanvasElement} canvas
 * @param {number} width in CSS pixels
 * @param {number} height
 */
export function fit(canvas, width, height) {
  const ctx = canvas.getContext("2d")
  const [columns, rows] = [width, height].map((side) => Math.round(devicePixelRatio * side))
  if (canvas.width !== columns || canvas.height !== rows) Object.assign(canvas, { width: columns, height: rows })
  ctx.reset()
  ctx.scale(devicePixelRatio, devicePixelRatio)
  return ctx
}

/**
 * Return a text that was to be drawn, for a file in which text stays text.
 * @param {CanvasRenderingContext2D} ctx
 * @param {string} text
 * @param {number} left
 * @param {number} top
 * @param {number} ratio
 * @returns {LiftedText}
 */
function lifted(ctx, text, left, top, ratio) {
  const { font, fillStyle, globalAlpha: alpha, textAlign: align, textBaseline: baseline } = ctx
  const transform = ctx.getTransform()
  const { x, y } = transform.transformPoint({ x: left, y: top })
  return {
    text, x: x / ratio, y: y / ratio, turn: Math.atan2(-transform.b, transform.a), size: Number.parseFloat(font),
    colour: String(fillStyle), alpha, align, baseline,
  }
}

/**
 * Add a square canvas to an element, as wide as the element, that repaints itself.
 *
 * Lengths are in CSS pixels, larger in present mode.  request() requests a repaint, and shoot(look) draws the picture on a canvas
 * of its own.
 * @param {HTMLElement} el
 * @param {string} className
 * @param {object} properties see `element`
 * @param {PaintSquare} paint
 */
export function squareCanvas(el, className, properties, paint) {
  const canvas = element(`canvas.${className}`, properties)
  el.append(canvas)
  // Kept here: reading it in each frame would force a layout.
  let width = 0
  let requested = false

  function draw() {
    if (!requested) return
    requested = false
    if (width === 0) return
    const ctx = fit(canvas, width, width)
    const larger = zoom(width)
    ctx.scale(larger, larger)
    paint(ctx, { edge: width / larger, ratio: devicePixelRatio * larger, text: inks()[0], dark: onDark() })
  }

  function request() {
    if (requested) return
    requested = true
    requestAnimationFrame(draw)
  }

  // Paint together with the other pictures of a state.
  listen({ paint: draw, presenting: request, themed: request })
  new ResizeObserver(() => {
    width = canvas.clientWidth
    request()
  }).observe(canvas)
  /** @param {ShotLook} look */
  const shoot = (look) => {
    const { edge, ratio, texts } = look
    const side = Math.round(edge * ratio)
    const sheet = element("canvas", { width: side, height: side })
    const ctx = sheet.getContext("2d")
    ctx.scale(ratio, ratio)
    if (texts !== undefined) ctx.fillText = (text, left, top) => { texts.push(lifted(ctx, text, left, top, ratio)) }
    paint(ctx, look)
    return sheet
  }
  return { canvas, request, shoot }
}

/**
 * Put a canvas over the frame of a plot; it is redrawn when the axes or the size of the plot change.
 * @param {PlotView} plot
 * @param {Element} other an element of Bokeh
 * @param {"before" | "after"} side whether the canvas lies below it or above it
 * @param {PaintFrame} paint draws in Bokeh's pixels, clipped to the frame; like Bokeh, offset by half a pixel
 */
export function frameCanvas(plot, other, side, paint) {
  const canvas = element("canvas")
  canvas.style.cssText = covering("pointer-events: none")
  other[side](canvas)
  let stale = true
  let drawn = ""

  // Does nothing if data, axes, sizes and theme are unchanged.
  function draw() {
    const { frame: { bbox: { x0, y0, x1, y1 }, x_scale: xScale, y_scale: yScale }, bbox: { width, height } } = plot
    // A plot out of sight has no size, and one that takes a state is painted with it.
    if (!(x1 > x0 && y1 > y0) || plot.is_paused) return
    const { x_range: x, y_range: y } = plot.model
    const here = [x.start, x.end, y.start, y.end, x0, y0, x1, y1, width, height, devicePixelRatio, onDark(), largerOf(plot)].join()
    if (!stale && here === drawn) return
    stale = false
    drawn = here
    const ctx = fit(canvas, width, height)
    ctx.translate(0.5, 0.5)
    clipTo(ctx, { x0, y0, x1, y1 })
    paint(ctx, xScale, yScale, largerOf(plot))
  }

  plot.repainted.connect(draw)
  return { element: canvas, draw, request: () => { stale = true } }
}
