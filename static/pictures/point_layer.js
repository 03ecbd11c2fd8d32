// Thousands of points, written into the pixels of a sheet: drawing each one would take many times as long.

// A transparent layer of points, each a small square: where many lie together it is opaque.
export function pointLayer() {
  const sheet = document.createElement("canvas")
  const paper = sheet.getContext("2d")
  let pixels = null
  return {
    begin(size, [red, green, blue]) {
      if (sheet.width !== size || pixels === null) {
        sheet.width = sheet.height = size
        pixels = paper.createImageData(size, size)
      }
      // Bytes in the order of memory, as all browsers' machines have it: alpha last.
      new Uint32Array(pixels.data.buffer).fill((blue << 16) | (green << 8) | red)
    },
    add(x, y, side, alpha) {
      const size = sheet.width
      const [left, top] = [Math.round(x - side / 2), Math.round(y - side / 2)]
      if (!(left >= 0 && top >= 0 && left + side <= size && top + side <= size)) return
      for (let row = 0; row < side; row++) {
        const at = 4 * ((top + row) * size + left) + 3
        for (let i = 0; i < side; i++) pixels.data[at + 4 * i] += alpha
      }
    },
    end(ctx) {
      paper.putImageData(pixels, 0, 0)
      ctx.drawImage(sheet, 0, 0)
    },
  }
}

// Side of a point in device pixels, and its opacity (0 … 255): the fewer, the darker.
export const sideOf = (ratio) => Math.round(1.6 * ratio)
export const alphaOf = (cloud) => Math.max(110, Math.min(230, 1_100_000 / cloud.count))
