// @ts-check
// An opaque ellipsoid under orthographic projection.  Each ray of sight meets the surface in closed form, so the ellipsoid
// hides its own back and is shaded without WebGL; its outline is drawn as an ellipse.
//
// Vectors are in the view: to the right, upwards, towards the eye.  The unit of length is the radius of the sphere around.

import { element } from "../base/elements.js"
import { within } from "../base/numbers.js"
import { dot, unit } from "./vectors.js"

// Largest number of shading pixels on a side, on the screen and in a file, and picture pixels per shading pixel: shades change
// slowly.
const MOST = 128
const FINE = 512
const COARSE = 2
// The light comes over the left shoulder of the viewer and turns with the view.
export const LIGHT = unit([-0.42, 0.62, 0.66])
export const HALFWAY = unit([-0.23, 0.34, 0.91])
// The two tones of the octants, and their brightness without direct light.
const TONES = {
  light: { even: [203, 214, 226], odd: [158, 175, 194], ambient: 0.5 },
  dark: { even: [150, 164, 182], odd: [107, 123, 144], ambient: 0.34 },
}
const GLASS = 0.22

/**
 * Return the outline of an ellipsoid: the half axes of the ellipse, the angle of the longer one from the right, and half the
 * width and height of its bounding box.
 * @param {Vector[]} axes unit vectors of the principal axes
 * @param {number[]} semi half lengths along them
 */
export function outline(axes, semi) {
  let [xx, xy, yy] = [0, 0, 0]
  for (let k = 0; k < 3; k++) {
    const [x, y] = [semi[k] * axes[k][0], semi[k] * axes[k][1]]
    xx += x * x
    xy += x * y
    yy += y * y
  }
  const [mean, apart] = [(xx + yy) / 2, Math.hypot((xx - yy) / 2, xy)]
  return {
    halves: [Math.sqrt(mean + apart), Math.sqrt(Math.max(0, mean - apart))],
    angle: Math.atan2(2 * xy, xx - yy) / 2, width: Math.sqrt(xx), height: Math.sqrt(yy),
  }
}

/**
 * Return whether the ellipsoid, enlarged by `margin`, hides the point (x, y).
 * @param {Vector[]} axes
 * @param {number[]} semi
 * @param {number} x
 * @param {number} y
 */
export function covers(axes, semi, x, y, margin = 0) {
  const { halves, angle } = outline(axes, semi)
  const [c, s] = [Math.cos(angle), Math.sin(angle)]
  return Math.hypot((c * x + s * y) / (halves[0] + margin), (c * y - s * x) / (halves[1] + margin)) < 1
}

/**
 * Return the factor `at` with which a ray from the centre along v leaves the surface at v·at, and whether that side is visible.
 * @param {Vector[]} axes
 * @param {number[]} semi
 * @param {Vector} v
 */
export function leaves(axes, semi, v) {
  let [square, towards] = [0, 0]
  for (let k = 0; k < 3; k++) {
    const u = dot(v, axes[k]) / semi[k]
    square += u * u
    towards += (u / semi[k]) * axes[k][2]
  }
  return { at: 1 / Math.sqrt(square), near: towards >= 0 }
}

/** @param {number} x */
const clipped = (x) => within(x, -1, 1)

/** Return a painter of ellipsoids. */
export function createSolid() {
  const canvas = element("canvas")
  const shade = canvas.getContext("2d")
  /** @type {ImageData} */
  let image

  /** @param {number} side */
  function size(side) {
    if (image?.width === side) return
    canvas.width = canvas.height = side
    image = shade.createImageData(side, side)
  }

  /**
   * Shade the ellipsoid on the canvas.
   * @param {Vector[]} axes
   * @param {number[]} semi
   * @param {number} width
   * @param {number} height
   * @param {number} columns
   * @param {number} rows
   * @param {{even: number[], odd: number[], ambient: number}} tone
   * @param {boolean} glass
   */
  function cast(axes, semi, width, height, columns, rows, { even, odd, ambient }, glass) {
    const { data, width: side } = image
    // Use coordinates in which the ellipsoid is the unit sphere; a ray is start + depth × along.
    const [ux, uy, uz] = [0, 1, 2].map((i) => axes.map((axis, k) => axis[i] / semi[k]))
    const a = dot(uz, uz)
    // The shading goes on for a few pixels beyond the outline.
    const beyond = 1 + 6 / Math.min(columns, rows)
    const outside = a * (1 - beyond * beyond)
    // A tone changes over one and a half pixels.
    const sharp = columns / (3 * width)
    const [s0, s1, s2] = semi.map((length) => length * sharp)
    for (let row = 0; row < rows; row++) {
      const y = height * (1 - (2 * row + 1) / rows)
      for (let column = 0; column < columns; column++) {
        const x = width * ((2 * column + 1) / columns - 1)
        const hit = [x * ux[0] + y * uy[0], x * ux[1] + y * uy[1], x * ux[2] + y * uy[2]]
        const b = dot(hit, uz)
        const inside = b * b - a * (dot(hit, hit) - 1)
        if (inside < outside) continue
        // Shade the edge beyond the outline too, for smoothing.
        const z = (Math.sqrt(Math.max(0, inside)) - b) / a
        for (let k = 0; k < 3; k++) hit[k] += z * uz[k]
        const normal = [dot(hit, ux), dot(hit, uy), dot(hit, uz)]
        const long = 1 / Math.sqrt(dot(normal, normal))
        const lit = Math.max(0, dot(normal, LIGHT) * long)
        const shine = Math.max(0, dot(normal, HALFWAY) * long) ** 16
        const octant = clipped(hit[0] * s0) * clipped(hit[1] * s1) * clipped(hit[2] * s2)
        const share = 0.5 + 0.5 * octant
        const bright = ambient + (1.08 - ambient) * lit
        const i = 4 * (row * side + column)
        for (let k = 0; k < 3; k++) data[i + k] = bright * (odd[k] + share * (even[k] - odd[k])) + 70 * shine
        const rim = 1 - Math.max(0, normal[2] * long)
        data[i + 3] = glass ? 255 * Math.min(1, GLASS + 0.12 * share + 0.5 * rim * rim + 0.6 * shine) : 255
      }
    }
    // Smoothing reads one pixel beyond the outline, where a larger body may have been drawn.
    shade.clearRect(0, 0, side, side)
    shade.putImageData(image, 0, 0, 0, 0, columns, rows)
  }

  return {
    /**
     * Draw an ellipsoid; `glass` makes it translucent.
     * @param {Sheet} sheet
     * @param {Vector[]} axes in the view
     * @param {number[]} semi
     */
    paint({ ctx, half, scale, ratio, dark, isFine, use }, axes, semi, glass = false) {
      const { halves, angle, width, height } = outline(axes, semi)
      const most = isFine ? FINE : MOST
      size(most)
      const [columns, rows] = [width, height].map((length) =>
        Math.max(16, Math.min(most, Math.ceil((2 * length * scale * ratio) / COARSE))))
      cast(axes, semi, width, height, columns, rows, TONES[dark ? "dark" : "light"], glass)
      const edge = new Path2D()
      edge.ellipse(half, half, scale * halves[0], scale * halves[1], -angle, 0, 2 * Math.PI)
      ctx.save()
      ctx.globalAlpha = 1
      ctx.clip(edge)
      ctx.drawImage(canvas, 0, 0, columns, rows, half - scale * width, half - scale * height, 2 * scale * width,
        2 * scale * height)
      ctx.restore()
      ctx.save()
      ctx.globalAlpha = 0.55
      use({ weight: 1.25 })
      ctx.stroke(edge)
      ctx.restore()
    },
  }
}
