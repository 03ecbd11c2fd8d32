// @ts-check
// A rigid body in space: a solid ellipsoid in its principal axes with weights on them, rods from its fixed point, the wheels
// of its constraint, the trail of a point, its shadow on the ground, and curves fixed in space.  It is a guest of "sphere.js", which rotates the picture.  Parts behind the
// body are painted before it and parts in front after it; a rod begins where it leaves the surface.
//
// In space e points along x and γ downwards, as gravity does for the potential −μ(r, γ).  The source of the option `attitude`
// holds the columns t, g1, g2, g3, e1, e2, e3 of an orbit: γ and e in body coordinates.  The picture's own source holds, in
// body coordinates except for the curves,
//   axes [[x, y, z]] × 3, semi [3], names [3]: principal axes, half lengths of the ellipsoid, labels;
//   section [x, y, z, radius]: a circular section, by its normal;  rods [[x, y, z, look, label]];
//   weights [[x, y, z, radius]];
//   wheels [x, y, z, ex, ey, ez, look]: contact point of a wheel with the sphere, rolling direction e, and the look of its
//   trace; the other wheel is opposite;  arc: the way of the contact point towards e, a column beside the attitude;
//   trail [x, y, z, look]: a point that leaves a trail;  hollow: whether the body is a glass ball around an inner ball;
//   curves [[look, weight, xs, ys, zs]] in space, weight 0 for that of the look;  axis and label of the arrow below.

import {
  drawArrow, drawBall, drawLine, drawMass, drawShadow, drawTrail, drawWheel, TRAIL, turnsOf, WHEEL,
} from "./body_parts.js"
import { circlePath, drawDisc, LOOKS } from "./looks.js"
import { between, moment } from "./moment.js"
import { covers, createSolid, leaves } from "./solid.js"
import { circle, columnsOf, cross, dot, plus, scaled, unit } from "./vectors.js"

const CAVITY = 0.62
const INNER = 0.26
const BALL = 9
// Colours of the weights on a light page and on a dark page.
const STEEL = ["#7C8794", "#8E99A6"]

/**
 * Return the map of directions from the body to space at the share s between the samples i and i + 1; γ and e are made
 * orthonormal after the interpolation.
 * @param {Data} columns
 * @param {number} i
 * @param {number} s
 * @returns {(v: Vector) => Vector}
 */
function placing(columns, i, s) {
  /** @param {string} name */
  const read = (name) => [1, 2, 3].map((k) => {
    const column = columns[name + k]
    return column[i] + (s && s * (column[i + 1] - column[i]))
  })
  const g = unit(read("g"))
  const raw = read("e")
  const e = unit(plus(raw, g, -dot(g, raw)))
  const f = cross(g, e)
  return (v) => [dot(v, e), -dot(v, f), -dot(v, g)]
}

/**
 * Draw the part of a circular section whose surface normal points to the eye.
 * @param {Sheet} sheet
 * @param {Vector} normal
 * @param {number} radius
 * @param {Vector[]} axes
 * @param {number[]} semi
 */
function drawSection({ use, stroke }, normal, radius, axes, semi) {
  use({ weight: 2.5, dash: [6, 4] })
  const ring = circle(normal, 0, 192)
  const sides = columnsOf(ring[0].map((_, i) => {
    const at = ring.map((column) => column[i])
    return axes.reduce((sum, axis, k) => plus(sum, axis, dot(at, axis) / (semi[k] * semi[k])), [0, 0, 0])
  }))
  stroke(ring.map((column) => scaled(column, radius)), true, sides)
}

/**
 * Return the guest that draws a body.
 * @param {Source} source
 * @param {Source} attitude
 */
