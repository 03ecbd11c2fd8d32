// @ts-check
// A translucent surface of revolution about the third axis, under orthographic projection.  Its facets are painted from back to
// front into pixels, with colours interpolated between their corners; so layers blend in the right order without WebGL.
//
// Vectors are in the view: to the right, upwards, towards the eye.  ψ is the angle about the axis, from the side of the eye.

import { element } from "../base/elements.js"
import { LIGHT, HALFWAY } from "./solid.js"
import { columnsOf, dot, scaled } from "./vectors.js"

// Facets around the axis of a large surface, and the largest number of pixels on a side, in a file and on the screen.  A small
// surface has every second facet: their sides are then some ten pixels long too, and a quarter of a pixel inside a circle.
const AROUND = 96
const FINE = 2048
const MOST = 640
const SMALL = 420
const BUCKETS = 1024

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
  const n = radius.length - 1
  /** Return the points of the cross-section, with fractions, where the surface turns away from the eye. @param {number} psi */
  const turns = (psi) => {
    const c = ce * Math.cos(psi)
    const found = []
    for (let i = 0; i < n; i++) {
      const [before, after] = [across[i] * c + along[i] * se, across[i + 1] * c + along[i + 1] * se]
      if (before >= 0 !== after >= 0) found.push(i + before / (before - after))
    }
    return found
  }
  /** @param {number} position @param {number} psi @returns {Vector} */
  const at = (position, psi) => {
    const i = Math.min(n - 1, Math.floor(position))
    const s = position - i
    const r = radius[i] + s * (radius[i + 1] - radius[i])
    return [r * Math.cos(azimuth + psi), r * Math.sin(azimuth + psi), height[i] + s * (height[i + 1] - height[i])]
  }
  /** @param {number} a @param {number} b */
  const apart = (a, b) => Math.min(Math.abs(a - b), n - Math.abs(a - b))
  /** @type {number[][][]} */
  const segments = []
  let [last, before] = [0, turns(0)]
  for (let j = 1; j <= AROUND; j++) {
    const psi = 2 * Math.PI * j / AROUND
    const found = turns(psi)
    for (const position of found) {
      const [nearest] = before.toSorted((one, other) => apart(one, position) - apart(other, position))
      if (!(apart(nearest, position) < n / 8)) continue
      segments.push(columnsOf([at(nearest, last), at(position, psi)]))
    }
    last = psi
    before = found
  }
  return segments
}

