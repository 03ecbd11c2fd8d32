// The Poisson sphere, orthographic.  Drag, arrow keys and touch turn it; what lies on the far side is drawn first and
// dimmed.
//
// It draws the tracks of its options from their sources (columns g1, g2, g3).  Its own source, of the picture's name,
// holds axis [3], label, circles [[axis, height, look]], marks [[γ, look, label]].  The option `clouds` names a source
// of clouds of points ("cloud.js").  With the option `attitude`, the name of a source, it is a sphere fixed in space
// with the body in it ("body.js"): `title` says what, and `bare` leaves of the lines only the equator.
// The moving point is seen on the far side too, with a dashed ring about it that says so.

import { listen, tell } from "../page/bus.js"
import { bodyIn } from "./body.js"
import { circle, graticule } from "./circles.js"
import { sphereClouds } from "./cloud_on_sphere.js"
import { FAINT } from "./ghost.js"
import { LOOKS, POINT } from "./looks.js"
import { squareCanvas } from "./square_canvas.js"

const RADIUS = 0.84
const STEP = Math.PI / 36
const HOME = [0.6, 0.35]
// Where a label goes whose place is taken: below, above, to the right, to the left.
const ASIDE = [[0, 0], [0, 1], [0, -1], [1, 0], [-1, 0], [1, 1], [-1, 1]]

// What everything on a sphere is drawn with: projection, depth towards the eye, lines and labels.
function createSheet(ctx, { size, ratio, text, dark }, [azimuth, elevation]) {
  const [ca, sa, ce, se] = [Math.cos(azimuth), Math.sin(azimuth), Math.cos(elevation), Math.sin(elevation)]
  const half = size / 2
  const scale = half * RADIUS
  const px = (x, y) => half + scale * (ca * y - sa * x)
  const py = (x, y, z) => half - scale * (ce * z - se * (ca * x + sa * y))
  const depth = (x, y, z) => ce * (ca * x + sa * y) + se * z
  // Where a label stands already: middle and half of its width.
  const taken = []
  return {
    ctx, size, ratio, text, dark, half, scale, px, py, depth,
    // To the right, upwards, towards the eye.
    view: ([x, y, z]) => [ca * y - sa * x, ce * z - se * (ca * x + sa * y), depth(x, y, z)],
    // A curve, where it is on this side, or where the `sides` [xs, ys, zs] are.
    stroke([X, Y, Z], near, [U, V, W] = [X, Y, Z]) {
      ctx.beginPath()
      let drawing = false
      for (let i = 1; i < X.length; i++) {
        const visible = depth(U[i] + U[i - 1], V[i] + V[i - 1], W[i] + W[i - 1]) >= 0 === near
        if (visible) {
          if (!drawing) ctx.moveTo(px(X[i - 1], Y[i - 1]), py(X[i - 1], Y[i - 1], Z[i - 1]))
          ctx.lineTo(px(X[i], Y[i]), py(X[i], Y[i], Z[i]))
        }
        drawing = visible
      }
      ctx.stroke()
    },
    use({ colour, dash, weight }) {
      ctx.setLineDash(dash.map((d) => d * ratio))
      ctx.lineWidth = weight * ratio
      ctx.strokeStyle = colour ?? text
    },
    // Whole, also at the edge of the picture, and beside any other label.
    write(label, x, y) {
      if (!label) return
      const [across, down] = [ctx.measureText(label).width / 2, 8 * ratio]
      const places = ASIDE.map(([a, b]) => [
        Math.min(Math.max(x + a * (across + 16 * ratio), across), size - across),
        // A little further than needed: sums are rounded.
        Math.min(Math.max(y + b * (2 * down + ratio), down), size - down)])
      const free = ([left, top]) => taken.every(([other, above, wide]) => (
        Math.abs(left - other) >= across + wide + 2 * ratio || Math.abs(top - above) >= 2 * down))
      const [left, top] = places.find(free) ?? places[0]
      taken.push([left, top, across])
      ctx.fillText(label, left, top)
    },
  }
}

