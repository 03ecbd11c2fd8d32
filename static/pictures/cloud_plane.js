// @ts-check
// Clouds of phase points on the (ω1, ω2)-plane, with the line of equilibria.
//
// Besides the clouds ("cloud.js") its source holds `half`, half the range of the axes; `curves` [[look, xs, ys]]; `points`
// [[look, x, y]]; and `bins` = [first, width, count] of ln|s|.  The density over |s| at the current time goes to the source of
// the option `density`.

import { listen, tell } from "../base/bus.js"
import { written } from "../base/numbers.js"
import { zoom } from "../base/modes.js"
import { squareCanvas } from "./canvas.js"
import { cloudsOf, pointLayer } from "./cloud.js"
import { clipTo } from "./frame.js"
import { drawMark, linePath, LOOKS, useLook } from "./looks.js"
import { moment } from "./moment.js"
import { connectZoom, zoomed } from "./zoom.js"

const MARGIN = { left: 46, right: 8, top: 8, bottom: 42 }
// Largest number of intervals between ticks, and digits of a label.
const [MOST, DIGITS] = [5, 6]
// Length of a tick, and distance of its label.
const [TICK, GAP] = [5, 7]

/**
 * Return round numbers in a range.
 * @param {number} low
 * @param {number} high
 */
function ticksIn(low, high) {
  const unit = 10 ** Math.floor(Math.log10((high - low) / MOST))
  const step = unit * [1, 2, 5, 10].find((many) => MOST * many * unit >= 0.999 * (high - low))
  const first = Math.ceil(low / step - 1e-6)
  return Array.from({ length: Math.floor(high / step + 1e-6) - first + 1 }, (_, i) => (first + i) * step)
}

/**
 * Return the frame and scales of the plane in a picture.
 * @param {number} edge
 * @param {Axes} axes
 */
function placing(edge, [x0, x1, y0, y1]) {
  const frame = { x0: MARGIN.left, x1: edge - MARGIN.right, y0: MARGIN.top, y1: edge - MARGIN.bottom }
  const [w, h] = [frame.x1 - frame.x0, frame.y1 - frame.y0]
  return {
    frame, w, h, across: ticksIn(x0, x1), up: ticksIn(y0, y1),
    x: (/** @type {number} */ a) => frame.x0 + (w * (a - x0)) / (x1 - x0),
    y: (/** @type {number} */ b) => frame.y0 + (h * (y1 - b)) / (y1 - y0),
    /** Return the values at a point of the picture. @param {number} left @param {number} top */
    invert: (left, top) => [x0 + ((left - frame.x0) / w) * (x1 - x0), y1 - ((top - frame.y0) / h) * (y1 - y0)],
  }
}

/** @param {CanvasRenderingContext2D} ctx @param {ReturnType<typeof placing>} plane @param {string} text */
function drawAxes(ctx, { frame, w, h, x, y, across, up }, text) {
  const { x0: left, y0: top, y1: bottom } = frame
  useLook(ctx, { weight: 1 }, text)
  ctx.fillStyle = text
  ctx.globalAlpha = 0.4
  ctx.strokeRect(left, top, w, h)
  ctx.font = "12px system-ui, sans-serif"
  for (const value of across) ctx.strokeRect(x(value), bottom, 0, TICK)
  for (const value of up) ctx.strokeRect(left - TICK, y(value), TICK, 0)
  ctx.globalAlpha = 0.75
  ctx.textAlign = "center"
  ctx.textBaseline = "top"
  for (const value of across) ctx.fillText(written(value, DIGITS), x(value), bottom + GAP)
  ctx.textAlign = "right"
  ctx.textBaseline = "middle"
  for (const value of up) ctx.fillText(written(value, DIGITS), left - GAP, y(value))
  ctx.globalAlpha = 1
  ctx.font = "14px system-ui, sans-serif"
  ctx.textAlign = "center"
  ctx.textBaseline = "alphabetic"
  ctx.fillText("ω₁", left + w / 2, bottom + 37)
  ctx.save()
  ctx.translate(12, bottom - h / 2)
  ctx.rotate(-Math.PI / 2)
  ctx.fillText("ω₂", 0, 0)
  ctx.restore()
}

