// @ts-check
// A swarm: motions from many starts, drawn as beads beside the moving point, each in the colour of its start.
//
// The source "data-swarm" holds `count` motions at times `spacing` apart.  `values` are whole numbers [column][sample][motion];
// the value of a column is `low` + `step` (whole + 32767).  Between samples columns are cubic; those of the kind "angle" take the
// shorter way round, and those of the kind "step" stay.  From the sample `until` on a motion is not known to half a pixel, and not
// drawn; shortly before, it fades.  See "scenes/framework/swarm.py".

import { drawDisc, shade } from "./looks.js"
import { moment } from "./moment.js"
import { atFirst } from "./sources.js"

const FIRST = 32767
const TURN = 2 * Math.PI
// A bead fades during the last samples before its motion is no longer known.
const FADING = 4
// Radius of a bead by the number of motions: the first size whose number is not exceeded.
/** @type {[most: number, radius: number][]} */
const SIZES = [[50, 5], [200, 4], [Infinity, 2]]

/** Return an angle between −π and π. @param {number} angle */
const wrapped = (angle) => angle - TURN * Math.round(angle / TURN)

/** The motions of a swarm. */
export class Swarm {
  /** @param {Data} data */
  constructor(data) {
    this.data = data
    this.samples = data.values.length / (data.count * data.names.length)
    /** @type {Map<string, {t: number, values: Float32Array}>} */
    this.columns = new Map()
  }

  /** Return a column of all motions at the time t. @param {string} name @param {number} t */
  at(name, t) {
    if (!this.columns.has(name)) this.columns.set(name, { t: NaN, values: new Float32Array(this.data.count) })
    const column = this.columns.get(name)
    if (column.t !== t) {
      column.t = t
      this.#fill(column.values, this.data.names.indexOf(name), t)
    }
    return column.values
  }

  /** @param {Float32Array} out @param {number} k @param {number} t */
  #fill(out, k, t) {
    const { samples, data: { count, spacing, values, kinds: { [k]: kind }, low: { [k]: low }, step: { [k]: step } } } = this
    const share = t / spacing
    const left = Math.max(0, Math.min(samples - 2, Math.floor(share)))
    const s = Math.max(0, Math.min(1, share - left))
    const at = (/** @type {number} */ row, /** @type {number} */ i) => low + step * (values[(k * samples + row) * count + i] + FIRST)
    for (let i = 0; i < count; i++) {
      const b = at(left, i)
      if (kind === "step") {
        out[i] = s < 1 ? b : at(left + 1, i)
        continue
      }
      const near = (/** @type {number} */ value) => (kind === "angle" ? b + wrapped(value - b) : value)
      const c = near(at(left + 1, i))
      // Beyond the ends the curve goes on as a parabola.
      const a = left > 0 ? near(at(left - 1, i)) : 3 * b - 3 * c + near(at(left + 2, i))
      const d = left < samples - 2 ? near(at(left + 2, i)) : 3 * c - 3 * b + a
      // The cubic through four samples is worst halfway, where the server measures it.
      const value = (1 - s) * (2 - s) * ((1 + s) * b / 2 - s * a / 6) + (1 + s) * s * ((2 - s) * c / 2 - (1 - s) * d / 6)
      out[i] = kind === "angle" ? wrapped(value) : value
    }
  }

  /**
   * Return the opacity of motion i at the time t: 0 when it is not known any more; before that it fades.
   * @param {number} i
   * @param {number} t
   */
  opacity(i, t) {
    const left = this.data.until[i] + 1e-6 - t / this.data.spacing
    const isKnownToTheEnd = this.data.until[i] >= this.samples - 1
    return left < 0 ? 0 : isKnownToTheEnd ? 1 : Math.min(1, left / FADING)
  }
}

const swarmOf = atFirst((/** @type {Data} */ data) => (data.count > 0 ? new Swarm(data) : null))

/**
 * Draw the beads of a swarm whose columns have these names; nothing without such a swarm.
 * @param {CanvasRenderingContext2D} ctx
 * @param {Source} source
 * @param {string[]} names
 * @param {(columns: Float32Array[], i: number) => [x: number, y: number, isNear?: boolean]} pointOf returns the point of motion i
 */
export function drawBeads(ctx, source, names, pointOf) {
  const swarm = swarmOf(source.data)
  if (!swarm || !names.every((name) => swarm.data.names.includes(name))) return
  const { count, palette } = swarm.data
  const columns = names.map((name) => swarm.at(name, moment.t))
  const [, radius] = SIZES.find(([most]) => count <= most)
  ctx.save()
  ctx.lineWidth = 0.7
  ctx.strokeStyle = shade("#101010")
  for (let i = 0; i < count; i++) {
    const opacity = swarm.opacity(i, moment.t)
    if (opacity === 0) continue
    const [x, y, isNear = true] = pointOf(columns, i)
    ctx.globalAlpha = (isNear ? 1 : 0.35) * opacity
    drawDisc(ctx, x, y, radius, palette[Math.floor(i * palette.length / count)])
    if (radius > 2) ctx.stroke()
  }
  ctx.restore()
}
