// Numbers on a grid as coloured cells.

const UNKNOWN = "#808080"

// "#rrggbb" or "#rrggbbaa" → the bytes in the order of memory, as all browsers' machines have it: alpha last.
function bytes(colour) {
  const value = Number.parseInt(colour.slice(1).padEnd(8, "f"), 16)
  const [red, green, blue, alpha] = [24, 16, 8, 0].map((shift) => (value >>> shift) & 255)
  return ((alpha << 24) | (blue << 16) | (green << 8) | red) >>> 0
}

// Row 0 is the lowest; colours of the palette from `low` to `high`.
function sheetOf({ rows, columns, numbers }, palette, low, high) {
  const sheet = document.createElement("canvas")
  ;[sheet.width, sheet.height] = [columns, rows]
  const paper = sheet.getContext("2d")
  const pixels = paper.createImageData(columns, rows)
  const out = new Uint32Array(pixels.data.buffer)
  const colours = palette.map(bytes)
  const unknown = bytes(UNKNOWN)
  const scale = colours.length / (high - low)
  for (let row = 0; row < rows; row++) {
    for (let i = 0, from = row * columns, to = (rows - 1 - row) * columns; i < columns; i++) {
      const value = numbers[from + i]
      out[to + i] = Number.isNaN(value) ? unknown
        : colours[Math.max(0, Math.min(colours.length - 1, Math.floor((value - low) * scale)))]
    }
  }
  paper.putImageData(pixels, 0, 0)
  return sheet
}

// layers: [{source, palette, low, high}]; a source holds image, x, y, dw, dh, as Bokeh's glyph "image".
export function cellsPainter(layers, source) {
  const sheets = new Map()
  return (ctx, xScale, yScale) => {
    ctx.imageSmoothingEnabled = false
    for (const { source: name, palette, low, high } of layers) {
      const { image: [cells] = [], x: [x] = [], y: [y] = [], dw: [wide] = [], dh: [high_] = [] } = source(name).data
      if (cells === undefined) continue
      if (sheets.get(name)?.cells !== cells) sheets.set(name, { cells, sheet: sheetOf(cells, palette, low, high) })
      const [left, right] = [xScale.compute(x), xScale.compute(x + wide)]
      const [bottom, top] = [yScale.compute(y), yScale.compute(y + high_)]
      ctx.drawImage(sheets.get(name).sheet, left, top, right - left, bottom - top)
    }
  }
}
