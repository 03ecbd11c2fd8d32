// @ts-check
// Colours of a chart, and the display of cells that are not computed yet.

// Cells with this status or a higher one have no number, see "sweep/quantity.py".
export const NO_NUMBER = 10
// Cells along a side of the coarse pass, see "sweep/chart.py".
const COARSE = 24
// Colours and marks of categories, in the order of their names.  The marks tell them apart without the colours.
const CATEGORY_COLOURS = ["#DCDCDC", "#0072B2", "#56B4E9", "#009E73", "#D55E00", "#E69F00", "#CC79A7", "#F0E442"]
const CATEGORY_MARKS = ["", "●", "▲", "○", "✕", "◆", "＋", "■"]
const NO_CATEGORY = "#808080"
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
 * Return the categories of a chart: value, name, colour and mark.
 * @param {Pick<Chart, "names">} chart
 */
export const categoriesOf = ({ names }) => names.map(([value, name], i) => ({
  value, name, colour: CATEGORY_COLOURS[i % CATEGORY_COLOURS.length], mark: CATEGORY_MARKS[i % CATEGORY_MARKS.length],
}))

/**
 * Return the ends of the colour scale of categories, and a palette with one colour for each whole number between them.
 * @param {ReturnType<typeof categoriesOf>} categories
 */
export function categoryColours(categories) {
  const values = categories.map(({ value }) => value)
  const [least, most] = [Math.min(...values), Math.max(...values)]
  return {
    low: least - 0.5, high: most + 0.5, isBelow: false, isAbove: false,
    palette: Array.from({ length: most - least + 1 }, (_, i) => (
      categories.find(({ value }) => value === least + i)?.colour ?? NO_CATEGORY)),
  }
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
