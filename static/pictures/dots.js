// @ts-check
// Draws thousands of dots of one colour as squares; Bokeh would draw each as a circle with its own colours.

import { shade } from "./looks.js"

// Side of a square with the area of Bokeh's marker "dot", whose diameter is a quarter of `size`.
/** @param {number} size */
const sideOf = (size) => (size / 8) * Math.sqrt(Math.PI)

/**
 * Return the painter of layers of dots, see `frameCanvas`.
 * @param {{source: string, x: string, y: string, size: number, color: string, alpha: number}[]} layers x and y are columns
 * @param {FindSource} source
 * @returns {PaintFrame}
 */
export function dotsPainter(layers, source) {
  return (ctx, xScale, yScale, larger) => {
    for (const { source: name, x, y, size, color, alpha } of layers) {
      const { [x]: xs = [], [y]: ys = [] } = source(name).data
      const side = larger * sideOf(size)
      const [left, top] = [xScale.v_compute(xs), yScale.v_compute(ys)]
      ctx.globalAlpha = alpha
      ctx.fillStyle = shade(color)
      for (let i = 0; i < left.length; i++) ctx.fillRect(left[i] - side / 2, top[i] - side / 2, side, side)
    }
  }
}
