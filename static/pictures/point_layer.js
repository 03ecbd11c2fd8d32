// @ts-check
// Thousands of points, written into the pixels of a canvas: drawing each one would take many times longer.

import { element } from "../base/elements.js"
import { cloudColour } from "./looks.js"

/**
 * Return a layer that draws clouds of points as small translucent squares; where many overlap it is opaque.
 */
export function pointLayer() {
  const sheet = element("canvas")
  const paper = sheet.getContext("2d")
  /** @type {ImageData | null} */
  let pixels = null

  /** @param {number} size @param {number[]} colour */
  function begin(size, [red, green, blue]) {
    if (sheet.width !== size || pixels === null) {
      sheet.width = sheet.height = size
      pixels = paper.createImageData(size, size)
    }
    // Pixels are little-endian, with alpha last.
    new Uint32Array(pixels.data.buffer).fill((blue << 16) | (green << 8) | red)
  }

  return {
    /**
     * Draw clouds into a picture of `size` device pixels.
     * @template {{count: number}} Points
     * @param {CanvasRenderingContext2D} ctx
     * @param {number} size
     * @param {number} ratio device pixels per unit
     * @param {Points[]} clouds
     * @param {(cloud: Points, add: (x: number, y: number) => void) => void} points calls add(x, y) in device pixels for each point
     */
    draw(ctx, size, ratio, clouds, points) {
      const side = Math.round(1.6 * ratio)
      clouds.forEach((cloud, k) => {
        begin(size, cloudColour(k))
        const { data } = pixels
        // Draw smaller clouds darker.
        const alpha = Math.max(110, Math.min(230, 1_100_000 / cloud.count))
        points(cloud, (x, y) => {
          const [left, top] = [Math.round(x - side / 2), Math.round(y - side / 2)]
          if (!(left >= 0 && top >= 0 && left + side <= size && top + side <= size)) return
          for (let row = 0; row < side; row++) {
            const at = 4 * ((top + row) * size + left) + 3
            for (let i = 0; i < side; i++) data[at + 4 * i] += alpha
          }
        })
        paper.putImageData(pixels, 0, 0)
        // Copy pixel by pixel, whatever the unit.
        ctx.save()
        ctx.setTransform(1, 0, 0, 1, 0, 0)
        ctx.drawImage(sheet, 0, 0)
        ctx.restore()
      })
    },
  }
}
