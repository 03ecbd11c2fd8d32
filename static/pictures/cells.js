// Numbers on a grid as coloured cells, or, of a continuous function, without steps.

import { onDark, shade } from "./looks.js"

const UNKNOWN = "#808080"

// "#rrggbb" or "#rrggbbaa" → the bytes in the order of memory, as all browsers' machines have it: alpha last.
function bytes(colour) {
  const value = Number.parseInt(colour.slice(1).padEnd(8, "f"), 16)
  const [red, green, blue, alpha] = [24, 16, 8, 0].map((shift) => (value >>> shift) & 255)
  return ((alpha << 24) | (blue << 16) | (green << 8) | red) >>> 0
}

// A sheet of so many pixels, filled by fill(out, colours, colourOf), row 0 the highest.
function sheetOf(columns, rows, { palette, low, high }, fill) {
  const sheet = document.createElement("canvas")
  ;[sheet.width, sheet.height] = [columns, rows]
  const paper = sheet.getContext("2d")
  const pixels = paper.createImageData(columns, rows)
  const colours = Uint32Array.from(palette, (colour) => bytes(shade(colour)))
  const last = colours.length - 1
  const scale = colours.length / (high - low)
  fill(new Uint32Array(pixels.data.buffer),
    (value) => colours[Math.max(0, Math.min(last, Math.floor((value - low) * scale)))])
  paper.putImageData(pixels, 0, 0)
  return sheet
}

function inCells({ rows, columns, numbers }, layer) {
  const unknown = bytes(UNKNOWN)
  return sheetOf(columns, rows, layer, (out, colourOf) => {
    for (let row = 0; row < rows; row++) {
      for (let i = 0, from = row * columns, to = (rows - 1 - row) * columns; i < columns; i++) {
        const value = numbers[from + i]
        out[to + i] = Number.isNaN(value) ? unknown : colourOf(value)
      }
    }
  })
}

// Where the pixels of a row of `size` lie among the centres of `count` cells: the cell before, and the share of the next.
function between(size, count) {
  const [cells, shares] = [new Int32Array(size), new Float32Array(size)]
  for (let i = 0; i < size; i++) {
    const at = Math.max(0, Math.min(count - 1, ((i + 0.5) * count) / size - 0.5))
    cells[i] = Math.min(Math.max(0, count - 2), Math.floor(at))
    shares[i] = at - cells[i]
  }
  return [cells, shares]
}

// Interpolated in each of width × height pixels; with `cyclic` the nearest way round.
function interpolated(cells, layer, width, height) {
  const { rows, columns, numbers } = cells
  const { low, high, cyclic } = layer
  const period = high - low
  const [ys, ups] = between(height, rows)
  const [xs, rights] = between(width, columns)
  const [right, above] = [columns > 1 ? 1 : 0, rows > 1 ? columns : 0]
  const mix = (a, b, share) => {
    let step = b - a
    if (cyclic) step -= period * Math.round(step / period)
    return a + share * step
  }
  return sheetOf(width, height, layer, (out, colourOf) => {
    for (let y = 0; y < height; y++) {
      const [row, up] = [ys[height - 1 - y] * columns, ups[height - 1 - y]]
      for (let x = 0; x < width; x++) {
        const at = row + xs[x]
        const value = mix(mix(numbers[at], numbers[at + right], rights[x]),
          mix(numbers[at + above], numbers[at + above + right], rights[x]), up)
        out[y * width + x] = colourOf(cyclic ? value - period * Math.floor((value - low) / period) : value)
      }
    }
  })
}

// Kinds, not numbers: in each pixel the kind that has most of the centres around it, by their shares; so that a border
// between two kinds runs straight between cells instead of around them.
function divided(cells, layer, width, height) {
  const { rows, columns, numbers } = cells
  const [ys, ups] = between(height, rows)
  const [xs, rights] = between(width, columns)
  const [right, above] = [columns > 1 ? 1 : 0, rows > 1 ? columns : 0]
  return sheetOf(width, height, layer, (out, colourOf) => {
    for (let y = 0; y < height; y++) {
      const [row, up] = [ys[height - 1 - y] * columns, ups[height - 1 - y]]
      for (let x = 0; x < width; x++) {
        const at = row + xs[x]
        const [a, b] = [numbers[at], numbers[at + right]]
        const [c, d] = [numbers[at + above], numbers[at + above + right]]
        let most = a
        if (a !== b || a !== c || a !== d) {
          const [p, q] = [rights[x], up]
          const shares = [(1 - p) * (1 - q), p * (1 - q), (1 - p) * q, p * q]
          const kinds = [a, b, c, d]
          let largest = -1
          for (let i = 0; i < 4; i++) {
            let share = 0
            for (let j = 0; j < 4; j++) if (kinds[j] === kinds[i]) share += shares[j]
            if (share > largest) [largest, most] = [share, kinds[i]]
          }
        }
        out[y * width + x] = colourOf(most)
      }
    }
  })
}

// layers: [{source, palette, low, high, smooth, cyclic, kinds}]; a source holds image, x, y, dw, dh, as Bokeh's glyph "image".
export function cellsPainter(layers, source) {
  const sheets = new Map()

  function sheetFor(layer, cells, width, height) {
    const size = layer.smooth || layer.kinds ? [Math.min(1200, width), Math.min(1200, height)] : []
    const key = [onDark(), ...size].join()
    const before = sheets.get(layer.source)
    if (before?.cells === cells && before.key === key) return before.sheet
    const sheet = layer.smooth ? interpolated(cells, layer, ...size)
      : layer.kinds ? divided(cells, layer, ...size) : inCells(cells, layer)
    sheets.set(layer.source, { cells, key, sheet })
    return sheet
  }

  return (ctx, xScale, yScale) => {
    ctx.imageSmoothingEnabled = false
    const { a: ratio } = ctx.getTransform()
    for (const layer of layers) {
      const { image: [cells] = [], x: [x] = [], y: [y] = [], dw: [wide] = [], dh: [high] = [] } = source(layer.source).data
      if (cells === undefined) continue
      const [left, right] = [xScale.compute(x), xScale.compute(x + wide)]
      const [bottom, top] = [yScale.compute(y), yScale.compute(y + high)]
      const sheet = sheetFor(layer, cells, Math.round(ratio * (right - left)), Math.round(ratio * (bottom - top)))
      ctx.drawImage(sheet, left, top, right - left, bottom - top)
    }
  }
}
