// Draws thousands of dots of one colour as squares; Bokeh paints each as a circle with colours of its own.

import { zoom } from "../page/presenting.js"
import { shade } from "./looks.js"

// As large as a circle of Bokeh's marker "dot", whose diameter is a quarter of `size`.
const sideOf = (size) => (size / 8) * Math.sqrt(Math.PI)

/**
 * Return what paints layers of dots, see `frameCanvas`.
 * @param {{source: string, x: string, y: string, size: number, color: string, alpha: number}[]} layers x and y are columns
 * @param {(name: string) => import("./sources.js").Source} source
 */
export function dotsPainter(layers, source) {
  return (ctx, xScale, yScale) => {
    for (const { source: name, x, y, size, color, alpha } of layers) {
      const { [x]: xs = [], [y]: ys = [] } = source(name).data
      const side = zoom() * sideOf(size)
      const [left, top] = [xScale.v_compute(xs), yScale.v_compute(ys)]
      ctx.globalAlpha = alpha
      ctx.fillStyle = shade(color)
      for (let i = 0; i < left.length; i++) ctx.fillRect(left[i] - side / 2, top[i] - side / 2, side, side)
    }
  }
}
