// @ts-check
// The guesses of an audience in a picture: the cloud, its median, the truth, and how far the audience was off.

import { element } from "../base/elements.js"
import { fit } from "./canvas.js"
import { gallery } from "./gallery.js"
import { along, apart, drawRing, GUESS, linesOf, nearest, TRUTH } from "./guess.js"
import { circlePath } from "./looks.js"
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
  /** @type {(place: number[]) => [number, number]} */
  const toPixels = ([x, y]) => [plot.frame.x_scale.compute(x), plot.frame.y_scale.compute(y)]
  /** @type {(place: number[]) => [number, number]} */
  const toData = ([x, y]) => [plot.frame.x_scale.invert(x), plot.frame.y_scale.invert(y)]
  const points = cloud.flat()
  const middle = points.length === 0 ? [] : isCurve ? medianCurve(points) : [middleOf(points)]
  // The truth in pixels; it may come in pieces, later than the state, and a repainting moves it.
  /** @type {[number, number][][]} */
  let lines = []
  /** @param {number[]} point */
  const truthOf = (point) => nearest(lines, toPixels(point))
  const sheet = element("canvas.audience", { ariaHidden: true })

  function draw() {
    lines = linesOf(prediction).map((line) => line.map(toPixels))
    say(sentence())
    const ctx = fit(sheet, plot.bbox.width, plot.bbox.height)
    ctx.fillStyle = GUESS + FAINT
    for (const point of points) {
      circlePath(ctx, ...toPixels(point), DOT)
      ctx.fill()
    }
    if (isCurve) {
      ctx.beginPath()
      for (const point of middle) ctx.lineTo(...toPixels(point))
      ctx.lineWidth = 3
      ctx.strokeStyle = GUESS
      ctx.stroke()
      return
    }
    for (const point of middle) {
      const { place } = truthOf(point)
      if (place !== null) drawRing(ctx, place, TRUTH, [])
      drawRing(ctx, toPixels(point), GUESS, [])
    }
  }

  function sentence() {
    if (cloud.length === 0) return "Revealed. Nobody in the audience guessed."
    const { x_scale: xScale, y_scale: yScale, below: [below], left: [left] } = plot.model
    const many = `${cloud.length} guess${cloud.length === 1 ? "" : "es"} from the audience`
    // How far each guess was off, on the average of its points.
    const off = cloud.map((guess) => guess.reduce((sum, point) => {
      const { place } = truthOf(point)
      if (place === null) return sum
      const truth = toData(place)
      return [xScale, yScale].map((scale, i) => sum[i] + apart(scale, point[i], truth[i]) / guess.length)
    }, [0, 0]))
    if (lines.every((line) => line.length === 0)) return `${many}; there is none here.`
    const [x, y] = [0, 1].map((i) => median(off.map((one) => one[i])))
    return `${many}. Median distance: ${along(xScale, below, x)} and ${along(yScale, left, y)}.`
  }

  sheet.style.cssText = "position: absolute; inset: 0; width: 100%; height: 100%; pointer-events: none"
  plot.canvas_view.overlays.el.parentNode.append(sheet)
  plot.repainted.connect(draw)
  draw()
  return {
    /** Remove the guesses from the picture. */
    end() {
      plot.repainted.disconnect(draw)
      sheet.remove()
    },
  }
}
