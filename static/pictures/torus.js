// @ts-check
// The torus as a surface in space, with the orbit and the limit cycles on it.  Drag, arrow keys and touch turn it.
//
// Its own source, with the name of the picture, holds the columns radius and height of the closed cross-section, from the lowest
// n₃; where there is a density, also re and im of the points ζ at which its Poisson kernel is.  The option `curves` names the
// sources of curves (columns x, y, z, and t for the orbit) and their looks.

import { drawPoint, drawTrail, TRAIL } from "./body_parts.js"
import { FAINT } from "./ghost.js"
import { LOOKS } from "./looks.js"
import { between, moment } from "./moment.js"
import { createRevolved, outline } from "./revolved.js"
import { curvesOf } from "./sources.js"
import { drawBeads } from "./swarm.js"
import { turnable } from "./turnable.js"
import { circle, scaled } from "./vectors.js"

// The orbit is thin, because it may fill the surface; its trail is thicker.
const THIN = 1.3
const HIDDEN = 0.55
// How far behind the surface curves may seem to lie, in radii of the unit sphere.  At its outline it is steep.
const [ON_IT, AT_EDGE] = [0.05, 0.25]

/**
 * Return the density on the surface, from 0 to 1, or null without one.
 *
 * With z = e^{iφ} it is the Poisson kernel (1 − |ζ|²)/|z − ζ|², and w = |w|(sin φ, cos φ).
 * @param {Data} columns
 * @returns {((i: number, angle: number) => number) | null}
 */
function densityOf({ re, im }) {
  if (!(re?.length > 0)) return null
  const length = Array.from(re, (/** @type {number} */ x, i) => Math.hypot(x, im[i]))
  // The kernel is largest where z is nearest to ζ: (1 + |ζ|)/(1 − |ζ|).
  const most = Math.max(...length.map((one) => (1 + one) / (1 - one)))
  return (i, angle) => {
    const square = (Math.sin(angle) - re[i]) ** 2 + (Math.cos(angle) - im[i]) ** 2
    return (1 - length[i] * length[i]) / square / most
  }
}

/**
 * Draw a torus in an element.
 * @param {HTMLElement} el
 * @param {PictureDescription} options
 * @param {FindSource} source
 * @param {() => boolean} isShown whether the scene is on show
 * @returns {Drawn}
 */
export function torus(el, options, source, isShown) {
  const own = source(options.name)
  // The surface is shaded separately for the screen and for files.
  const [onScreen, inFiles] = [createRevolved(), createRevolved()]
  /** @param {Sheet} sheet */
  const surfaceOf = ({ isFine }) => (isFine ? inFiles : onScreen)
  /** Return whether the surface does not hide a point on it. @param {Sheet} sheet @param {Vector} point */
  const isSeen = (sheet, point, slack = ON_IT) => surfaceOf(sheet).shows(...sheet.at(point), sheet.depth(...point), slack)

  const curves = () => curvesOf(options.curves, source, ["x", "y", "z"])

  /** @param {Sheet} sheet */
  function paint(sheet) {
    const { radius, height } = own.data
    if (!(radius?.length > 2)) return
    const { ctx, turn } = sheet
    const image = surfaceOf(sheet).shade(sheet, radius, height, turn, densityOf(own.data))
    const on = onSurface(sheet)
    const edge = outline(radius, height, ...turn)
    const ring = circle([0, 0, 1], 0).map((column, k) => (k < 2 ? scaled(column, radius[0]) : column))
    drawLines(on, edge, ring, false)
    ctx.globalAlpha = 1
    ctx.drawImage(image, 0, 0, sheet.edge, sheet.edge)
    drawLines(on, edge, ring, true)
  }

  /** @param {Sheet} sheet */
  function paintMoving(sheet) {
    if (!(own.data.radius?.length > 2)) return
    const on = onSurface(sheet)
    drawBeads(sheet.ctx, source("data-swarm"), ["x", "y", "z"], ([x, y, z], i) => {
      const point = [x[i], y[i], z[i]]
      return [...sheet.at(point), isSeen(sheet, point)]
    })
    for (const [name, curve, times] of curves()) {
      if (times === undefined) continue
      const path = until(curve, times)
      for (const near of [false, true]) drawTrail(on, path, LOOKS[name], near)
      sheet.ctx.globalAlpha = 1
      /** @type {Vector} */
      const position = path.map((column) => column[column.length - 1])
      drawPoint(sheet, position, isSeen(sheet, position))
    }
  }

  /** Return a sheet on which the surface hides the curves behind it. @param {Sheet} sheet @returns {Sheet} */
  function onSurface(sheet) {
    return { ...sheet, stroke(curve, near) { strokeAll(sheet, [curve], near, ON_IT) } }
  }

  /**
   * Stroke the visible or the hidden parts of curves.
   * @param {Sheet} sheet
   * @param {Columns[]} list
   * @param {boolean} near
   * @param {number} slack
   */
  function strokeAll(sheet, list, near, slack) {
    sheet.ctx.beginPath()
    for (const curve of list) {
      const [X, Y, Z] = curve
      sheet.addParts(curve, (i) => (
        isSeen(sheet, [0.5 * (X[i - 1] + X[i]), 0.5 * (Y[i - 1] + Y[i]), 0.5 * (Z[i - 1] + Z[i])], slack) === near))
    }
    sheet.ctx.stroke()
  }

  /** @param {Sheet} on @param {Columns[]} edge @param {number[][]} ring @param {boolean} near */
  function drawLines(on, edge, ring, near) {
    const { ctx, stroke, use } = on
    use({ weight: 1.5 })
    ctx.globalAlpha = near ? 0.6 : 0.2
    strokeAll(on, edge, near, AT_EDGE)
    use({ weight: 1.5, dash: [2, 3] })
    ctx.globalAlpha = near ? 0.9 : HIDDEN
    stroke(ring, near)
    for (const [look, curve, times] of curves()) {
      use(times === undefined ? LOOKS[look] : { ...LOOKS[look], weight: THIN })
      ctx.globalAlpha = near ? 1 : HIDDEN
      stroke(curve, near)
    }
  }

  /** Return the end of a curve before the time of the player. @param {Columns} curve @param {ArrayLike<number>} times @returns {number[][]} */
  function until(curve, times) {
    const [i, s] = between(times, moment.t)
    return curve.map((column) => {
      const path = Array.prototype.slice.call(column, Math.max(0, i - TRAIL), i + 1)
      return [...path, column[i] + s * (column[i + 1] - column[i])]
    })
  }

  return turnable(el, "torus", {
    name: options.name, title: "The torus in space", what: "torus", isShown,
    sources: [options.name, ...Object.keys(options.curves), "data-swarm"].map(source), paint, paintMoving,
    take: () => ({ radius: own.data.radius, height: own.data.height, list: curves() }),
    paintGhost(on, { radius, height, list }) {
      if (!(radius?.length > 2)) return
      on.ctx.globalAlpha = FAINT
      for (const near of [false, true]) {
        on.use({ weight: 1.5 })
        for (const segment of outline(radius, height, ...on.turn)) on.stroke(segment, near)
        for (const [look, curve] of list) {
          on.use(LOOKS[look])
          on.stroke(curve, near)
        }
      }
    },
  })
}
