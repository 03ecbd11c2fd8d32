// @ts-check
// A guess in a picture: the audience clicks where it expects something, then the truth and the distance to it are drawn.

import { arrowOf } from "../base/keys.js"
import { element } from "../base/elements.js"
import { within, written } from "../base/numbers.js"
import { fit } from "./canvas.js"
import { covering, toPixels, toValues } from "./frame.js"
import { gallery } from "./gallery.js"
import { circlePath, linePath } from "./looks.js"

const RING = 9
const MOST = 40
export const GUESS = "#D55E00"
export const TRUTH = "#009E73"
const STEP = 8
const FOCUS = "inset 0 0 0 2px #0072B2"

/** @param {number[]} values */
const mean = (values) => values.reduce((sum, one) => sum + one, 0) / values.length

/** @param {PlotView} plot @returns {[{type: string}, BokehModel][]} */
const axesOf = ({ model: { x_scale: xScale, y_scale: yScale, below: [x], left: [y] } }) => [[xScale, x], [yScale, y]]

/**
 * Return the mean distance of pairs of points along each axis; on a logarithmic axis, of their logarithms.
 * @param {PlotView} plot
 * @param {[number[], number[]][]} pairs
 */
export const meanApart = (plot, pairs) => axesOf(plot).map(([{ type }], i) => (
  mean(pairs.map(([a, b]) => Math.abs(type === "LogScale" ? Math.log(a[i] / b[i]) : a[i] - b[i])))))

/** Return such distances in words. @param {PlotView} plot @param {number[]} distances */
export const inWords = (plot, distances) => axesOf(plot).map(([{ type }, { axis_label: name }], i) => (
  `${type === "LogScale" ? `a factor of ${written(Math.exp(distances[i]), 2)}` : written(distances[i], 2)} in ${name}`)).join(" and ")

/**
 * Lay a canvas over a plot, with which it is drawn again.
 * @param {PlotView} plot
 * @param {string} name its class
 * @param {object} properties see `element`
 * @param {string} style the style sheets of the page do not reach into the plot
 * @param {(ctx: CanvasRenderingContext2D) => void} paint
 */
export function overlay(plot, name, properties, style, paint) {
  const sheet = element(`canvas.${name}`, properties)
  const draw = () => paint(fit(sheet, plot.bbox.width, plot.bbox.height))
  sheet.style.cssText = covering(style)
  plot.canvas_view.overlays.el.parentNode.append(sheet)
  plot.repainted.connect(draw)
  return {
    sheet, draw,
    toPixels: (/** @type {number[]} */ point) => toPixels(plot, point),
    toData: (/** @type {number[]} */ point) => toValues(plot, point),
    remove() {
      plot.repainted.disconnect(draw)
      sheet.remove()
    },
  }
}

/**
 * Return the point of a polyline that is nearest to another point.
 * @param {number[][]} line
 * @param {number[]} point
 */
function nearestOn(line, [x, y]) {
  /** @type {{distance: number, at: number[] | null}} */
  let best = { distance: Infinity, at: null }
  line.forEach(([x1, y1], i) => {
    const [x0, y0] = line[Math.max(0, i - 1)]
    const squared = (x1 - x0) ** 2 + (y1 - y0) ** 2
    const share = squared > 0 ? within(((x - x0) * (x1 - x0) + (y - y0) * (y1 - y0)) / squared, 0, 1) : 0
    const point = [x0 + share * (x1 - x0), y0 + share * (y1 - y0)]
    const distance = Math.hypot(point[0] - x, point[1] - y)
    if (distance < best.distance) best = { distance, at: point }
  })
  return best
}

/** Return the point of several polylines that is nearest to another point. @param {number[][][]} lines @param {number[]} point */
export const nearest = (lines, point) => lines.map((line) => nearestOn(line, point))
  .reduce((best, one) => (one.distance < best.distance ? one : best), { distance: Infinity, at: null })

/** @param {ArrayLike<number>} xs @param {ArrayLike<number>} ys */
const zip = (xs, ys) => Array.from(xs, (x, i) => [x, ys[i]]).filter((point) => point.every(Number.isFinite))

/**
 * Return the data of the source as polylines; a point is a polyline of length one.
 * @param {Pick<Prediction, "source" | "columns" | "what">} layer
 * @returns {number[][][]}
 */
export function linesOf({ source, columns: [x, y], what }) {
  const { [x]: xs = [], [y]: ys = [] } = gallery.source(source).data
  if (what === "point") return zip(xs, ys).map((point) => [point])
  return typeof xs[0] === "number" ? [zip(xs, ys)] : Array.from(xs, (/** @type {number[]} */ part, i) => zip(part, ys[i]))
}

/** @param {CanvasRenderingContext2D} ctx @param {number[]} point @param {string} colour @param {number[]} dash */
export function drawRing(ctx, [x, y], colour, dash) {
  for (const [weight, style] of /** @type {[number, string][]} */ ([[6, "white"], [3, colour]])) {
    circlePath(ctx, x, y, RING)
    ctx.setLineDash(dash)
    ctx.lineWidth = weight
    ctx.strokeStyle = style
    ctx.stroke()
  }
}

