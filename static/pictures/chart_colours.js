// @ts-check
// Colours of a chart, and the display of cells that are not computed yet.

// Cells along a side of the coarse pass, see "sweep/chart.py".
const COARSE = 24
// Share of the numbers beyond each end of the colours: without it one outlier would take all colours.
const BEYOND = 0.01

/**
 * Return the ends of the colour scale, and whether some numbers lie beyond them: one turn, or all numbers but outliers.
 * @param {{values: Float64Array, turn: number}} chart
 * @returns {{low: number, high: number, isBelow: boolean, isAbove: boolean}}
 */
export function coloursOf({ values, turn }) {
  if (turn > 0) return { low: -turn / 2, high: turn / 2, isBelow: false, isAbove: false }
  const sorted = values.filter(Number.isFinite).sort()
  if (sorted.length === 0) return { low: 0, high: 1, isBelow: false, isAbove: false }
  /** @param {number} share */
  const at = (share) => sorted[Math.round(share * (sorted.length - 1))]
  const [least, most] = [at(0), at(1)]
  let [low, high] = [at(BEYOND), at(1 - BEYOND)]
  if (!(high > low)) [low, high] = [least, most]
  if (!(high > low)) {
    const room = Math.max(Math.abs(low) * 1e-6, 1e-9)
    ;[low, high] = [low - room, high + room]
  }
  return { low, high, isBelow: least < low, isAbove: most > high }
}

/**
 * Return the numbers of all cells.  A cell that is not computed yet takes the number of a computed cell nearby, at most one
 * coarse cell away; NaN where there is none.
 * @param {Pick<Chart, "values" | "status"> & {x: {count: number}, y: {count: number}}} chart
 */
export function filled({ values, status, x: { count: columns }, y: { count: rows } }) {
  let coarse = 1
  while (Math.max(rows, columns) > COARSE * coarse) coarse *= 2
  /** @param {number} i @param {number} step @param {number} count */
  const nearest = (i, step, count) => Math.min(Math.round(i / step) * step, Math.floor((count - 1) / step) * step)
  return Float32Array.from(values, (_, own) => {
    const [row, column] = [Math.floor(own / columns), own % columns]
    let at = own
    for (let step = 2; status[at] === 0 && step <= coarse; step *= 2) {
      at = nearest(row, step, rows) * columns + nearest(column, step, columns)
    }
    return status[at] === 0 ? NaN : values[at]
  })
}