/**
 * Return the density of points over |s|, in bins of equal width in ln|s|.
 * @param {ReturnType<ReturnType<typeof cloudsOf>["at"]>[number] | undefined} cloud
 * @param {[number, number, number]} bins
 */
function densityOf(cloud, bins) {
  /** @type {[number[], number[]]} */
  const [x, y] = [[], []]
  if (cloud === undefined) return { x, y }
  const [first, wide, count] = bins
  const counts = new Float64Array(count)
  for (let i = 0; i < cloud.count; i++) counts[Math.floor((cloud.y[i] - first) / wide)] += 1
  counts.forEach((found, k) => {
    if (found === 0) return
    const s = Math.exp(first + (k + 0.5) * wide)
    x.push(s)
    y.push(found / (cloud.count * wide * s))
  })
  return { x, y }
}

/**
 * Draw the plane in an element.
 * @param {HTMLElement} el
 * @param {PictureDescription} options
 * @param {FindSource} source
 * @param {() => boolean} isShown whether the scene is on show
 */
export function cloudPlane(el, options, source, isShown) {
  const own = source(options.name)
  const clouds = cloudsOf(own)
  const layer = pointLayer(own)
  // Kept while there are no clouds.
  /** @type {Axes} */
  let whole = [-1, 1, -1, 1]
  const { canvas, request, shoot } = squareCanvas(el, "sphere.cloud", {
    role: "img", ariaLabel: "Cloud of phase points on the plane of ω₁ and ω₂",
    onclick(/** @type {MouseEvent} */ { offsetX, offsetY }) {
      if (isAlone()) onceSingle(() => tell("pick", { pick: [options.name, ...invert(offsetX, offsetY)], drag: false }))
    },
  }, paint)
  const zoomSource = source(`${options.name}-zoom`)
  const { isAlone, onceSingle } = connectZoom(el, zoomSource, {
    name: options.name, isComputed: false, invert, show: request,
    axes: () => whole,
    frame() {
      const { larger, frame: { x0, x1, y0, y1 } } = here()
      return { x0: larger * x0, x1: larger * x1, y0: larger * y0, y1: larger * y1 }
    },
  })
  /** @param {number} edge */
  const place = (edge) => {
    const { half } = own.data
    if (half !== undefined) whole = [-half, half, -half, half]
    return placing(edge, zoomed(zoomSource, whole))
  }
  /** Return the frame on the page, whose lengths are larger by a factor. */
  function here() {
    const larger = zoom(canvas.clientWidth)
    return { larger, ...place(canvas.clientWidth / larger) }
  }
  /** @param {number} left @param {number} top */
  function invert(left, top) {
    const { larger, invert: values } = here()
    return values(left / larger, top / larger)
  }

  /** @type {PaintSquare} */
  function paint(ctx, { edge, ratio, text }) {
    const here = place(edge)
    const { frame, x, y } = here
    const { curves = [], points = [] } = own.data
    drawAxes(ctx, here, text)
    clipTo(ctx, frame)
    for (const [look, xs, ys] of curves) {
      useLook(ctx, LOOKS[look], text)
      linePath(ctx, Array.from(xs, (/** @type {number} */ a, i) => [x(a), y(ys[i])]))
      ctx.stroke()
    }
    for (const [look, a, b] of points) drawMark(ctx, x(a), y(b), look, text)
    // Over the equilibria, where a whole cloud may end.
    layer.draw({ ctx, edge, ratio }, ({ count, w1, w2 }, add) => {
      for (let i = 0; i < count; i++) add(ratio * x(w1[i]), ratio * y(w2[i]))
    })
  }

  const refresh = () => {
    request()
    source(options.density).put(densityOf(clouds.at(moment.t)[0], own.data.bins))
  }
  listen({
    time() { if (isShown()) refresh() },
  })
  own.watch(refresh)
  return { shoot }
}
