// @ts-check
// Clouds of phase points on the (ω1, ω2)-plane, with the line of equilibria.
//
// Besides the clouds ("cloud.js") its source holds `half`, half the range of the axes; `curves` [[look, xs, ys]]; `points`
// [[look, x, y]]; and `bins` = [first, width, count] of ln|s|.  The density over |s| at the current time goes to the source of
// the option `density`.

import { listen, tell } from "../base/bus.js"
import { written } from "../base/numbers.js"
import { zoom } from "../base/presenting.js"
import { squareCanvas } from "./canvas.js"
import { cloudsOf } from "./cloud.js"
import { drawMark, LOOKS, useLook } from "./looks.js"
import { pointLayer } from "./point_layer.js"

const MARGIN = { left: 46, right: 8, top: 8, bottom: 42 }
const SHARES = [-1, -0.5, 0, 0.5, 1]
// Length of a tick, and distance of its label.
const [TICK, GAP] = [5, 7]

/**
 * Return the frame and scales of the plane in a picture, for axes from −half to half.
 * @param {number} edge
 * @param {number} half
 */
function placing(edge, half) {
  const frame = { left: MARGIN.left, right: edge - MARGIN.right, top: MARGIN.top, bottom: edge - MARGIN.bottom }
  const [w, h] = [frame.right - frame.left, frame.bottom - frame.top]
  return {
    frame, w, h, half,
    x: (/** @type {number} */ a) => frame.left + (w * (a + half)) / (2 * half),
    y: (/** @type {number} */ b) => frame.top + (h * (half - b)) / (2 * half),
    /** Return the values at a place of the picture. @param {number} left @param {number} top */
    invert: (left, top) => [((left - frame.left) / w) * 2 * half - half, half - ((top - frame.top) / h) * 2 * half],
  }
}

/** @param {CanvasRenderingContext2D} ctx @param {ReturnType<typeof placing>} plane @param {string} text */
function drawAxes(ctx, { frame, w, h, half, x, y }, text) {
  const { left, bottom } = frame
  useLook(ctx, { weight: 1 }, text)
  ctx.fillStyle = text
  ctx.globalAlpha = 0.4
  ctx.strokeRect(left, frame.top, w, h)
  ctx.font = "12px system-ui, sans-serif"
  for (const share of SHARES) {
    const [across, down, label] = [x(share * half), y(share * half), written(share * half, 3)]
    ctx.globalAlpha = 0.4
    ctx.strokeRect(across, bottom, 0, TICK)
    ctx.strokeRect(left - TICK, down, TICK, 0)
    ctx.globalAlpha = 0.75
    // The last labels end at the corner of the frame.
    ctx.textAlign = share === 1 ? "right" : "center"
    ctx.textBaseline = "top"
    ctx.fillText(label, across, bottom + GAP)
    ctx.textAlign = "right"
    ctx.textBaseline = share === 1 ? "top" : "middle"
    ctx.fillText(label, left - GAP, down)
  }
  ctx.globalAlpha = 1
  ctx.font = "14px system-ui, sans-serif"
  ctx.textAlign = "center"
  ctx.textBaseline = "alphabetic"
  ctx.fillText("ω₁", x(0), frame.bottom + 37)
  ctx.save()
  ctx.translate(12, y(0))
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
  const layer = pointLayer()
  let t = 0
  // Half the range of the axes; kept while there are no clouds.
  let range = 1
  const { canvas, request, shoot } = squareCanvas(el, "sphere.cloud", {
    role: "img", ariaLabel: "Cloud of phase points on the plane of ω₁ and ω₂",
    /** @param {MouseEvent} event */
    onclick({ offsetX, offsetY }) {
      const larger = zoom(canvas.clientWidth)
      const picked = place(canvas.clientWidth / larger).invert(offsetX / larger, offsetY / larger)
      tell("pick", { pick: [options.name, ...picked], drag: false })
    },
  }, paint)
  /** @param {number} edge */
  const place = (edge) => {
    range = own.data.half ?? range
    return placing(edge, range)
  }

  /** @type {PaintSquare} */
  function paint(ctx, { edge, ratio, text }) {
    const here = place(edge)
    const { frame, w, h, x, y } = here
    const { curves = [], points = [] } = own.data
    drawAxes(ctx, here, text)
    ctx.beginPath()
    ctx.rect(frame.left, frame.top, w, h)
    ctx.clip()
    for (const [look, xs, ys] of curves) {
      useLook(ctx, LOOKS[look], text)
      ctx.beginPath()
      for (let i = 0; i < xs.length; i++) ctx.lineTo(x(xs[i]), y(ys[i]))
      ctx.stroke()
    }
    for (const [look, a, b] of points) drawMark(ctx, x(a), y(b), look, text)
    // Over the equilibria, where a whole cloud may end.
    layer.draw(ctx, Math.round(edge * ratio), ratio, clouds.at(t), ({ count, w1, w2 }, add) => {
      for (let i = 0; i < count; i++) add(ratio * x(w1[i]), ratio * y(w2[i]))
    })
  }

  const refresh = () => {
    request()
    source(options.density).put(densityOf(clouds.at(t)[0], own.data.bins))
  }
  listen({
    time(now) {
      if (!isShown()) return
      t = now.t
      refresh()
    },
  })
  own.watch(refresh)
  return { shoot }
}