export function sphere(el, options, source, signal, isShown) {
  const inSpace = options.attitude !== undefined
  const sheet = squareCanvas(el, {
    className: inSpace ? "solid" : "sphere", tabIndex: 0, role: "application", "aria-roledescription": "rotatable sphere",
    "aria-label": `${options.title ?? "Poisson sphere"}: arrow keys turn it, Home turns it back`,
    title: "Drag: it turns. So it does by arrow keys; Home turns it back",
  }, paint, signal)
  const { canvas, request } = sheet
  const lines = options.bare ? [circle([0, 0, 1], 0)] : graticule()
  let turn = HOME
  const beginTurn = (keys) => { turn = [Number(keys.az), Number(keys.el)] }
  const askForTurn = () => tell("mounted", { kind: "client", show: beginTurn })
  askForTurn()
  // The sphere of another scene may have been turned since.
  listen("enter", () => { if (isShown()) askForTurn() }, signal)
  let point = null

  const own = source(options.name)
  // What is painted besides: {t: to be set, paint(…)}.
  const guest = options.clouds !== undefined ? sphereClouds(source(options.clouds))
    : inSpace ? bodyIn(own, source(options.attitude)) : null
  const columns = (name) => {
    const { g1, g2, g3 } = source(name).data
    return g1 ? [g1, g2, g3] : null
  }

  function drawAxis({ ctx, px, py, depth, write }, [x, y, z], label, near) {
    if (depth(x, y, z) >= 0 !== near) return
    ctx.beginPath()
    ctx.moveTo(px(x, y), py(x, y, z))
    ctx.lineTo(px(1.12 * x, 1.12 * y), py(1.12 * x, 1.12 * y, 1.12 * z))
    ctx.stroke()
    write(label, px(1.2 * x, 1.2 * y), py(1.2 * x, 1.2 * y, 1.2 * z))
  }

  function drawMarks({ ctx, ratio, text, px, py, depth, write }, near) {
    ctx.setLineDash([])
    for (const [x, y, z, look, label] of own.data.marks ?? []) {
      if (depth(x, y, z) >= 0 !== near) continue
      ctx.beginPath()
      ctx.arc(px(x, y), py(x, y, z), 5 * ratio, 0, 2 * Math.PI)
      ctx.lineWidth = 2.5 * ratio
      ctx.strokeStyle = ctx.fillStyle = LOOKS[look].colour ?? text
      if (look !== "unstable") ctx.fill()
      ctx.stroke()
      ctx.fillStyle = text
      write(label, px(1.15 * x, 1.15 * y), py(1.15 * x, 1.15 * y, 1.15 * z))
    }
  }

  function drawPoint({ ctx, ratio, text, px, py, depth }) {
    if (point === null) return
    const [x, y] = [px(point[0], point[1]), py(...point)]
    const ring = (radius, dash) => {
      ctx.setLineDash(dash)
      ctx.beginPath()
      ctx.arc(x, y, radius * ratio, 0, 2 * Math.PI)
    }
    ctx.fillStyle = POINT
    ctx.lineWidth = 1.5 * ratio
    ctx.strokeStyle = text
    ring(6.5, [])
    ctx.fill()
    ctx.stroke()
    const behind = depth(...point) < 0
    if (!behind) return
    ring(11, [3.5 * ratio, 3.4 * ratio])
    ctx.stroke()
  }

  function drawHalf(on, near) {
    const { ctx, ratio, text, stroke, use } = on
    ctx.setLineDash([])
    ctx.lineWidth = ratio
    ctx.strokeStyle = ctx.fillStyle = text
    ctx.globalAlpha = near ? 0.3 : 0.12
    for (const line of lines) stroke(line, near)
    ctx.globalAlpha = near ? 0.9 : 0.4
    ctx.font = `${14 * ratio}px system-ui, sans-serif`
    ctx.textAlign = "center"
    ctx.textBaseline = "middle"
    if (!inSpace) {
      drawAxis(on, [1, 0, 0], "γ₁", near)
      drawAxis(on, [0, 1, 0], "γ₂", near)
      drawAxis(on, [0, 0, 1], "γ₃", near)
    }
    if (!inSpace && own.data.axis?.length === 3) drawAxis(on, own.data.axis, own.data.label, near)
    for (const [a, b, c, height, look] of own.data.circles ?? []) {
      use(LOOKS[look])
      stroke(circle([a, b, c], height), near)
    }
    ctx.globalAlpha = near ? 1 : 0.3
    for (const [name, look] of Object.entries(options.tracks)) {
      const track = columns(name)
      if (track === null || track[0].length < 2) continue
      use(LOOKS[look])
      stroke(track, near)
    }
    guest?.paint(on, near)
    drawMarks(on, near)
  }

  function paint(ctx, look) {
    const on = createSheet(ctx, look, turn)
    const { ratio, text } = look
    guest?.begin?.(on)
    drawHalf(on, false)
    ctx.globalAlpha = 0.5
    ctx.lineWidth = 1.5 * ratio
    ctx.strokeStyle = text
    ctx.beginPath()
    ctx.arc(on.half, on.half, on.scale, 0, 2 * Math.PI)
    ctx.stroke()
    guest?.middle?.(on)
    drawHalf(on, true)
    ctx.globalAlpha = 1
    drawPoint(on)
    canvas.dataset.turn = turn.map((x) => x.toFixed(4)).join(" ")
  }

  // Of an earlier state, its tracks: [look, [xs, ys, zs]].
  let kept = null
  let faint = null
  function paintGhost(ctx, look) {
    if (kept === null) return
    const on = createSheet(ctx, look, turn)
    for (const [name, track] of kept) {
      on.use(LOOKS[name])
      for (const near of [false, true]) {
        ctx.globalAlpha = near ? FAINT : 0.3 * FAINT
        on.stroke(track, near)
      }
    }
  }

  function rotate(azimuth, elevation) {
    const limit = Math.PI / 2
    const wrapped = Math.atan2(Math.sin(azimuth), Math.cos(azimuth))
    turn = [wrapped, Math.max(-limit, Math.min(limit, elevation))]
    tell("url", { az: turn[0].toFixed(4), el: turn[1].toFixed(4) })
    tell("turned", [options.name, ...turn])
    request()
    faint?.request()
  }

  let grabbed = null
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId)
    grabbed = [event.clientX, event.clientY, ...turn]
  })
  canvas.addEventListener("pointermove", (event) => {
    if (grabbed === null) return
    const perPixel = 2 / (sheet.width * RADIUS)
    rotate(grabbed[2] - (event.clientX - grabbed[0]) * perPixel, grabbed[3] + (event.clientY - grabbed[1]) * perPixel)
  })
  for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, () => { grabbed = null })
  canvas.addEventListener("keydown", (event) => {
    const moves = { ArrowLeft: [STEP, 0], ArrowRight: [-STEP, 0], ArrowUp: [0, STEP], ArrowDown: [0, -STEP] }
    if (event.key === "Home") rotate(...HOME)
    else if (event.key in moves) rotate(turn[0] + moves[event.key][0], turn[1] + moves[event.key][1])
    else return
    event.preventDefault()
    event.stopPropagation()
  })

  listen("turn", ([name, ...turned]) => {
    if (isShown() && name === options.name && turned.every(Number.isFinite)) rotate(...turned)
  }, signal)
  listen("time", ({ t, state }) => {
    if (!isShown()) return
    point = inSpace || state?.g1 === undefined ? null : [state.g1, state.g2, state.g3]
    if (guest !== null) guest.t = t
    request()
  }, signal)
  const watched = [options.name, ...Object.keys(options.tracks), options.clouds, options.attitude]
  for (const name of watched) if (name !== undefined) source(name).watch(request, signal)
  return {
    shoot: sheet.shoot,
    take: () => Object.entries(options.tracks).map(([name, look]) => [look, columns(name)])
      .filter(([, track]) => track !== null && track[0].length > 1),
    show(what) {
      if (what === kept) return
      kept = what
      faint ??= squareCanvas(el, { className: "ghost", "aria-hidden": "true" }, paintGhost, signal)
      faint.request()
    },
  }
}
