// @ts-check
// Orthographic projection of space, and lines and labels in it.

import { linePath, useLook } from "./looks.js"

// Radius of the unit sphere, as a share of half the picture.
export const RADIUS = 0.84
// Places for a label, in order of preference: at its point, below, above, right, left, and diagonally.
const ASIDE = [[0, 0], [0, 1], [0, -1], [1, 0], [-1, 0], [1, 1], [-1, 1]]

/**
 * Return the projection of a sphere and the functions that draw lines and labels in it.
 * @param {CanvasRenderingContext2D} ctx
 * @param {SquareLook} look
 * @param {[number, number]} turn azimuth and elevation of the eye
 */
export function createSheet(ctx, { edge, ratio, text, dark, isFine = false }, turn) {
  const [azimuth, elevation] = turn
  const [ca, sa, ce, se] = [Math.cos(azimuth), Math.sin(azimuth), Math.cos(elevation), Math.sin(elevation)]
  const half = edge / 2
  const scale = half * RADIUS
  /** @param {number} x @param {number} y */
  const px = (x, y) => half + scale * (ca * y - sa * x)
  /** @param {number} x @param {number} y @param {number} z */
  const py = (x, y, z) => half - scale * (ce * z - se * (ca * x + sa * y))
  /** @type {(...point: Vector) => number} */
  const depth = (x, y, z) => ce * (ca * x + sa * y) + se * z
  /** @type {(point: Vector) => [number, number]} */
  const at = ([x, y, z]) => [px(x, y), py(x, y, z)]
  // Written labels: centre and half the width.
  /** @type {number[][]} */
  const taken = []
  /**
   * Add segments of a curve to the path.
   * @param {Columns} curve
   * @param {(i: number) => boolean} isThere whether the segment that ends at point i is added
   */
  function addParts([X, Y, Z], isThere) {
    let drawing = false
    for (let i = 1; i < X.length; i++) {
      const is = isThere(i)
      if (is) {
        if (!drawing) ctx.moveTo(px(X[i - 1], Y[i - 1]), py(X[i - 1], Y[i - 1], Z[i - 1]))
        ctx.lineTo(px(X[i], Y[i]), py(X[i], Y[i], Z[i]))
      }
      drawing = is
    }
  }
  return {
    addParts, ctx, edge, ratio, text, dark, isFine, turn, half, scale, px, py, depth, at,
    /**
     * Return a point in the view: to the right, upwards, towards the eye.
     * @param {Vector} point
     */
    view: ([x, y, z]) => [ca * y - sa * x, ce * z - se * (ca * x + sa * y), depth(x, y, z)],
    /** @param {Vector} point */
    isNear: (point) => depth(...point) >= 0,
    /** @param {Look} look */
    use(look) { useLook(ctx, look, text) },
    /** @param {Vector} from @param {Vector} to */
    line(from, to) {
      linePath(ctx, [at(from), at(to)])
      ctx.stroke()
    },
    /**
     * Draw the part of a curve on one side of the sphere.
     * @param {Columns} curve
     * @param {boolean} near
     * @param {Columns} normals vectors whose direction decides the side
     */
    stroke([X, Y, Z], near, [U, V, W] = [X, Y, Z]) {
      ctx.beginPath()
      addParts([X, Y, Z], (i) => depth(U[i] + U[i - 1], V[i] + V[i - 1], W[i] + W[i - 1]) >= 0 === near)
      ctx.stroke()
    },
    /**
     * Write a label inside the picture and beside other labels.
     * @param {string} label
     * @param {number} x
     * @param {number} y
     */
    write(label, x, y) {
      if (!label) return
      const [across, down] = [ctx.measureText(label).width / 2, 8]
      const places = ASIDE.map(([a, b]) => [
        Math.min(Math.max(x + a * (across + 16), across), edge - across),
        // Add a margin for rounding.
        Math.min(Math.max(y + b * (2 * down + 1), down), edge - down)])
      /** @param {number[]} place */
      const free = ([left, top]) => taken.every(([other, above, wide]) => (
        Math.abs(left - other) >= across + wide + 2 || Math.abs(top - above) >= 2 * down))
      const [left, top] = places.find(free) ?? places[0]
      taken.push([left, top, across])
      ctx.fillStyle = text
      ctx.fillText(label, left, top)
    },
  }
}
