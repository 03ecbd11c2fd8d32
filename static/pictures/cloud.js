// @ts-check
// Clouds of phase points, moved between the frames that the server has sent, and written into the pixels of a canvas: drawing each
// point would take many times longer.
//
// For each cloud i the source holds `frames<i>`: numbers [frame][column][point] at evenly spaced `times`, with the columns
// (x, y, γ1, γ2, γ3).  Without `signs<i>`, x and y are ω1 and ω2 of a motion with I13 = I23 = 0 in the field b3.  With
// `signs<i>`, x is (ω, ξ) and y is ln|s|, where s = I13ω1 + I23ω2, there is no field, and `signs<i>` holds the signs of s.
// `body` = [I11, I22, I13, I23, 𝒟, b3]; `sense` is 1, or −1 if time runs backward.

import { element } from "../base/elements.js"
import { cloudColour } from "./looks.js"
import { moment } from "./moment.js"
import { atFirst } from "./sources.js"

class Cloud {
  /**
   * @param {Float32Array} frames
   * @param {Float32Array | undefined} signs
   * @param {number[]} body
   * @param {number[]} times
   * @param {number} sense
   */
  constructor(frames, signs, body, times, sense) {
    this.frames = frames
    this.signs = signs
    this.body = body
    this.times = times
    this.sense = sense
    this.count = frames.length / (5 * times.length)
    this.size = 5 * this.count
    this.step = times[1] - times[0]
    const column = () => new Float32Array(this.count)
    this.x = column()
    this.y = column()
    this.g1 = column()
    this.g2 = column()
    this.g3 = column()
    this.w1 = column()
    this.w2 = column()
    // The columns at the time t, and their slopes at both ends of its interval.
    this.columns = [this.x, this.y, this.g1, this.g2, this.g3]
    this.slopes = [0, 1].map(() => this.columns.map(column))
    this.left = -1
    /** @type {number | null} */
    this.t = null
    // The largest slope of s and its direction.
    const J = Math.hypot(body[2], body[3])
    this.axes = [J, body[2] / J, body[3] / J]
  }

  /** Return ω1 and ω2 of point i at x, y. @param {number} x @param {number} y @param {number} i */
  velocity(x, y, i) {
    if (this.signs === undefined) return [x, y]
    const [J, n1, n2] = this.axes
    const across = (this.signs[i] * Math.exp(y)) / J
    return [n2 * x + n1 * across, n2 * across - n1 * x]
  }

  /**
   * Compute the slopes at a frame by `eq29`: ω̇ = s h with h = Î⁻¹(−ω2, ω1), so that d ln|s|/dt = (I13, I23)·h; or
   * Îω̇ = (b3γ2, −b3γ1); and γ̇ = γ × ω.
   * @param {number} frame
   * @param {Float32Array[]} slopes
   */
  prepare(frame, slopes) {
    const [dx, dy, d1, d2, d3] = slopes
    const { frames, count, size, signs, body } = this
    const [I11, I22, I13, I23, D, b3] = body
    const [, n1, n2] = this.axes
    const isFree = signs !== undefined
    for (let i = 0, at = frame * size; i < count; i++, at++) {
      const [x, y] = [frames[at], frames[at + count]]
      const [g1, g2, g3] = [frames[at + 2 * count], frames[at + 3 * count], frames[at + 4 * count]]
      const [w1, w2] = this.velocity(x, y, i)
      const [a11, a12, a22] = [I11 + D * (g2 * g2 + g3 * g3), -D * g1 * g2, I22 + D * (g1 * g1 + g3 * g3)]
      const det = a11 * a22 - a12 * a12
      const [f1, f2] = isFree ? [-w2, w1] : [b3 * g2, -b3 * g1]
      const [h1, h2] = [(a22 * f1 - a12 * f2) / det, (a11 * f2 - a12 * f1) / det]
      dx[i] = isFree ? signs[i] * Math.exp(y) * (n2 * h1 - n1 * h2) : h1
      dy[i] = isFree ? I13 * h1 + I23 * h2 : h2
      d1[i] = -g3 * w2
      d2[i] = g3 * w1
      d3[i] = g1 * w2 - g2 * w1
    }
  }

  /** Move the points to the time t, on cubic curves between two frames. @param {number} t */
  moveTo(t) {
    if (t === this.t) return
    this.t = t
    const { frames, count, size, times, step, sense, g1, g2, g3 } = this
    const left = Math.max(0, Math.min(times.length - 2, Math.floor((t - times[0]) / step)))
    const [from, to] = this.slopes
    if (left !== this.left) {
      this.left = left
      this.prepare(left, from)
      this.prepare(left + 1, to)
    }
    const u = Math.max(0, Math.min(1, (t - times[left]) / step))
    const b = u * u * (3 - 2 * u)
    const [e, f] = [u * (1 - u) * (1 - u) * step * sense, u * u * (u - 1) * step * sense]
    this.columns.forEach((column, k) => {
      const [rise, fall] = [from[k], to[k]]
      for (let i = 0, p = left * size + k * count; i < count; i++, p++) {
        column[i] = (1 - b) * frames[p] + b * frames[p + size] + e * rise[i] + f * fall[i]
      }
    })
    for (let i = 0; i < count; i++) {
      const inverse = 1 / Math.sqrt(g1[i] * g1[i] + g2[i] * g2[i] + g3[i] * g3[i])
      g1[i] *= inverse
      g2[i] *= inverse
      g3[i] *= inverse
      ;[this.w1[i], this.w2[i]] = this.velocity(this.x[i], this.y[i], i)
    }
  }
}

const cloudsFrom = atFirst((/** @type {Data} */ data) => [0, 1].filter((i) => data[`frames${i}`]?.length > 0).map((i) => (
  new Cloud(data[`frames${i}`], data[`signs${i}`], data.body, data.times, data.sense))))

/**
 * Return the clouds of a source; at(t) returns them at a time.  All pictures of a source share its clouds.
 * @param {Source} source
 */
export function cloudsOf(source) {
  return {
    /** @param {number} t */
    at(t) {
      const clouds = cloudsFrom(source.data)
      for (const cloud of clouds) cloud.moveTo(t)
      return clouds
    },
  }
}

/**
 * Return a layer that draws the clouds of a source as small translucent squares; where many overlap it is opaque.
 * @param {Source} source
 */
export function pointLayer(source) {
  const clouds = cloudsOf(source)
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
    // Little-endian pixels, alpha last.
    new Uint32Array(pixels.data.buffer).fill((blue << 16) | (green << 8) | red)
  }

  return {
    /**
     * Draw the clouds at the time of the player.
     * @param {{ctx: CanvasRenderingContext2D, edge: number, ratio: number}} picture its edge, and device pixels per unit
     * @param {(cloud: Cloud, add: (x: number, y: number) => void) => void} points calls add(x, y) in device pixels for each point
     */
    draw({ ctx, edge, ratio }, points) {
      const size = Math.round(edge * ratio)
      const side = Math.round(1.6 * ratio)
      clouds.at(moment.t).forEach((cloud, k) => {
        begin(size, cloudColour(k))
        const { data } = pixels
        // Smaller clouds are darker.
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
