// @ts-check
// Paints a grid of numbers as coloured cells, or interpolated in each pixel.

/** @typedef {{palette: string[], low: number, high: number, smooth?: boolean, cyclic?: boolean, kinds?: boolean, fine?: boolean}} Colouring */
/** @typedef {Colouring & {source: string}} CellLayer a layer of cells, and its source */
/** @typedef {(a: number, b: number, c: number, d: number, right: number, up: number) => number} Mix */

import { element } from "../base/elements.js"
import { bytesOf, onDark, shade } from "./looks.js"

const MOST_PIXELS = 1200

/** Return a colour as a 32-bit pixel: little endian, alpha last. @param {string} colour */
function packed(colour) {
  const [red, green, blue, alpha] = bytesOf(colour)
  return ((alpha << 24) | (blue << 16) | (green << 8) | red) >>> 0
}

/**
 * Return a canvas with the colours of numbers; row 0 is at the top.
 * @param {number} columns
 * @param {number} rows
 * @param {Colouring} colouring
 * @param {(row: number, column: number) => number} valueAt rows are counted from below
 */
function sheetOf(columns, rows, { palette, low, high }, valueAt) {
  const sheet = element("canvas", { width: columns, height: rows })
  const paper = sheet.getContext("2d")
  const pixels = paper.createImageData(columns, rows)
  const out = new Uint32Array(pixels.data.buffer)
  const colours = Uint32Array.from(palette, (colour) => packed(shade(colour)))
  const last = colours.length - 1
  const scale = colours.length / (high - low)
  for (let row = 0, i = 0; row < rows; row++) {
    for (let column = 0; column < columns; column++, i++) {
      const value = valueAt(rows - 1 - row, column)
      // Leave out cells without a number, and in interpolated pictures also points next to them.
      out[i] = Number.isNaN(value) ? 0 : colours[Math.max(0, Math.min(last, Math.floor((value - low) * scale)))]
    }
  }
  paper.putImageData(pixels, 0, 0)
  return sheet
}

/**
 * Return, for `size` pixels along `count` cells, the cell before each pixel and the share of the next cell.
 * @param {number} size
 * @param {number} count
 * @returns {[Int32Array, Float32Array]}
 */
function between(size, count) {
  const [cells, shares] = [new Int32Array(size), new Float32Array(size)]
  for (let i = 0; i < size; i++) {
    const at = Math.max(0, Math.min(count - 1, ((i + 0.5) * count) / size - 0.5))
    cells[i] = Math.min(Math.max(0, count - 2), Math.floor(at))
    shares[i] = at - cells[i]
  }
  return [cells, shares]
}

/**
 * Return a canvas with mix(a, b, c, d, right, up) in each pixel, for the four cells around it: two below, two above.
 * @param {Grid} grid
 * @param {Colouring} layer
 * @param {number} width
 * @param {number} height
 * @param {Mix} mix
 */
function resampled({ rows, columns, numbers }, layer, width, height, mix) {
  const [ys, ups] = between(height, rows)
  const [xs, rights] = between(width, columns)
  const [right, above] = [columns > 1 ? 1 : 0, rows > 1 ? columns : 0]
  return sheetOf(width, height, layer, (y, x) => {
    const at = ys[y] * columns + xs[x]
    return mix(numbers[at], numbers[at + right], numbers[at + above], numbers[at + above + right], rights[x], ups[y])
  })
}

/**
 * Return bilinear interpolation; cyclic numbers take the shorter way round.
 * @param {Colouring} colouring
 * @returns {Mix}
 */
function interpolation({ low, high, cyclic }) {
  const period = high - low
  /** @param {number} a @param {number} b @param {number} share */
  const mix = (a, b, share) => a + share * (b - a - (cyclic ? period * Math.round((b - a) / period) : 0))
  return (a, b, c, d, right, up) => {
    const value = mix(mix(a, b, right), mix(c, d, right), up)
    return cyclic ? value - period * Math.floor((value - low) / period) : value
  }
}

/**
 * Return the kind with the largest share among the four cells around, so that borders between kinds run straight.
 * @type {Mix}
 */
function majority(a, b, c, d, right, up) {
  if (a === b && a === c && a === d) return a
  const shares = [(1 - right) * (1 - up), right * (1 - up), (1 - right) * up, right * up]
  const kinds = [a, b, c, d]
  /** @param {number} kind */
  const shareOf = (kind) => shares.reduce((sum, share, i) => (kinds[i] === kind ? sum + share : sum), 0)
  return kinds.reduce((most, kind) => (shareOf(kind) > shareOf(most) ? kind : most))
}

/**
 * Return the painter of layers of cells, see `frameCanvas`.
 * @param {CellLayer[]} layers
 * @param {(name: string) => {data: Data}} source its data hold image, x, y, dw, dh, as for Bokeh's glyph "image"
 * @returns {(ctx: CanvasRenderingContext2D, xScale: Scale, yScale: Scale) => void}
 */
export function cellsPainter(layers, source) {
  /** @type {Map<string, {cells: Grid, key: string, sheet: HTMLCanvasElement}>} */
  const sheets = new Map()

  /** @param {CellLayer} layer @param {Grid} cells @param {number} width @param {number} height */
  function sheetFor(layer, cells, width, height) {
    const mix = layer.smooth ? interpolation(layer) : layer.kinds ? majority : null
    const [wide, high] = mix === null ? [cells.columns, cells.rows] : [width, height].map((side) => Math.min(MOST_PIXELS, side))
    const key = [onDark(), wide, high, layer.low, layer.high].join()
    const before = sheets.get(layer.source)
    if (before?.cells === cells && before.key === key) return before.sheet
    const sheet = mix === null ? sheetOf(wide, high, layer, (row, column) => cells.numbers[row * cells.columns + column])
      : resampled(cells, layer, wide, high, mix)
    sheets.set(layer.source, { cells, key, sheet })
    return sheet
  }

  return (ctx, xScale, yScale) => {
    const { a: ratio } = ctx.getTransform()
    for (const layer of layers) {
      const data = source(layer.source).data
      const { image: [cells] = [], x: [x] = [], y: [y] = [], dw: [wide] = [], dh: [high] = [] } = data
      if (cells === undefined) continue
      const { low: [least] = [layer.low], high: [most] = [layer.high] } = data
      const [left, right] = [xScale.compute(x), xScale.compute(x + wide)]
      const [bottom, top] = [yScale.compute(y), yScale.compute(y + high)]
      const sheet = sheetFor({ ...layer, low: least, high: most }, cells, Math.round(ratio * (right - left)), Math.round(ratio * (bottom - top)))
      // Average cells about as large as pixels, so that no curve falls between two pixels.
      ctx.imageSmoothingEnabled = layer.fine === true
      ctx.imageSmoothingQuality = "high"
      ctx.drawImage(sheet, left, top, right - left, bottom - top)
    }
  }
}
