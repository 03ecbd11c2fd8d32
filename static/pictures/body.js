// A body as it lies in space: a solid ellipsoid in its principal axes, rods from its fixed point, the wheels of its
// constraint, the trail of one of its points, curves fixed in space: a guest of "sphere.js", which turns the picture.
// What is far of the body is painted before it, what is near after it; a rod begins where it leaves the surface.
//
// Space is seen with e to x and γ downwards, as gravity is for the potential −μ(r, γ).  The source that the option
// `attitude` names holds, along the orbit, the columns t, g1, g2, g3, e1, e2, e3: γ and e as seen from the body.  The
// picture's own source holds, all but the curves in the coordinates of the body,
//   axes [[x, y, z]] × 3, semi [3] and names [3]: principal axes, half the lengths of the ellipsoid along them, labels;
//   section [x, y, z, radius]: a circular section of it, by its normal;  rods [[x, y, z, look, label]];
//   wheels [x, y, z, ex, ey, ez]: where one touches the sphere, and e, along which it rolls; the other is opposite;
//   trail [x, y, z, look]: the point that leaves one;  hollow: whether the body is a ball of glass on a ball inside;
//   curves [[look, weight, xs, ys, zs]] in space, weight 0 for that of the look;  axis and label: of the arrow below.

import { circle } from "./circles.js"
import { LOOKS } from "./looks.js"
import { between } from "./moment.js"
import { covers, createSolid, dot, leaves } from "./solid.js"

const TRAIL = 160
const PIECES = 16
const WHEEL = 0.15
const THICK = 0.024
const CAVITY = 0.62
const INNER = 0.26
const BALL = 9