export function bodyIn(source, attitude) {
  const solid = createSolid()

  /** Return the body at the time t, placed once for both halves. @param {Sheet} sheet */
  function now({ view }) {
    const { t: times, ...columns } = attitude.data
    if (!(times?.length > 1)) return null
    const [i, s] = between(times, moment.t)
    const place = placing(columns, i, s)
    const { axes = /** @type {Vector[]} */ ([]), semi = [], trail = [], wheels = [], arc = [] } = source.data
    const first = Math.max(0, i - TRAIL)
    const places = [...Array(i + 1 - first).keys()].map((j) => placing(columns, first + j, 0))
    places.push(place)
    /** Return the latest path of a point of the body. @param {Vector} tip */
    const pathOf = (tip) => columnsOf(places.map((there) => there(tip)))
    /** @type {Vector[]} */
    const placed = axes.map(place)
    const way = arc.length ? arc[i] + s * (arc[i + 1] - arc[i]) : 0
    return {
      place, placed, seen: semi.length === 3 ? placed.map(view) : [],
      path: trail.length ? pathOf(trail.slice(0, 3)) : null, way,
      trace: wheels.length ? pathOf(wheels.slice(0, 3)) : null,
      ways: wheels.length ? [...arc.slice(first, i + 1), way] : [],
    }
  }

  /**
   * Draw the visible part of a rod on one side.
   * @param {Sheet} sheet
   * @param {Vector} to
   * @param {Look} look
   * @param {string} label
   * @param {boolean} near
   */
  function drawRod(sheet, to, look, label, near) {
    const { ctx, text, dark, at, view, isNear, write } = sheet
    const { semi = [] } = source.data
    const { seen } = held
    const out = seen.length ? leaves(seen, semi, view(to)) : { at: 0, near: isNear(to) }
    if (out.near !== near || out.at >= 1) return
    drawLine(sheet, scaled(to, Math.min(1, out.at * 0.99)), to, look)
    const isMass = look === LOOKS.mass
    if (isMass) drawMass(ctx, ...at(to), BALL, text, dark)
    const beyond = scaled(to, 1 + 0.12 / Math.hypot(...to))
    const [right, up] = view(beyond)
    // A half-hidden label would be unreadable.
    if (!label || (!near && seen.length && covers(seen, semi, right, up, 0.05))) return
    const aside = isMass ? 16 : 0
    const [x, y] = at(beyond)
    write(label, x + aside, y - aside)
  }

  /** Draw a weight on its rod. @param {Sheet} sheet @param {Vector} to @param {number} radius @param {boolean} near */
  function drawWeight(sheet, to, radius, near) {
    const { ctx, at, view, dark, scale } = sheet
    const { semi, hollow } = source.data
    if (leaves(held.seen, semi, view(to)).near !== near) return
    if (!hollow) drawRod(sheet, to, { weight: 2 }, "", near)
    drawBall(ctx, ...at(to), STEEL[Number(dark)], radius * scale, dark ? "#C5CCD5" : "#39424D")
  }

  /** @type {ReturnType<typeof now> | null} */
  let held = null
  return {
    /** Place the body for all the painting that follows. @param {Sheet} sheet */
    begin(sheet) {
      held = now(sheet)
      if (held?.seen.length) drawShadow(sheet, held.placed, source.data.semi)
    },
    /** @param {Sheet} sheet @param {boolean} near */
    paint(sheet, near) {
      const { ctx, stroke, use, isNear } = sheet
      const {
        semi = [], names = [], section = [], weights = [], rods = [], wheels = [], trail = [], curves = [], axis, label = "",
      } = source.data
      const alpha = ctx.globalAlpha
      ctx.globalAlpha = near ? 1 : 0.45
      for (const [look, weight, ...curve] of curves) {
        use({ ...LOOKS[look], ...(weight && { weight }) })
        stroke(curve, near)
      }
      if (held === null) return
      const { place, placed, path, trace, ways, way } = held
      if (path) drawTrail(sheet, path, LOOKS[trail[3]], near)
      if (trace) drawTrail(sheet, trace, LOOKS[wheels[6]], near, turnsOf(ways))
      ctx.globalAlpha = 1
      if (section.length === 4 && semi.length === 3 && near) drawSection(sheet, place(section), section[3], placed, semi)
      if (semi.length === 3) placed.forEach((direction, k) => {
        if (!names[k]) return
        for (const sign of [1, -1]) {
          drawRod(sheet, scaled(direction, sign * (semi[k] + 0.1)), { weight: 2 }, sign > 0 ? names[k] : "", near)
        }
      })
      for (const [x, y, z, radius] of weights) drawWeight(sheet, place([x, y, z]), radius, near)
      if (wheels.length) {
        const along = place(wheels.slice(3, 6))
        for (const sign of [1, -1]) {
          const touching = scaled(place(wheels), sign)
          drawRod(sheet, scaled(touching, 1 - WHEEL), { weight: 3 }, "", near)
          if (isNear(touching) === near) drawWheel(sheet, touching, along, sign * way, LOOKS[wheels[6]])
        }
      }
      for (const [x, y, z, look, name] of rods) drawRod(sheet, place([x, y, z]), LOOKS[look], name, near)
      if (axis?.length === 3 && isNear(axis) === near) drawArrow(sheet, axis, label)
      ctx.globalAlpha = alpha
    },
    /** Paint the body between the far and the near half. @param {Sheet} sheet */
    middle(sheet) {
      if (held === null || !held.seen.length) return
      const { ctx, text, dark, scale, at, use } = sheet
      const { semi, hollow } = source.data
      if (hollow) {
        ctx.globalAlpha = 0.5
        use({ weight: 1.25 })
        circlePath(ctx, ...at([0, 0, 0]), CAVITY * scale)
        ctx.stroke()
        ctx.globalAlpha = 1
        drawBall(ctx, ...at([0, 0, INNER - CAVITY]), dark ? "#8A8F98" : "#9AA0AA", INNER * scale, text, 0.45)
        drawDisc(ctx, ...at([0, 0, -CAVITY]), 3.5, text)
      }
      solid.paint(sheet, held.seen, semi, Boolean(hollow))
    },
  }
}