/**
 * Return the controller of a guess; begin(), wait(), reveal() and end() are called in this order.  The lesson hides the layer.
 * @param {Prediction} prediction
 * @param {(text: string) => void} say shows what to do, and how near the guess was
 * @param {((points: number[][]) => void) | null} guessed gets the guess of a follower, whom the lecturer tells the truth
 */
export function createGuess(prediction, say, guessed = null) {
  const isCurve = prediction.what === "curve"
  /** @type {PlotView | null} */
  let plot = null
  /** @type {ReturnType<typeof overlay> | null} */
  let over = null
  // Coordinates are those of the data.
  /** @type {number[][]} */
  let clicks = []
  /** @type {number[][] | null} */
  let truth = null
  let isOver = false
  /** The data of the truth when the guess was measured. @type {object | null} */
  let measured = null

  /** Say how near the guess was.  In some pictures the truth comes in pieces, later than the state: a repainting calls this again. */
  function measure() {
    const { data } = gallery.source(prediction.source)
    if (data === measured) return
    measured = data
    const { toPixels, toData } = over
    const lines = linesOf(prediction).map((line) => line.map(toPixels))
    const found = clicks.map((click) => nearest(lines, toPixels(click)))
    if (found.length === 0) return say("Revealed. There was no guess.")
    if (found.some(({ at }) => at === null)) return say("Revealed: there is none here.")
    truth = found.map(({ at }) => toData(at))
    const distances = meanApart(plot, clicks.map((click, i) => [click, truth[i]]))
    say(`${isCurve ? "On average" : "You were"} ${inWords(plot, distances)} away.`)
  }

  /** @param {CanvasRenderingContext2D} ctx */
  function paint(ctx) {
    if (isOver) measure()
    const { toPixels } = over
    for (const [i, click] of clicks.map(toPixels).entries()) {
      if (truth !== null) {
        const point = toPixels(truth[i])
        linePath(ctx, [click, point])
        ctx.setLineDash([4, 4])
        ctx.lineWidth = 2
        ctx.strokeStyle = GUESS
        ctx.stroke()
        drawRing(ctx, point, TRUTH, [])
      }
      drawRing(ctx, click, GUESS, [4, 4])
    }
  }

  /** Add a guess at a point of the picture, or at the nearest one in the frame. @param {number} x @param {number} y */
  function add(x, y) {
    const { x0, x1, y0, y1 } = plot.frame.bbox
    const point = over.toData([within(x, x0, x1), within(y, y0, y1)])
    clicks = isCurve ? [...clicks, point].slice(-MOST) : [point]
    over.draw()
    guessed?.(clicks)
    say(isCurve ? `Your curve: ${clicks.length} point${clicks.length === 1 ? "" : "s"}.` : "Your guess is set.")
  }

  /** @param {KeyboardEvent} event */
  function onkeydown(event) {
    const arrow = arrowOf(event)
    if (arrow === undefined) return
    const { x0, x1, y0, y1 } = plot.frame.bbox
    const [x, y] = clicks.length > 0 ? over.toPixels(clicks.at(-1)) : [(x0 + x1) / 2, (y0 + y1) / 2]
    add(x + STEP * arrow[0], y - STEP * arrow[1])
    event.preventDefault()
    event.stopPropagation()
  }

  return {
    isRevealed: false,
    /** Ask for a guess; the state of the step is on show. */
    begin() {
      plot = gallery.plot(prediction.picture)
      over = overlay(plot, "guess", {
        tabIndex: 0, role: "application", ariaLabel: "Your guess: click or use the arrow keys",
        title: isCurve ? "Click along the expected curve" : "Click where you expect it", onkeydown,
        onclick: (/** @type {MouseEvent} */ { offsetX, offsetY }) => { if (!this.isRevealed) add(offsetX, offsetY) },
        onfocus: () => { sheet.style.boxShadow = sheet.matches(":focus-visible") ? FOCUS : "" },
        onblur: () => { sheet.style.boxShadow = "" },
      }, "cursor: crosshair; touch-action: pan-x pan-y; outline: none", paint)
      const { sheet } = over
      // The picture itself ignores these clicks and drags.
      for (const name of ["pointerdown", "pointermove", "pointerup", "touchstart"]) {
        sheet.addEventListener(name, (event) => event.stopPropagation())
      }
      over.draw()
      say(guessed === null ? `${sheet.title}, then reveal.` : `${sheet.title}.`)
    },
    /** Take no more clicks: the revealed state was requested. */
    wait() { this.isRevealed = true },
    /** Draw the truth; the revealed state is on show. */
    reveal() {
      // The state of this step never arrived, because the next step was requested at once.
      if (over === null) return say("Revealed. There was no guess.")
      over.sheet.blur()
      over.sheet.tabIndex = -1
      over.sheet.style.pointerEvents = "none"
      isOver = true
      over.draw()
    },
    /** Remove the guess from the picture. */
    end() { over?.remove() },
  }
}