const cross = (u, v) => [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
const unit = (v) => v.map((x) => x / Math.hypot(...v))

export function bodyIn(source, attitude) {
  const solid = createSolid()
  let t = 0

  // What takes a direction of the body to space: γ and e orthonormal, whatever the straight lines between the samples
  // have made of them.
  function placing(columns, i, s) {
    const read = (name) => [1, 2, 3].map((k) => {
      const column = columns[name + k]
      return column[i] + (s && s * (column[i + 1] - column[i]))
    })
    const g = unit(read("g"))
    const raw = read("e")
    const along = dot(g, raw)
    const e = unit(raw.map((x, k) => x - along * g[k]))
    const f = cross(g, e)
    return (v) => [dot(v, e), -dot(v, f), -dot(v, g)]
  }

  // The body at t: placed once for both halves.
  function now({ view }) {
    const { t: times, ...columns } = attitude.data
    if (!(times?.length > 1)) return null
    const [i, s] = between(times, t)
    const place = placing(columns, i, s)
    const { axes = [], semi = [], trail = [] } = source.data
    const path = [[], [], []]
    if (trail.length) {
      const tip = trail.slice(0, 3)
      for (let j = Math.max(0, i - TRAIL); j <= i; j++) placing(columns, j, 0)(tip).forEach((x, k) => path[k].push(x))
      place(tip).forEach((x, k) => path[k].push(x))
    }
    return { place, placed: axes.map(place), seen: semi.length === 3 ? axes.map((axis) => view(place(axis))) : [], path }
  }

  // Adds to the path the disc of radius `size` about a place, as the unit circle across its axle, in space.
  function disc({ ctx, px, py }, [x, y, z], [X, Y, Z], size) {
    for (let i = 0; i < X.length; i++) {
      const at = [x + size * X[i], y + size * Y[i], z + size * Z[i]]
      if (i === 0) ctx.moveTo(px(at[0], at[1]), py(...at))
      else ctx.lineTo(px(at[0], at[1]), py(...at))
    }
    ctx.closePath()
  }

  function drawWheel(sheet, touching, e) {
    const { ctx, ratio, text, dark, depth } = sheet
    const axle = unit(cross(touching, e))
    const middle = touching.map((x) => (1 - WHEEL) * x)
    const side = depth(...axle) >= 0 ? THICK : -THICK
    ctx.setLineDash([])
    ctx.lineJoin = "round"
    ctx.strokeStyle = ctx.fillStyle = text
    ctx.lineWidth = 2.5 * ratio
    const rim = circle(axle, 0, 40)
    // The tread is what its discs cover: one path of all of them.
    ctx.beginPath()
    for (const at of [-1, -0.6, -0.2, 0.2, 0.6]) disc(sheet, middle.map((x, k) => x + at * side * axle[k]), rim, WHEEL)
    ctx.fill()
    ctx.stroke()
    const face = middle.map((x, k) => x + side * axle[k])
    ctx.fillStyle = dark ? "#C8C8C8" : "#EEE"
    ctx.beginPath()
    disc(sheet, face, rim, WHEEL)
    ctx.fill()
    ctx.stroke()
    ctx.fillStyle = text
    ctx.beginPath()
    disc(sheet, face, rim, 0.25 * WHEEL)
    ctx.fill()
  }

  function drawBall({ ctx, ratio, text }, x, y, colour, radius, plain = 0.62) {
    const light = ctx.createRadialGradient(x - 0.45 * radius, y - 0.5 * radius, 0, x - 0.1 * radius, y - 0.1 * radius,
      1.1 * radius)
    light.addColorStop(0, "white")
    light.addColorStop(0.35, colour)
    light.addColorStop(plain, colour)
    light.addColorStop(1, "#443")
    ctx.beginPath()
    ctx.arc(x, y, radius, 0, 2 * Math.PI)
    ctx.fillStyle = light
    ctx.fill()
    ctx.setLineDash([])
    ctx.lineWidth = 1.5 * ratio
    ctx.strokeStyle = text
    ctx.stroke()
  }

  function line({ ctx, ratio, text, px, py }, from, to, { colour, weight }) {
    ctx.setLineDash([])
    ctx.lineCap = "round"
    ctx.lineWidth = weight * ratio
    ctx.strokeStyle = colour ?? text
    ctx.beginPath()
    ctx.moveTo(px(from[0], from[1]), py(...from))
    ctx.lineTo(px(to[0], to[1]), py(...to))
    ctx.stroke()
    ctx.lineCap = "butt"
  }

  // From the sphere outwards, with the label beside its head.
  function drawArrow(sheet, along) {
    const { ctx, ratio, text, px, py, write } = sheet
    const [from, to] = [1.02, 1.15].map((far) => along.map((x) => far * x))
    line(sheet, from, to, LOOKS.axis)
    const [x, y] = [px(to[0], to[1]), py(...to)]
    const [dx, dy] = [x - px(from[0], from[1]), y - py(...from)]
    ctx.fillStyle = text
    if (Math.hypot(dx, dy) > 6 * ratio) {
      const angle = Math.atan2(dy, dx)
      ctx.beginPath()
      for (const [ahead, turned] of [[7, 0], [7, 2.4], [7, -2.4]]) {
        ctx.lineTo(x + ahead * ratio * Math.cos(angle + turned), y + ahead * ratio * Math.sin(angle + turned))
      }
      ctx.fill()
    }
    const label = source.data.label ?? ""
    write(label, x + 14 * ratio + ctx.measureText(label).width / 2, y)
  }

  let held = null
  return {
    set t(value) { t = value },
    // Before the far half, for all that follows.
    begin(sheet) { held = now(sheet) },
    paint(sheet, near) {
      const { ctx, ratio, text, px, py, depth, view, stroke, use, write } = sheet
      const { semi = [], names = [], section = [], rods = [], wheels = [], trail = [], curves = [] } = source.data
      const alpha = ctx.globalAlpha
      ctx.globalAlpha = near ? 1 : 0.45
      for (const [look, weight, ...curve] of curves) {
        use({ ...LOOKS[look], ...(weight && { weight }) })
        stroke(curve, near)
      }
      if (held === null) return
      const { place, placed, seen, path } = held
      if (trail.length) {
        use(LOOKS[trail[3]])
        const n = path[0].length
        const most = TRAIL / PIECES
        for (let k = 0; k < PIECES; k++) {
          // The newest piece ends at the point itself.
          const [from, to] = [Math.max(0, n - 1 - (k + 1) * most), n - 1 - k * most]
          if (to < 1) break
          const share = 1 - k / PIECES
          ctx.lineWidth = (1.2 + 2.3 * share) * ratio
          ctx.globalAlpha = (near ? 1 : 0.4) * share
          stroke(path.map((column) => column.slice(from, to + 1)), near)
        }
      }
      ctx.globalAlpha = 1
      // From the surface to its end, where it leaves on this side; its end where it is.
      const rod = (to, look, label, ball) => {
        const out = seen.length ? leaves(seen, semi, view(to)) : { at: 0, near: depth(...to) >= 0 }
        if (out.near !== near || out.at >= 1) return
        const from = to.map((x) => Math.min(1, out.at * 0.99) * x)
        line(sheet, from, to, look)
        const [x, y] = [px(to[0], to[1]), py(...to)]
        if (ball) drawBall(sheet, x, y, look.colour ?? text, BALL * ratio)
        ctx.fillStyle = text
        const far = 1 + 0.12 / Math.hypot(...to)
        const aside = ball ? 16 * ratio : 0
        const beyond = to.map((v) => far * v)
        const [right, up] = view(beyond)
        // What is half hidden cannot be read.
        if (!label || (!near && seen.length && covers(seen, semi, right, up, 0.05))) return
        write(label, px(beyond[0], beyond[1]) + aside, py(...beyond) - aside)
      }
      if (section.length === 4 && semi.length === 3 && near) {
        use({ ...LOOKS.second, weight: 2.5 })
        const ring = circle(place(section), 0, 192)
        const [radius, sides] = [section[3], [[], [], []]]
        for (let i = 0; i < ring[0].length; i++) {
          // The normal of the surface there: the line is seen where that points to the eye.
          const at = ring.map((column) => column[i])
          const shares = placed.map((axis, k) => dot(at, axis) / (semi[k] * semi[k]))
          const normal = [0, 1, 2].map((k) => placed.reduce((sum, axis, j) => sum + shares[j] * axis[k], 0))
          normal.forEach((x, k) => sides[k].push(x))
        }
        stroke(ring.map((column) => column.map((x) => radius * x)), true, sides)
      }
      placed.forEach((axis, k) => {
        if (!names[k] || semi.length !== 3) return
        const length = semi[k] + 0.1
        rod(axis.map((x) => length * x), { colour: null, weight: 2 }, names[k], false)
        rod(axis.map((x) => -length * x), { colour: null, weight: 2 }, "", false)
      })
      if (wheels.length === 6) {
        const e = place(wheels.slice(3))
        for (const sign of [1, -1]) {
          const touching = place(wheels.slice(0, 3)).map((x) => sign * x)
          rod(touching.map((x) => (1 - WHEEL) * x), { colour: null, weight: 3 }, "", false)
          if (depth(...touching) >= 0 === near) drawWheel(sheet, touching, e)
        }
      }
      for (const [x, y, z, look, label] of rods) rod(place([x, y, z]), LOOKS[look], label, look === "mass")
      if (source.data.axis?.length === 3 && depth(...source.data.axis) >= 0 === near) drawArrow(sheet, source.data.axis)
      ctx.globalAlpha = alpha
      ctx.fillStyle = text
    },
    // The body itself, between both halves.
    middle(sheet) {
      if (held === null || !held.seen.length) return
      const { ctx, ratio, text, dark, scale, px, py } = sheet
      const { semi, hollow } = source.data
      if (hollow) {
        const [bottom, centre] = [[0, 0, -CAVITY], [0, 0, INNER - CAVITY]]
        ctx.globalAlpha = 0.5
        ctx.lineWidth = 1.25 * ratio
        ctx.strokeStyle = text
        ctx.setLineDash([])
        ctx.beginPath()
        ctx.arc(px(0, 0), py(0, 0, 0), CAVITY * scale, 0, 2 * Math.PI)
        ctx.stroke()
        ctx.globalAlpha = 1
        drawBall(sheet, px(0, 0), py(...centre), dark ? "#8A8F98" : "#9AA0AA", INNER * scale, 0.45)
        ctx.beginPath()
        ctx.arc(px(0, 0), py(...bottom), 3.5 * ratio, 0, 2 * Math.PI)
        ctx.fillStyle = text
        ctx.fill()
      }
      solid.paint(sheet, held.seen, semi, Boolean(hollow))
    },
  }
}
