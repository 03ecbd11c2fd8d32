// @ts-check
// A translucent surface of revolution about the third axis, under orthographic projection.  Its facets are painted from back to
// front into pixels, with colours interpolated between their corners; so layers blend in the right order without WebGL.
//
// Vectors are in the view: to the right, upwards, towards the eye.  ψ is the angle about the axis, from the side of the eye.

import { element } from "../base/elements.js"
import { LIGHT, HALFWAY } from "./solid.js"

// Facets around the axis, and the largest number of pixels on a side, in a file and on the screen.  The screen has every second
// facet: their sides are some ten pixels long, and less than half a pixel inside a circle.
const AROUND = 96
const FINE = 2048
const MOST = 640
// Numbers of a corner: x, y, then what a pixel has too: premultiplied red, green, blue, alpha, and depth.
const CORNER = 7
const PIXEL = 5
// Depths are sorted by so many steps for a unit.
const STEPS = 1e5
// Pixels to the right and downwards, so that no edge runs through centres of pixels, which two facets would paint, or none.
const ASIDE = [1e-4, 3e-4]

// Tones of the outside, of the inside and of a dense part, and the brightness without direct light.
const TONES = {
  light: { outside: [186, 203, 224], inside: [132, 152, 180], dense: [0, 158, 115], ambient: 0.5 },
  dark: { outside: [148, 170, 200], inside: [84, 102, 132], dense: [29, 190, 143], ambient: 0.4 },
}

/**
 * Return the normals of a closed cross-section, as columns: away from the axis and along it.
 * @param {ArrayLike<number>} radius
 * @param {ArrayLike<number>} height
 */
function normals(radius, height) {
  const n = radius.length - 1
  const [across, along] = [new Float64Array(n + 1), new Float64Array(n + 1)]
  for (let i = 0; i <= n; i++) {
    const [before, after] = [i === 0 ? n - 1 : i - 1, i === n ? 1 : i + 1]
    const [dr, dz] = [radius[after] - radius[before], height[after] - height[before]]
    const length = Math.hypot(dr, dz) || 1
    across[i] = -dz / length
    along[i] = dr / length
  }
  return { across, along }
}

// The sides of a facet, from corner to corner: along the cross-section and around.
const SIDES = [[0, 0, 1, 0], [1, 0, 1, 1], [1, 1, 0, 1], [0, 1, 0, 0]]

/**
 * Return the outline of a surface of revolution as segments, each as columns: where the line of sight touches it.
 * @param {ArrayLike<number>} radius
 * @param {ArrayLike<number>} height
 * @param {number} azimuth of the eye
 * @param {number} elevation
 * @returns {number[][][]}
 */
export function outline(radius, height, azimuth, elevation) {
  const { across, along } = normals(radius, height)
  const [ce, se] = [Math.cos(elevation), Math.sin(elevation)]
  /** @param {number} j */
  const angle = (j) => 2 * Math.PI * j / AROUND
  // How much the surface faces the eye.
  const facing = Array.from({ length: AROUND + 1 }, (_, j) => across.map((x, i) => x * ce * Math.cos(angle(j)) + along[i] * se))
  /** @param {number} i with a fraction, in the cross-section @param {number} j with a fraction, around @returns {Vector} */
  const at = (i, j) => {
    const k = Math.floor(i)
    /** @param {ArrayLike<number>} column */
    const value = (column) => column[k] + (i > k ? (i - k) * (column[k + 1] - column[k]) : 0)
    const psi = azimuth + angle(j)
    return [value(radius) * Math.cos(psi), value(radius) * Math.sin(psi), value(height)]
  }
  /** @type {number[][][]} */
  const segments = []
  for (let j = 0; j < AROUND; j++) {
    for (let i = 0; i < radius.length - 1; i++) {
      /** @type {Vector[]} */
      const ends = []
      for (const [i0, j0, i1, j1] of SIDES) {
        const before = facing[j + j0][i + i0], after = facing[j + j1][i + i1]
        const share = before / (before - after)
        if (before >= 0 !== after >= 0) ends.push(at(i + i0 + share * (i1 - i0), j + j0 + share * (j1 - j0)))
      }
      // It crosses two sides of a facet, or none.
      if (ends.length === 2) segments.push([0, 1, 2].map((k) => ends.map((end) => end[k])))
    }
  }
  return segments
}

