// The Poisson sphere: orthographic, on a 2D canvas.  Drag, arrow keys and touch turn it;
// what lies on the far side is drawn first and dimmed.
// Draws the tracks of its options from their sources (columns g1, g2, g3); its own source, of the picture's name, holds
// axis [3], label, circles [[axis, height, look]], marks [[γ, look, label]].  The option `clouds` names a source of
// clouds of points ("cloud.js").  With the option `attitude`, the name of a source, it is a sphere fixed in space with
// the body in it ("body.js"): `title` says what, and `bare` leaves the equator alone of the lines.

const LOOKS = {
  orbit: { colour: "#0072B2", dash: [], weight: 1.3 },
  second: { colour: "#CC79A7", dash: [], weight: 1.3 },
  stable: { colour: "#009E73", dash: [], weight: 3 },
  unstable: { colour: "#D55E00", dash: [7, 5], weight: 3 },
  limit: { colour: null, dash: [2, 3], weight: 1 },
  muted: { colour: "#808080", dash: [], weight: 1 },
  mass: { colour: "#F0E442", dash: [], weight: 3 },
}
const POINT = "#F0E442"
const RADIUS = 0.84
const STEP = Math.PI / 36

function circle(axis, height, count = 96) {
  // The circle (γ, axis) = height on the unit sphere.
  const [a, b, c] = axis
  const u = Math.abs(a) < 0.9 ? [0, c, -b] : [-c, 0, a]
  const length = Math.hypot(...u)
  const e = u.map((x) => x / length)
  const g = [b * e[2] - c * e[1], c * e[0] - a * e[2], a * e[1] - b * e[0]]
  const radius = Math.sqrt(Math.max(0, 1 - height * height))
  const points = [[], [], []]
  for (let i = 0; i <= count; i++) {
    const s = (2 * Math.PI * i) / count
    for (let k = 0; k < 3; k++) {
      points[k].push(height * axis[k] + radius * (Math.cos(s) * e[k] + Math.sin(s) * g[k]))
    }
  }
  return points
}

function graticule() {
  const lines = []
  for (const height of [-0.5, 0, 0.5]) lines.push(circle([0, 0, 1], height))
  for (let i = 0; i < 6; i++) {
    const s = (Math.PI * i) / 6
    lines.push(circle([Math.cos(s), Math.sin(s), 0], 0))
  }
  return lines
}

