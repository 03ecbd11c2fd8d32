// @ts-check
// Draws thousands of dots of one colour as squares, where Bokeh would draw each as a circle with its own colours, and the points
// that move in time on a canvas of their own: while a scene plays, Bokeh has nothing to paint.

import { circlePath, linePath, shade } from "./looks.js"
import { drawBeads } from "./swarm.js"

/** Begin a path with a triangle that points downwards; its centre is at (x, y). @type {typeof circlePath} */
function trianglePath(ctx, x, y, radius) {
  const height = radius * Math.sqrt(3)
  linePath(ctx, [[x - radius, y - height / 3], [x + radius, y - height / 3], [x, y + 2 * height / 3]])
  ctx.closePath()
}

/** @type {Record<string, typeof circlePath>} */
const PATHS = { circle: circlePath, inverted_triangle: trianglePath }

/**
 * Return the painter of moving points, see `frameCanvas`.
 * @param {{source: string, columns: string[], marker: string, size: number, line_width: number, line_color: string, fill_color: string}[]} layers
 * @param {FindSource} source
 * @returns {PaintFrame}
 */
export function movingPointsPainter(layers, source) {
  return (ctx, xScale, yScale, larger) => {
    for (const { columns } of layers) {
      drawBeads(ctx, source("data-swarm"), columns, ([x, y], i) => [xScale.compute(x[i]), yScale.compute(y[i])])
    }
    for (const { source: name, marker, size, line_width: width, line_color: line, fill_color: filling } of layers) {
      const { x: [x] = [], y: [y] = [] } = source(name).data
      if (x === undefined) continue
      PATHS[marker](ctx, xScale.compute(x), yScale.compute(y), larger * size / 2)
      ctx.fillStyle = shade(filling)
      ctx.fill()
      ctx.lineWidth = larger * width
      ctx.strokeStyle = shade(line)
      ctx.stroke()
    }
  }
}

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
      // The area of Bokeh's marker "dot", whose diameter is a quarter of `size`.
      const side = larger * size * Math.sqrt(Math.PI) / 8
      const [left, top] = [xScale.v_compute(xs), yScale.v_compute(ys)]
      ctx.globalAlpha = alpha
      ctx.fillStyle = shade(color)
      for (let i = 0; i < left.length; i++) ctx.fillRect(left[i] - side / 2, top[i] - side / 2, side, side)
    }
  }
}