/** Return a painter of one surface. */
export function createRevolved() {
  const canvas = element("canvas")
  const paper = canvas.getContext("2d")
  let side = 0
  // Each so-manyth corner is used, around the axis and along the cross-section.
  let stride = 1
  /** @type {ImageData} */
  let image
  let pixels = new Float32Array(0)
  let corners = new Float64Array(0)

  /**
   * Fill a triangle of corners; a pixel belongs to it if its centre does.
   * @param {number} a
   * @param {number} b
   * @param {number} c
   */
  function fill(a, b, c) {
    const v = corners
    const xa = v[a], xb = v[b], xc = v[c], ya = v[a + 1], yb = v[b + 1], yc = v[c + 1]
    const area = (xb - xa) * (yc - ya) - (xc - xa) * (yb - ya)
    // The shares of the corners b and c change by these from pixel to pixel.
    const bx = (yc - ya) / area, by = (xa - xc) / area, cx = (ya - yb) / area, cy = (xb - xa) / area
    const right = Math.min(side, Math.max(xa, xb, xc) - 0.5), bottom = Math.min(side, Math.max(ya, yb, yc) - 0.5)
    const left = Math.max(0, Math.ceil(Math.min(xa, xb, xc) - 0.5))
    for (let row = Math.max(0, Math.ceil(Math.min(ya, yb, yc) - 0.5)); row < bottom; row++) {
      for (let column = left; column < right; column++) {
        const x = column + 0.5 - xa, y = row + 0.5 - ya
        const atB = x * bx + y * by
        const atC = x * cx + y * cy
        const atA = 1 - atB - atC
        if (!(atA >= 0 && atB >= 0 && atC >= 0)) continue
        const at = PIXEL * (row * side + column)
        const through = 1 - atA * v[a + 5] - atB * v[b + 5] - atC * v[c + 5]
        for (let k = 0; k < PIXEL; k++) {
          const own = atA * v[a + 2 + k] + atB * v[b + 2 + k] + atC * v[c + 2 + k]
          // Depth is that of what is in front.
          pixels[at + k] = k < 4 ? pixels[at + k] * through + own : own
        }
      }
    }
  }

  /**
   * Place and shade the corners.
   * @param {ArrayLike<number>} radius
   * @param {ArrayLike<number>} height
   * @param {[number, number]} turn
   * @param {boolean} dark
   * @param {number} scale pixels per unit
   * @param {((i: number, phi: number) => number) | null} density from 0 to 1 on the cross-section's point i, at an angle
   */
  function place(radius, height, [azimuth, elevation], dark, scale, density) {
    const { across, along } = normals(radius, height)
    const { outside, inside, dense, ambient } = TONES[dark ? "dark" : "light"]
    const [ce, se] = [Math.cos(elevation), Math.sin(elevation)]
    let k = 0
    for (let j = 0; j <= AROUND; j += stride) {
      // The first and the last are one, to the last bit.
      const psi = 2 * Math.PI * (j % AROUND) / AROUND
      const [c, s] = [Math.cos(psi), Math.sin(psi)]
      for (let i = 0; i < radius.length; i += stride) {
        const [ahead, z] = [radius[i] * c, height[i]]
        let nx = across[i] * s
        let ny = ce * along[i] - se * across[i] * c
        let nz = ce * across[i] * c + se * along[i]
        const front = nz >= 0
        if (!front) [nx, ny, nz] = [-nx, -ny, -nz]
        const lit = Math.max(0, nx * LIGHT[0] + ny * LIGHT[1] + nz * LIGHT[2])
        const shine = Math.max(0, nx * HALFWAY[0] + ny * HALFWAY[1] + nz * HALFWAY[2]) ** 24
        const rim = (1 - nz) * (1 - nz)
        const share = density === null ? 0 : density(i, azimuth + psi)
        const bright = ambient + (1.08 - ambient) * lit
        const glint = front ? 90 * shine : 0
        const tone = front ? outside : inside
        const alpha = Math.min(1, (front ? 0.2 : 0.3) + 0.5 * rim + 0.4 * share + (front ? 0.5 * shine : 0))
        corners[k++] = 0.5 * side + ASIDE[0] + scale * radius[i] * s
        corners[k++] = 0.5 * side + ASIDE[1] - scale * (ce * z - se * ahead)
        for (let channel = 0; channel < 3; channel++) {
          const colour = tone[channel] + share * (dense[channel] - tone[channel])
          corners[k++] = Math.min(255, bright * colour + glint) * alpha
        }
        corners[k++] = alpha
        corners[k++] = ce * ahead + se * z
      }
    }
  }

  /** Return the facets from back to front, each by its first corner. @param {number} count points of the cross-section */
  function sorted(count) {
    const facets = AROUND / stride * (count - 1)
    // Numbers are sorted faster than by a function: the depth, then the facet.
    const keys = new Float64Array(facets)
    for (let facet = 0; facet < facets; facet++) {
      const first = firstOf(facet, count)
      const depth = corners[first + 6] + corners[first + CORNER * (count + 1) + 6]
      keys[facet] = Math.round(STEPS * (2 + depth)) * facets + facet
    }
    return keys.sort().map((key) => firstOf(key % facets, count))
  }

  /** @param {number} facet @param {number} count */
  const firstOf = (facet, count) => CORNER * (facet + Math.floor(facet / (count - 1)))

  /** Size the buffers, and clear them. @param {number} size @param {number} count points of the cross-section */
  function begin(size, count) {
    if (size !== side) {
      side = canvas.width = canvas.height = size
      image = paper.createImageData(side, side)
      pixels = new Float32Array(PIXEL * side * side)
    }
    pixels.fill(0)
    const length = CORNER * count * (AROUND / stride + 1)
    if (corners.length !== length) corners = new Float64Array(length)
  }

  function show() {
    const { data } = image
    for (let i = 0, at = 0; i < data.length; i += 4, at += PIXEL) {
      const alpha = pixels[at + 3]
      data[i + 3] = 255 * alpha
      if (alpha > 0) for (let k = 0; k < 3; k++) data[i + k] = pixels[at + k] / alpha
    }
    paper.putImageData(image, 0, 0)
  }

  let key = ""
  /** The cross-section that was shaded. @type {ArrayLike<number> | null} */
  let last = null
  // Pixels per unit of the sheet.
  let perEdge = 1

  return {
    /**
     * Shade the surface, if it has changed; its image covers the sheet.
     * @param {Sheet} sheet
     * @param {ArrayLike<number>} radius of the points of the closed cross-section
     * @param {ArrayLike<number>} height
     * @param {[number, number]} turn azimuth and elevation of the eye
     * @param {((i: number, phi: number) => number) | null} density see `place`
     */
    shade({ edge, ratio, scale, dark, isFine }, radius, height, turn, density) {
      const size = Math.min(isFine ? FINE : MOST, Math.round(edge * ratio))
      perEdge = size / edge
      // Without a density the surface looks the same from all azimuths.
      const now = [size, dark, turn[1], density && turn[0]].join()
      if (now === key && radius === last) return canvas
      key = now
      last = radius
      stride = isFine || radius.length % 2 === 0 ? 1 : 2
      const count = (radius.length - 1) / stride + 1
      begin(size, count)
      place(radius, height, turn, dark, scale * perEdge, density)
      const [next, beside] = [CORNER, CORNER * count]
      for (const first of sorted(count)) {
        fill(first, first + next, first + beside)
        fill(first + next, first + beside, first + next + beside)
      }
      show()
      return canvas
    },
    /**
     * Return whether the shaded surface does not hide a point that lies on it within `slack`.
     * @param {number} x on the sheet
     * @param {number} y
     * @param {number} depth
     * @param {number} slack in radii of the unit sphere
     */
    shows(x, y, depth, slack) {
      const column = Math.floor(x * perEdge)
      const row = Math.floor(y * perEdge)
      if (!(column >= 0 && row >= 0 && column < side && row < side)) return true
      const at = PIXEL * (row * side + column)
      return pixels[at + 3] === 0 || depth > pixels[at + 4] - slack
    },
  }
}
