// @ts-check
// Parts of pictures in space: rods, balls, the centre of mass, wheels, the shadow, the arrow below, trails, the moving point.

import { circlePath, drawDisc, linePath, LOOKS, POINT } from "./looks.js"
import { outline } from "./solid.js"
import { circle, cross, plus, scaled, unit } from "./vectors.js"

// Radius of a wheel and half its thickness.
export const WHEEL = 0.15
const THICK = 0.024
const SPOKES = 5
// Number of steps of a trail.
export const TRAIL = 160

/**
 * Draw a straight line with round ends.
 * @param {Sheet} sheet
 * @param {Vector} from
 * @param {Vector} to
 * @param {Look} look
 */
export function drawLine({ ctx, line, use }, from, to, look) {
  use({ colour: look.colour, weight: look.weight })
  ctx.lineCap = "round"
  line(from, to)
  ctx.lineCap = "butt"
}

/**
 * Draw a ball that is lit from above.
 * @param {CanvasRenderingContext2D} ctx
 * @param {number} x
 * @param {number} y
 * @param {string} colour
 * @param {number} radius
 * @param {string} ink colour of the outline
 * @param {number} plain share of the radius where shading begins
 */
export function drawBall(ctx, x, y, colour, radius, ink, plain = 0.62) {
  const light = ctx.createRadialGradient(x - 0.45 * radius, y - 0.5 * radius, 0, x - 0.1 * radius, y - 0.1 * radius,
    1.1 * radius)
  light.addColorStop(0, "white")
  light.addColorStop(0.35, colour)
  light.addColorStop(plain, colour)
  light.addColorStop(1, "#443")
  drawDisc(ctx, x, y, radius, light)
  ctx.setLineDash([])
  ctx.lineWidth = 1.5
  ctx.strokeStyle = ink
  ctx.stroke()
}

/**
 * Draw a centre of mass: a disc in quarters, as in engineering drawings.
 * @param {CanvasRenderingContext2D} ctx
 * @param {number} x
 * @param {number} y
 * @param {number} radius
 * @param {string} ink
 * @param {boolean} dark
 */
export function drawMass(ctx, x, y, radius, ink, dark) {
  ctx.setLineDash([])
  ctx.lineWidth = 1.5
  ctx.strokeStyle = ink
  drawDisc(ctx, x, y, radius, dark ? "#121212" : "#FFFFFF")
  ctx.fillStyle = ink
  for (const quarter of [0, 2]) {
    ctx.beginPath()
    ctx.moveTo(x, y)
    ctx.arc(x, y, radius, (quarter - 1) * Math.PI / 2, quarter * Math.PI / 2)
    ctx.fill()
  }
  circlePath(ctx, x, y, radius)
  ctx.stroke()
}

/**
 * Draw the soft shadow of an ellipsoid on the ground below the sphere, in light from above, before everything else.
 * @param {Sheet} sheet
 * @param {Vector[]} axes in space
 * @param {number[]} semi
 */
export function drawShadow({ ctx, dark, half, px, py, at }, axes, semi) {
  const [x, y] = at([0, 0, -1])
  const [a, b] = [px(1, 0) - x, py(1, 0, -1) - y]
  const [c, d] = [px(0, 1) - x, py(0, 1, -1) - y]
  // The ground is invisible from below, and a line from the side.
  if (a * d - b * c > -1) return
  const { halves: [long, short], angle } = outline(axes, semi)
  ctx.save()
  ctx.transform(a, b, c, d, x, y)
  /** Fill a disc that fades outwards. @param {string} colour "red, green, blue" @param {number} alpha @param {number} size */
  const fade = (colour, alpha, size) => {
    const spot = ctx.createRadialGradient(0, 0, 0, 0, 0, size)
    for (const [share, part] of [[0, 1], [0.55, 0.85], [0.8, 0.35], [1, 0]]) {
      spot.addColorStop(share, `rgba(${colour}, ${alpha * part})`)
    }
    drawDisc(ctx, 0, 0, size, spot)
  }
  // On a dark page the ground has to be lit for a shadow to show.
  if (dark) fade("200, 215, 235", 0.09, 1.4)
  ctx.rotate(angle)
  ctx.scale(long, short)
  fade(dark ? "0, 0, 0" : "30, 36, 48", dark ? 0.24 : 0.13, 1.1)
  ctx.restore()
  // The shadow ends before the edge of the picture.
  const frame = ctx.createRadialGradient(half, half, 0.78 * half, half, half, half)
  frame.addColorStop(0, "#000")
  frame.addColorStop(1, "transparent")
  ctx.save()
  ctx.globalCompositeOperation = "destination-in"
  ctx.fillStyle = frame
  ctx.fillRect(0, 0, 2 * half, 2 * half)
  ctx.restore()
}

/**
 * Return the samples, with fractions, at which the marked spoke of a wheel touches the sphere.
 * @param {number[]} ways the way of the contact point at each sample
 */
export function turnsOf(ways) {
  const turn = 2 * Math.PI * WHEEL
  return ways.slice(1).flatMap((way, i) => {
    const [from, to] = [ways[i] / turn, way / turn]
    const whole = Math.floor(Math.max(from, to))
    return whole >= Math.min(from, to) && from !== to ? [i + (whole - from) / (to - from)] : []
  })
}