function sphere(el, options, source, signal, isShown) {
  const canvas = document.createElement("canvas")
  const inSpace = options.attitude !== undefined
  canvas.className = inSpace ? "solid" : "sphere"
  canvas.tabIndex = 0
  canvas.setAttribute("role", "application")
  canvas.setAttribute("aria-roledescription", "rotatable sphere")
  canvas.setAttribute("aria-label", `${options.title ?? "Poisson sphere"}: arrow keys turn it, Home turns it back`)
  el.append(canvas)
  const ctx = canvas.getContext("2d")
  const lines = options.bare ? [circle([0, 0, 1], 0)] : graticule()
  const home = [0.6, 0.35]
  let turn = home
  const begin = ({ az, el }) => { turn = [Number(az), Number(el)] }
  const look = () => document.dispatchEvent(new CustomEvent("hess:mounted", { detail: { kind: "client", show: begin } }))
  look()
  // The sphere of another scene may have been turned since.
  document.addEventListener("hess:enter", () => { if (isShown()) look() }, { signal })
  let point = null
  let requested = false
  let width = 0

  const own = source(options.name)
  // What is painted besides: {t: to be set, paint(…)}.
  const guest = options.clouds !== undefined ? sphereClouds(source(options.clouds))
    : inSpace ? bodyIn(own, source(options.attitude)) : null
  const columns = (name) => {
    const data = source(name).data
    return data.g1 ? [data.g1, data.g2, data.g3] : null
  }

  const painted = () => document.dispatchEvent(new CustomEvent("hess:canvas-painted", { detail: canvas }))

  function draw() {
    if (!requested) return
    requested = false
    const ratio = window.devicePixelRatio || 1
    const size = Math.round(width * ratio)
    if (size === 0) return void painted()
    if (canvas.width !== size) canvas.width = canvas.height = size
    const text = getComputedStyle(canvas).color
    const [az, elev] = turn
    const [ca, sa, ce, se] = [Math.cos(az), Math.sin(az), Math.cos(elev), Math.sin(elev)]
    const half = size / 2
    const scale = half * RADIUS
    const px = (x, y) => half + scale * (ca * y - sa * x)
    const py = (x, y, z) => half - scale * (ce * z - se * (ca * x + sa * y))
    const depth = (x, y, z) => ce * (ca * x + sa * y) + se * z

    // A curve, where it is on this side, or where the `sides` [xs, ys, zs] are.
    function stroke([X, Y, Z], near, [U, V, W] = [X, Y, Z]) {
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
    }

    function use({ colour, dash, weight }) {
      ctx.setLineDash(dash.map((d) => d * ratio))
      ctx.lineWidth = weight * ratio
      ctx.strokeStyle = colour ?? text
    }

    // Whole, also at the edge of the picture.
    function write(label, x, y) {
      const [across, down] = [ctx.measureText(label).width / 2, 8 * ratio]
      ctx.fillText(label, Math.min(Math.max(x, across), size - across), Math.min(Math.max(y, down), size - down))
    }

    function axis(x, y, z, label, near, aside = 0) {
      if (depth(x, y, z) >= 0 !== near) return
      ctx.beginPath()
      ctx.moveTo(px(x, y), py(x, y, z))
      ctx.lineTo(px(1.12 * x, 1.12 * y), py(1.12 * x, 1.12 * y, 1.12 * z))
      ctx.stroke()
      write(label, px(1.2 * x, 1.2 * y) + aside * ratio, py(1.2 * x, 1.2 * y, 1.2 * z) + aside * ratio)
    }

    function layer(near) {
      const alpha = near ? 1 : 0.3
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
        axis(1, 0, 0, "γ₁", near)
        axis(0, 1, 0, "γ₂", near)
        axis(0, 0, 1, "γ₃", near)
      }
      if (own.data.axis?.length === 3) axis(...own.data.axis, own.data.label, near, inSpace ? 0 : 13)
      for (const [a, b, c, height, look] of own.data.circles ?? []) {
        use(LOOKS[look])
        stroke(circle([a, b, c], height), near)
      }
      ctx.globalAlpha = alpha
      for (const [name, look] of Object.entries(options.tracks)) {
        const track = columns(name)
        if (track === null || track[0].length < 2) continue
        use(LOOKS[look])
        stroke(track, near)
      }
      guest?.paint(ctx, size, ratio, px, py, depth, near, stroke, use)
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
      if (point !== null && depth(...point) >= 0 === near) {
        ctx.beginPath()
        ctx.arc(px(point[0], point[1]), py(...point), 6.5 * ratio, 0, 2 * Math.PI)
        ctx.fillStyle = POINT
        ctx.fill()
        ctx.lineWidth = 1.5 * ratio
        ctx.strokeStyle = text
        ctx.stroke()
      }
    }

    ctx.clearRect(0, 0, size, size)
    layer(false)
    ctx.globalAlpha = 0.5
    ctx.lineWidth = ratio
    ctx.strokeStyle = text
    ctx.beginPath()
    ctx.arc(half, half, scale, 0, 2 * Math.PI)
    ctx.stroke()
    layer(true)
    ctx.globalAlpha = 1
    canvas.dataset.turn = turn.map((x) => x.toFixed(4)).join(" ")
    painted()
  }

  function request() {
    if (requested) return
    requested = true
    document.dispatchEvent(new CustomEvent("hess:canvas-invalid", { detail: canvas }))
    requestAnimationFrame(draw)
  }

  function rotate(azimuth, elevation) {
    const limit = Math.PI / 2
    const wrapped = Math.atan2(Math.sin(azimuth), Math.cos(azimuth))
    turn = [wrapped, Math.max(-limit, Math.min(limit, elevation))]
    document.dispatchEvent(new CustomEvent("hess:url", { detail: { az: turn[0].toFixed(4), el: turn[1].toFixed(4) } }))
    request()
  }

  let grabbed = null
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId)
    grabbed = [event.clientX, event.clientY, ...turn]
  })
  canvas.addEventListener("pointermove", (event) => {
    if (grabbed === null) return
    const perPixel = 2 / (width * RADIUS)
    rotate(grabbed[2] - (event.clientX - grabbed[0]) * perPixel, grabbed[3] + (event.clientY - grabbed[1]) * perPixel)
  })
  for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, () => { grabbed = null })
  canvas.addEventListener("keydown", (event) => {
    const moves = { ArrowLeft: [STEP, 0], ArrowRight: [-STEP, 0], ArrowUp: [0, STEP], ArrowDown: [0, -STEP] }
    if (event.key === "Home") rotate(...home)
    else if (event.key in moves) rotate(turn[0] + moves[event.key][0], turn[1] + moves[event.key][1])
    else return
    event.preventDefault()
    event.stopPropagation()
  })

  const onTime = (event) => {
    if (!isShown()) return
    const { t, state } = event.detail
    point = inSpace || state?.g1 === undefined ? null : ["g1", "g2", "g3"].map((name) => state[name])
    if (guest !== null) guest.t = t
    request()
  }
  document.addEventListener("hess:time", onTime, { signal })
  document.addEventListener("hess:paint", draw, { signal })
  const scheme = new MutationObserver(request)
  scheme.observe(document.documentElement, { attributes: true, attributeFilter: ["data-theme", "class", "style"] })
  scheme.observe(document.body, { attributes: true, attributeFilter: ["data-theme", "class", "style"] })
  const resize = new ResizeObserver(() => {
    width = canvas.clientWidth
    request()
  })
  resize.observe(canvas)
  const watched = [options.name, ...Object.keys(options.tracks), options.clouds, options.attitude]
  for (const name of watched) if (name !== undefined) source(name).watch(request, signal)
  request()
  signal.addEventListener("abort", () => {
    scheme.disconnect()
    resize.disconnect()
  })
}
