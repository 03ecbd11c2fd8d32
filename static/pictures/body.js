// A body as it lies in space: an ellipsoid in its principal axes, rods to points of the unit sphere, and curves fixed in
// space: a guest of "sphere.js", which turns the picture and paints it in two halves, the far one first.
//
// Space is seen with e to x and γ downwards, as gravity is for the potential −μ(r, γ).  The source that the option
// `attitude` names holds, along the orbit, the columns t, g1, g2, g3, e1, e2, e3: γ and e as seen from the body.  The
// picture's own source holds, all but the curves in the coordinates of the body,
//   axes [[x, y, z]] × 3, semi [3] and names [3]: principal axes, half the lengths of the ellipsoid along them, labels;
//   section [x, y, z, radius]: a circular section of it, by its normal;  rods [[x, y, z, look, label]];
//   curves [[look, xs, ys, zs]] in space.

import { circle, graticule } from "./circles.js"
import { LOOKS } from "./looks.js"

const dot = (u, v) => u[0] * v[0] + u[1] * v[1] + u[2] * v[2]

export function bodyIn(source, attitude) {
  const lines = graticule()
  let t = 0

  // γ and e at t, orthonormal whatever the straight lines between the samples have made of them.
  function rows() {
    const { t: times, ...columns } = attitude.data
    if (!(times?.length > 1)) return null
    let i = 0
    let above = times.length - 1
    while (above - i > 1) {
      const middle = (i + above) >> 1
      if (times[middle] <= t) i = middle
      else above = middle
    }
    const s = Math.max(0, Math.min(1, (t - times[i]) / (times[i + 1] - times[i])))
    const read = (name) => [1, 2, 3].map((k) => {
      const column = columns[name + k]
      return column[i] + s * (column[i + 1] - column[i])
    })
    const unit = (v) => v.map((x) => x / Math.hypot(...v))
    const g = unit(read("g"))
    const raw = read("e")
    const along = dot(g, raw)
    return [g, unit(raw.map((x, k) => x - along * g[k]))]
  }

  return {
    set t(value) { t = value },
    paint({ ctx, ratio, text, px, py, depth, stroke, use }, near) {
      const { axes = [], semi = [], names = [], section = [], rods = [], curves = [] } = source.data
      const alpha = ctx.globalAlpha
      for (const [look, ...curve] of curves) {
        use(LOOKS[look])
        stroke(curve, near)
      }
      const held = rows()
      if (held === null) return
      const [g, e] = held
      const f = [g[1] * e[2] - g[2] * e[1], g[2] * e[0] - g[0] * e[2], g[0] * e[1] - g[1] * e[0]]
      const place = (v) => [dot(v, e), -dot(v, f), -dot(v, g)]
      const placed = axes.map(place)
      const moved = ([X, Y, Z], to) => {
        const out = [[], [], []]
        for (let i = 0; i < X.length; i++) to(X[i], Y[i], Z[i]).forEach((x, k) => out[k].push(x))
        return out
      }
      const combine = (x, y, z) => [0, 1, 2].map((k) => x * placed[0][k] + y * placed[1][k] + z * placed[2][k])

      if (semi.length === 3) {
        // The side of the surface that is seen is that whose normal points to the eye.
        const [a, b, c] = semi
        use(LOOKS.muted)
        for (const line of lines) {
          stroke(moved(line, (x, y, z) => combine(a * x, b * y, c * z)), near,
                 moved(line, (x, y, z) => combine(x / a, y / b, z / c)))
        }
      }
      if (section.length === 4) {
        use(LOOKS.second)
        const radius = section[3]
        stroke(moved(circle(place(section), 0), (x, y, z) => [radius * x, radius * y, radius * z]), near)
      }
      const rod = ([x, y, z], { colour, weight }, label, dotted) => {
        if (depth(x, y, z) >= 0 !== near) return
        ctx.setLineDash([])
        ctx.lineWidth = weight * ratio
        ctx.strokeStyle = colour ?? text
        ctx.beginPath()
        ctx.moveTo(px(0, 0), py(0, 0, 0))
        ctx.lineTo(px(x, y), py(x, y, z))
        ctx.stroke()
        if (dotted) {
          ctx.beginPath()
          ctx.arc(px(x, y), py(x, y, z), 6.5 * ratio, 0, 2 * Math.PI)
          ctx.fillStyle = colour ?? text
          ctx.fill()
          ctx.lineWidth = 1.5 * ratio
          ctx.strokeStyle = text
          ctx.stroke()
        }
        ctx.fillStyle = text
        const away = 1 + 0.12 / Math.hypot(x, y, z)
        ctx.fillText(label, px(away * x, away * y), py(away * x, away * y, away * z) - (dotted ? 14 * ratio : 0))
      }
      placed.forEach((axis, k) => {
        const length = (semi[k] ?? 0.8) * 1.1
        rod(axis.map((x) => length * x), LOOKS.limit, names[k] ?? "", false)
        rod(axis.map((x) => -length * x), LOOKS.limit, "", false)
      })
      for (const [x, y, z, look, label] of rods) rod(place([x, y, z]), LOOKS[look], label, true)
      ctx.globalAlpha = alpha
      ctx.fillStyle = text
    },
  }
}
