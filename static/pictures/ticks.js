// @ts-check
// Tick labels of an axis.

const FAR_BELOW = 1e-3
const FAR_ABOVE = 1e5

/**
 * Return about `count` round numbers from low to high.
 * @param {number} low
 * @param {number} high
 * @param {number} count
 * @returns {number[]}
 */
export function roundNumbers(low, high, count) {
  const rough = (high - low) / count
  const power = 10 ** Math.floor(Math.log10(rough))
  const step = [1, 2, 5, 10].map((one) => one * power).find((one) => one >= rough)
  const found = []
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; i++) found.push(i * step)
  return found
}

/**
 * Return short labels of ticks; only every second or third has one where all labels together exceed `letters`.
 * @param {number[]} ticks
 * @param {number} letters
 * @returns {string[]}
 */
export function tickLabels(ticks, letters) {
  const most = Math.max(...ticks.map(Math.abs))
  const far = most < FAR_BELOW || most >= FAR_ABOVE
  /** @param {number} x */
  const short = (x) => {
    if (Math.abs(x) < 1e-9 * most) return "0"
    const rounded = Number(x.toPrecision(9))
    return (far ? rounded.toExponential().replace("e+", "e") : String(rounded)).replaceAll("-", "−")
  }
  const labels = ticks.map(short)
  const every = Math.ceil(labels.reduce((sum, label) => sum + label.length, 0) / letters)
  return labels.map((label, i) => (i % every === 0 ? label : ""))
}

/**
 * Return a Bokeh formatter of tick labels.
 * @param {() => number} letters returns how many letters the axis has room for
 */
export function tickFormatter(letters) {
  class ShortNumbers extends Bokeh.Models.BasicTickFormatter {
    /** @param {number[]} ticks */
    doFormat(ticks) { return tickLabels(ticks, letters()) }
  }
  return new ShortNumbers()
}

/**
 * @param {CanvasRenderingContext2D} ctx
 * @param {number} x0
 * @param {number} y0
 * @param {number} x1
 * @param {number} y1
 */
function segment(ctx, x0, y0, x1, y1) {
  ctx.beginPath()
  ctx.moveTo(x0, y0)
  ctx.lineTo(x1, y1)
  ctx.stroke()
}

/**
 * Draw the ticks below a frame and to the left of it.
 * @param {CanvasRenderingContext2D} ctx
 * @param {{left: number, right: number, top: number, bottom: number}} frame
 * @param {[number, string][]} below position and label of each tick
 * @param {[number, string][]} beside
 * @param {{length: number, gap: number, alpha?: number, isInside?: boolean}} look length of a tick, distance and opacity
 *   of the labels; isInside: the last labels end at the corner of the frame
 */
export function drawTicks(ctx, frame, below, beside, { length, gap, alpha = 1, isInside = false }) {
  for (const [x] of below) segment(ctx, x, frame.bottom, x, frame.bottom + length)
  for (const [y] of beside) segment(ctx, frame.left - length, y, frame.left, y)
  ctx.globalAlpha = alpha
  /** @param {[number, string][]} ticks @param {number} i */
  const isLast = (ticks, i) => isInside && i === ticks.length - 1
  below.forEach(([x, label], i) => {
    ctx.textBaseline = "top"
    ctx.textAlign = isLast(below, i) ? "right" : "center"
    ctx.fillText(label, x, frame.bottom + gap)
  })
  beside.forEach(([y, label], i) => {
    ctx.textBaseline = isLast(beside, i) ? "top" : "middle"
    ctx.textAlign = "right"
    ctx.fillText(label, frame.left - gap, y)
  })
}
