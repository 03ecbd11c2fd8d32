// @ts-check
// Tick labels of an axis.

const FAR_BELOW = 1e-3
const FAR_ABOVE = 1e5

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
