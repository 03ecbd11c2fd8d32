// How space is seen from afar (an orthographic projection), and the lines and labels that are drawn in it.

import { useLook } from "./looks.js"

// Of half the picture: the radius of the unit sphere.
export const RADIUS = 0.84
// Where a label goes whose place is taken: below, above, to the right, to the left.
const ASIDE = [[0, 0], [0, 1], [0, -1], [1, 0], [-1, 0], [1, 1], [-1, 1]]

/**
 * Return what everything on a sphere is drawn with: its projection, lines and labels.
 * @param {CanvasRenderingContext2D} ctx
 * @param {{edge: number, ratio: number, text: string, dark: boolean}} look see "canvas.js"
 * @param {number[]} turn azimuth and elevation of the eye
 */
export function createSheet(ctx, { edge, ratio, text, dark }, [azimuth, elevation]) {
  const [ca, sa, ce, se] = [Math.cos(azimuth), Math.sin(azimuth), Math.cos(elevation), Math.sin(elevation)]
  const half = edge / 2
  const scale = half * RADIUS
  const px = (x, y) => half + scale * (ca * y - sa * x)
  const py = (x, y, z) => half - scale * (ce * z - se * (ca * x + sa * y))
  const depth = (x, y, z) => ce * (ca * x + sa * y) + se * z
  /** @returns {[number, number]} */
  const at = ([x, y, z]) => [px(x, y), py(x, y, z)]
  // Where a label stands already: middle and half of its width.
  const taken = []
  return {
    ctx, edge, ratio, text, dark, half, scale, px, py, depth, at,
    // To the right, upwards, towards the eye.
    view: ([x, y, z]) => [ca * y - sa * x, ce * z - se * (ca * x + sa * y), depth(x, y, z)],
    isNear: (point) => depth(...point) >= 0,
    use(look) { useLook(ctx, look, text) },
    line(from, to) {
      ctx.beginPath()
      ctx.moveTo(...at(from))
      ctx.lineTo(...at(to))
      ctx.stroke()
    },
    // A curve, where it is on this side.
    stroke([X, Y, Z], near, [U, V, W] = [X, Y, Z]) {
      ctx.beginPath()
      let drawing = false
      for (let i = 1; i < X.length; i++) {
        const visible = depth(U[i] + U[i - 1], V[i] + V[i - 1], W[i] + W[i - 1]) >= 0 === near
        if (visible) {
          if (!drawing) ctx.moveTo(px(X[i - 1], Y[i - 1]), py(X[i - 1], Y[i - 1], Z[i - 1]))
          ctx.lineTo(px(X[i], Y[i]), py(X[i], Y[i], Z[i]))
        }
        drawing = visible
      }
      ctx.stroke()
    },
    // Whole, also at the edge of the picture, and beside any other label.
    write(label, x, y) {
      if (!label) return
      const [across, down] = [ctx.measureText(label).width / 2, 8]
      const places = ASIDE.map(([a, b]) => [
        Math.min(Math.max(x + a * (across + 16), across), edge - across),
        // A little further than needed: sums are rounded.
        Math.min(Math.max(y + b * (2 * down + 1), down), edge - down)])
      const free = ([left, top]) => taken.every(([other, above, wide]) => (
        Math.abs(left - other) >= across + wide + 2 || Math.abs(top - above) >= 2 * down))
      const [left, top] = places.find(free) ?? places[0]
      taken.push([left, top, across])
      ctx.fillStyle = text
      ctx.fillText(label, left, top)
    },
  }
}
