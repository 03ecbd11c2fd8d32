// @ts-check
// The guesses of an audience in a picture: the cloud, its median, the truth, and how far the audience was off.

import { gallery } from "./gallery.js"
import { drawRing, GUESS, inWords, linesOf, meanApart, nearest, overlay, TRUTH } from "./guess.js"
import { drawDisc, linePath } from "./looks.js"
import { median, medianCurve, middleOf } from "./median.js"

const DOT = 5
const FAINT = "80"

/**
 * Draw the guesses over their picture, whose revealed state is on show.
 * @param {Prediction} prediction
 * @param {number[][][]} cloud the points of each guess, in the coordinates of the picture
 * @param {(text: string) => void} say
 */
export function createAudience(prediction, cloud, say) {
  const plot = gallery.plot(prediction.picture)
  const isCurve = prediction.what === "curve"
  const { draw, remove, toPixels, toData } = overlay(plot, "audience", { ariaHidden: true }, "pointer-events: none", paint)
  const points = cloud.flat()
  const middle = points.length === 0 ? [] : isCurve ? medianCurve(points) : [middleOf(points)]
  // The truth in pixels; it may arrive in pieces, later than the state, and moves when the plot is repainted.
  /** @type {[number, number][][]} */
  let lines = []
  /** @param {number[]} point */
  const truthOf = (point) => nearest(lines, toPixels(point))

  /** @param {CanvasRenderingContext2D} ctx */
  function paint(ctx) {
    lines = linesOf(prediction).map((line) => line.map(toPixels))
    say(sentence())
    for (const point of points) drawDisc(ctx, ...toPixels(point), DOT, GUESS + FAINT)
    if (isCurve) {
      linePath(ctx, middle.map(toPixels))
      ctx.lineWidth = 3
      ctx.strokeStyle = GUESS
      ctx.stroke()
      return
    }
    for (const point of middle) {
      const { at } = truthOf(point)
      if (at !== null) drawRing(ctx, at, TRUTH, [])
      drawRing(ctx, toPixels(point), GUESS, [])
    }
  }

  function sentence() {
    if (cloud.length === 0) return "Revealed. Nobody in the audience guessed."
    const many = `${cloud.length} guess${cloud.length === 1 ? "" : "es"} from the audience`
    if (lines.every((line) => line.length === 0)) return `${many}; there is none here.`
    const off = cloud.map((guess) => meanApart(plot, guess.map((point) => [point, toData(truthOf(point).at)])))
    return `${many}. Median distance: ${inWords(plot, [0, 1].map((i) => median(off.map((one) => one[i]))))}.`
  }

  draw()
  /** Remove the guesses from the picture. */
  return { end: remove }
}