/**
 * Draw a wheel that rolls on the sphere without slipping; its coloured spoke touches after each turn.
 * @param {Sheet} sheet
 * @param {Vector} touching its contact point with the sphere
 * @param {Vector} along its rolling direction
 * @param {number} way how far the contact point has moved along
 * @param {Look} look of the coloured spoke and the contact point
 */
export function drawWheel({ ctx, text, dark, depth, at, use }, touching, along, way, look) {
  const axle = unit(cross(touching, along))
  const middle = scaled(touching, 1 - WHEEL)
  const side = depth(...axle) >= 0 ? THICK : -THICK
  const [X, Y, Z] = circle(axle, 0, 40)
  /** Add a disc to the path. @param {number} aside offset along the axle @param {number} radius */
  const disc = (aside, radius) => {
    const centre = plus(middle, axle, aside)
    for (let i = 0; i < X.length; i++) {
      const point = at(plus(centre, [X[i], Y[i], Z[i]], radius))
      if (i === 0) ctx.moveTo(...point)
      else ctx.lineTo(...point)
    }
    ctx.closePath()
  }
  /** @param {string} colour @param {number[]} asides @param {number} radius */
  const fill = (colour, asides, radius) => {
    ctx.fillStyle = colour
    ctx.beginPath()
    for (const aside of asides) disc(aside * side, radius)
    ctx.fill()
  }
  use({ weight: 2.5 })
  ctx.lineJoin = "round"
  // The tread is the union of its discs, in one path.
  fill(text, [-1, -0.6, -0.2, 0.2, 0.6], WHEEL)
  ctx.stroke()
  fill(dark ? "#3A3F47" : "#EEE", [1], WHEEL)
  ctx.stroke()
  const hub = plus(middle, axle, side)
  const out = unit(touching)
  for (let k = SPOKES - 1; k >= 0; k--) {
    // In the body the wheel turns against the way of its contact, by way / radius.
    const angle = 2 * Math.PI * k / SPOKES - way / WHEEL
    const spoke = plus(scaled(out, Math.cos(angle)), along, Math.sin(angle))
    use({ colour: k === 0 ? look.colour : null, weight: k === 0 ? 4 : 2 })
    ctx.beginPath()
    ctx.moveTo(...at(hub))
    ctx.lineTo(...at(plus(hub, spoke, 0.92 * WHEEL)))
    ctx.stroke()
  }
  fill(text, [1], 0.2 * WHEEL)
  drawDisc(ctx, ...at(touching), 4, look.colour)
}

/**
 * Draw an arrow outwards from the sphere, with a label beside its head.
 * @param {Sheet} sheet
 * @param {Vector} along
 * @param {string} label
 */
export function drawArrow(sheet, along, label) {
  const { ctx, text, at, write } = sheet
  const [from, to] = [scaled(along, 1.02), scaled(along, 1.15)]
  drawLine(sheet, from, to, LOOKS.axis)
  const [x0, y0] = at(from)
  const [x, y] = at(to)
  if (Math.hypot(x - x0, y - y0) > 6) {
    const angle = Math.atan2(y - y0, x - x0)
    ctx.fillStyle = text
    linePath(ctx, [0, 2.4, -2.4].map((turned) => [x + 7 * Math.cos(angle + turned), y + 7 * Math.sin(angle + turned)]))
    ctx.fill()
  }
  write(label, x + 14 + ctx.measureText(label).width / 2, y)
}

const TRAIL_PIECES = 16

/**
 * Draw a trail that fades and thins with age.
 * @param {Sheet} sheet
 * @param {Columns} path its last point is the newest
 * @param {Look} look
 * @param {boolean} near
 * @param {number[]} dots samples, with fractions, that get a dot
 */
export function drawTrail({ ctx, stroke, use, at, isNear }, path, look, near, dots = []) {
  use(look)
  const n = path[0].length
  const most = TRAIL / TRAIL_PIECES
  for (let k = 0; k < TRAIL_PIECES; k++) {
    // The last piece of the trail ends at the moving point.
    const [from, to] = [Math.max(0, n - 1 - (k + 1) * most), n - 1 - k * most]
    if (to < 1) break
    const share = 1 - k / TRAIL_PIECES
    ctx.lineWidth = 1.2 + 2.3 * share
    ctx.globalAlpha = (near ? 1 : 0.4) * share
    stroke(path.map((column) => Array.prototype.slice.call(column, from, to + 1)), near)
  }
  for (const dot of dots) {
    const i = Math.min(n - 2, Math.floor(dot))
    const point = path.map((column) => column[i] + (dot - i) * (column[i + 1] - column[i]))
    if (isNear(point) !== near) continue
    ctx.globalAlpha = (near ? 1 : 0.4) * Math.max(0, 1 - (n - 1 - dot) / TRAIL)
    drawDisc(ctx, ...at(point), 4, String(ctx.strokeStyle))
  }
}

/**
 * Draw the moving point; a dashed ring says that it is behind something.
 * @param {Sheet} sheet
 * @param {Vector} point
 * @param {boolean} near
 */
export function drawPoint({ ctx, at, use }, point, near) {
  use({ weight: 1.5 })
  drawDisc(ctx, ...at(point), 6.5, POINT)
  ctx.stroke()
  if (near) return
  use({ weight: 1.5, dash: [3.5, 3.4] })
  circlePath(ctx, ...at(point), 11)
  ctx.stroke()
}