/** Return a painter of one surface. */
export function createRevolved() {
  const canvas = element("canvas")
  const paper = canvas.getContext("2d")
  let side = 0
  // Strides between used corners, around the axis and along the cross-section.
  let stride = 1
  /** @type {ImageData} */
  let image
  // Premultiplied colours, and the depth of the frontmost facet.
  let colours = new Float32Array(0)
  let depths = new Float32Array(0)

  // Corners: x, y, depth, and premultiplied red, green, blue, alpha.
  const WIDE = 7
  let corners = new Float64Array(0)
  let order = new Uint32Array(0)
  const starts = new Uint32Array(BUCKETS + 1)

  /**
   * Fill a triangle of corners; a pixel belongs to it if its centre does, so neighbours never share one.
   * @param {number} a
   * @param {number} b
   * @param {number} c
   */
  function fill(a, b, c) {
    const v = corners
    // Sort the corners by y.
    if (v[b + 1] < v[a + 1]) [a, b] = [b, a]
    if (v[c + 1] < v[a + 1]) [a, c] = [c, a]
    if (v[c + 1] < v[b + 1]) [b, c] = [c, b]
    const ya = v[a + 1]
    const yb = v[b + 1]
    const yc = v[c + 1]
    const top = Math.max(0, Math.ceil(ya - 0.5))
    const bottom = Math.min(side, Math.ceil(yc - 0.5))
    const xa = v[a]
    const xb = v[b]
    const xc = v[c]
    const area = (xb - xa) * (yc - ya) - (xc - xa) * (yb - ya)
    if (top >= bottom || area === 0) return
    // Neighbours find the same slope of the edge that they share: the upper end is always the first.
    const long = (xc - xa) / (yc - ya)
    const upper = (xb - xa) / (yb - ya)
    const lower = (xc - xb) / (yc - yb)
    // The shares of the corners b and c change by these from pixel to pixel.
    const bx = (yc - ya) / area
    const by = (xa - xc) / area
    const cx = (ya - yb) / area
    const cy = (xb - xa) / area
    const depth0 = v[a + 2], depthB = v[b + 2] - depth0, depthC = v[c + 2] - depth0
    const red0 = v[a + 3], redB = v[b + 3] - red0, redC = v[c + 3] - red0
    const green0 = v[a + 4], greenB = v[b + 4] - green0, greenC = v[c + 4] - green0
    const blue0 = v[a + 5], blueB = v[b + 5] - blue0, blueC = v[c + 5] - blue0
    const alpha0 = v[a + 6], alphaB = v[b + 6] - alpha0, alphaC = v[c + 6] - alpha0
    for (let row = top; row < bottom; row++) {
      const y = row + 0.5
      const x1 = xa + (y - ya) * long
      const x2 = y < yb ? xa + (y - ya) * upper : xb + (y - yb) * lower
      const from = Math.max(0, Math.ceil((x1 < x2 ? x1 : x2) - 0.5))
      const to = Math.min(side, Math.ceil((x1 < x2 ? x2 : x1) - 0.5))
      if (from >= to) continue
      const right = from + 0.5 - xa
      const atB = right * bx + (y - ya) * by
      const atC = right * cx + (y - ya) * cy
      let depth = depth0 + atB * depthB + atC * depthC
      let red = red0 + atB * redB + atC * redC
      let green = green0 + atB * greenB + atC * greenC
      let blue = blue0 + atB * blueB + atC * blueC
      let alpha = alpha0 + atB * alphaB + atC * alphaC
      const end = row * side + to
      for (let at = row * side + from; at < end; at++) {
        const i = 4 * at
        const through = 1 - alpha
        colours[i] = colours[i] * through + red
        colours[i + 1] = colours[i + 1] * through + green
        colours[i + 2] = colours[i + 2] * through + blue
        colours[i + 3] = colours[i + 3] * through + alpha
        depths[at] = depth
        depth += bx * depthB + cx * depthC
        red += bx * redB + cx * redC
        green += bx * greenB + cx * greenC
        blue += bx * blueB + cx * blueC
        alpha += bx * alphaB + cx * alphaC
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
      // The first and the last corner must coincide exactly.
      const psi = 2 * Math.PI * (j % AROUND) / AROUND
      const [c, s] = [Math.cos(psi), Math.sin(psi)]
      for (let i = 0; i < radius.length; i += stride) {
        const [ahead, z] = [radius[i] * c, height[i]]
        const outwards = [across[i] * s, ce * along[i] - se * across[i] * c, ce * across[i] * c + se * along[i]]
        const front = outwards[2] >= 0
        const normal = front ? outwards : scaled(outwards, -1)
        const lit = Math.max(0, dot(normal, LIGHT))
        const shine = Math.max(0, dot(normal, HALFWAY)) ** 24
        const rim = (1 - normal[2]) * (1 - normal[2])
        const share = density === null ? 0 : density(i, azimuth + psi)
        const bright = ambient + (1.08 - ambient) * lit
        const glint = front ? 90 * shine : 0
        const tone = front ? outside : inside
        const alpha = Math.min(1, (front ? 0.2 : 0.3) + 0.5 * rim + 0.4 * share + (front ? 0.5 * shine : 0))
        corners[k] = 0.5 * side + scale * radius[i] * s
        corners[k + 1] = 0.5 * side - scale * (ce * z - se * ahead)
        corners[k + 2] = ce * ahead + se * z
        for (let channel = 0; channel < 3; channel++) {
          const colour = tone[channel] + share * (dense[channel] - tone[channel])
          corners[k + 3 + channel] = Math.min(255, bright * colour + glint) * alpha
        }
        corners[k + 6] = alpha
        k += WIDE
      }
    }
  }

  /** Fill `order` with the facets from back to front, each by its first corner. @param {number} count points of the cross-section */
  function sort(count) {
    const opposite = WIDE * (count + 1)
    const around = AROUND / stride
    const facets = around * (count - 1)
    if (order.length !== facets) order = new Uint32Array(facets)
    starts.fill(0)
    /** @param {number} first */
    const bucket = (first) => {
      const depth = 0.25 * (corners[first + 2] + corners[first + opposite + 2]) + 0.5
      return Math.max(0, Math.min(BUCKETS - 1, Math.floor(depth * BUCKETS)))
    }
    /** @param {(first: number) => void} act */
    const each = (act) => {
      for (let j = 0; j < around; j++) for (let i = 0; i < count - 1; i++) act(WIDE * (j * count + i))
    }
    each((first) => { starts[bucket(first) + 1]++ })
    for (let b = 0; b < BUCKETS; b++) starts[b + 1] += starts[b]
    each((first) => { order[starts[bucket(first)]++] = first })
  }

  /** Size the buffers, and clear them. @param {number} pixels @param {number} count points of the cross-section */
  function begin(pixels, count) {
    if (pixels !== side) {
      side = canvas.width = canvas.height = pixels
      image = paper.createImageData(side, side)
      colours = new Float32Array(4 * side * side)
      depths = new Float32Array(side * side)
    }
    colours.fill(0)
    depths.fill(-Infinity)
    const length = WIDE * count * (AROUND / stride + 1)
    if (corners.length !== length) corners = new Float64Array(length)
  }

  function show() {
    const { data } = image
    for (let i = 0; i < data.length; i += 4) {
      const alpha = colours[i + 3]
      data[i + 3] = 255 * alpha
      if (alpha === 0) continue
      data[i] = colours[i] / alpha
      data[i + 1] = colours[i + 1] / alpha
      data[i + 2] = colours[i + 2] / alpha
    }
    paper.putImageData(image, 0, 0)
  }

  let key = ""
  /** The cross-section that was shaded. @type {ArrayLike<number> | null} */
  let last = null
  // Pixels per unit of length.
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
      const pixels = Math.min(isFine ? FINE : MOST, Math.round(edge * ratio))
      perEdge = pixels / edge
      // Without a density the surface looks the same from all azimuths.
      const now = [pixels, dark, turn[1], density && turn[0]].join()
      if (now === key && radius === last) return canvas
      key = now
      last = radius
      stride = pixels <= SMALL && radius.length % 2 === 1 ? 2 : 1
      const count = (radius.length - 1) / stride + 1
      begin(pixels, count)
      place(radius, height, turn, dark, scale * perEdge, density)
      sort(count)
      const [next, beside] = [WIDE, WIDE * count]
      for (const first of order) {
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
      return depth > depths[row * side + column] - slack
    },
  }
}
