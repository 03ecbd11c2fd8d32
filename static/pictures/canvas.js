// Canvases that the page paints itself: sharp on every screen, and painted again when their data, their size or the theme
// of the page change.  Some lie over the frame of a Bokeh plot, for what would take Bokeh too long to draw.

import { listen } from "../page/bus.js"
import { element } from "../page/elements.js"
import { zoom } from "../page/presenting.js"
import { INK, isDark, onDark, setDark, watchTheme } from "./looks.js"

const pixelRatio = () => devicePixelRatio || 1

/** Give a canvas the pixels of the screen for a size in CSS pixels.  Return its context, empty, whose unit is a CSS pixel. */
export function fit(canvas, width, height) {
  const ctx = canvas.getContext("2d")
  const ratio = pixelRatio()
  const [columns, rows] = [width, height].map((side) => Math.round(ratio * side))
  if (canvas.width !== columns || canvas.height !== rows) Object.assign(canvas, { width: columns, height: rows })
  ctx.reset()
  ctx.scale(ratio, ratio)
  return ctx
}

/**
 * Return a canvas that paints itself.
 * @param {string} className
 * @param {object} properties see `element`
 * @param {(ctx: CanvasRenderingContext2D, look: {width: number, height: number, text: string, dark: boolean}) => void} paint
 *   gets the size in CSS pixels, the colour of text, and whether the page is dark
 */
export function liveCanvas(className, properties, paint) {
  const canvas = element(`canvas.${className}`, properties)
  // To ask for the size in each frame would lay out the page.
  const own = { canvas, width: 0, height: 0, request }
  let requested = false

  function draw() {
    if (!requested) return
    requested = false
    const { width, height } = own
    if (width === 0 || height === 0) return
    const text = getComputedStyle(canvas).color
    const dark = isDark(text)
    setDark(dark)
    paint(fit(canvas, width, height), { width, height, text, dark })
  }

  function request() {
    if (requested) return
    requested = true
    requestAnimationFrame(draw)
  }

  // With all the others of a state, rather than in the next frame.
  listen({
    paint: draw,
    presenting: request,
  })
  watchTheme(request)
  new ResizeObserver(() => {
    Object.assign(own, { width: canvas.clientWidth, height: canvas.clientHeight })
    request()
  }).observe(canvas)
  return own
}

/**
 * Add a square canvas to an element, as wide as that.
 *
 * paint(ctx, {edge, ratio, text, dark}): the unit of lengths is a CSS pixel, larger in present mode; `edge` is the side in
 * units, `ratio` the number of device pixels in a unit.  shoot(side) returns the picture for print, `side` pixels wide.
 */
export function squareCanvas(el, className, properties, paint) {
  const own = liveCanvas(className, properties, (ctx, { width, text, dark }) => {
    ctx.scale(zoom(), zoom())
    paint(ctx, { edge: width / zoom(), ratio: pixelRatio() * zoom(), text, dark })
  })
  el.append(own.canvas)
  const shoot = (side) => {
    const sheet = element("canvas", { width: side, height: side })
    const ctx = sheet.getContext("2d")
    const ratio = zoom() * side / own.width
    ctx.scale(ratio, ratio)
    paint(ctx, { edge: side / ratio, ratio, text: INK, dark: false })
    return sheet
  }
  return Object.assign(own, { shoot })
}

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
    const here = [x.start, x.end, y.start, y.end, x0, y0, x1, y1, width, height, devicePixelRatio, onDark(), zoom()].join()
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
