// The Poisson sphere: orthographic, on a 2D canvas.  Drag, arrow keys and touch turn it;
// what lies on the far side is drawn first and dimmed.
// Reads the Bokeh sources "data-orbit", "data-stable", "data-unstable" (columns g1, g2, g3).

const COLOURS = { orbit: "#0072B2", stable: "#009E73", unstable: "#D55E00", point: "#F0E442" }
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

export function render({ model, view, el }) {
  // Listeners go with the view: when it is removed, or rendered once more.
  view.living?.abort()
  view.living = new AbortController()
  model.on("remove", () => view.living.abort())
  const { signal } = view.living
  const canvas = document.createElement("canvas")
  canvas.className = "sphere"
  canvas.tabIndex = 0
  canvas.setAttribute("role", "application")
  canvas.setAttribute("aria-roledescription", "rotatable sphere")
  canvas.setAttribute("aria-label", "Poisson sphere: arrow keys turn it, Home turns it back")
  const tip = document.createElement("div")
  tip.className = "message"
  tip.setAttribute("role", "status")
  el.append(canvas, tip)
  const ctx = canvas.getContext("2d")
  const lines = graticule()
  const home = [0.6, 0.35]
  let turn = [model.azimuth, model.elevation]
  const begin = ({ az, el }) => { turn = [Number(az), Number(el)] }
  document.dispatchEvent(new CustomEvent("hess:mounted", { detail: { kind: "client", show: begin } }))
  let point = null
  let requested = false
  let width = 0

  const source = (name) => view.model.document?.get_model_by_name(`data-${name}`)
  const columns = (name) => {
    const data = source(name)?.data
    return data?.g1 ? [data.g1, data.g2, data.g3] : null
  }

  function draw() {
    if (!requested) return
    requested = false
    const ratio = window.devicePixelRatio || 1
    const size = Math.round(width * ratio)
    if (size === 0) return void document.dispatchEvent(new CustomEvent("hess:sphere-painted"))
    if (canvas.width !== size) canvas.width = canvas.height = size
    const text = getComputedStyle(canvas).color
    const [az, elev] = turn
    const [ca, sa, ce, se] = [Math.cos(az), Math.sin(az), Math.cos(elev), Math.sin(elev)]
    const half = size / 2
    const scale = half * RADIUS
    const px = (x, y) => half + scale * (ca * y - sa * x)
    const py = (x, y, z) => half - scale * (ce * z - se * (ca * x + sa * y))
    const depth = (x, y, z) => ce * (ca * x + sa * y) + se * z

    function stroke([X, Y, Z], near) {
      ctx.beginPath()
      let drawing = false
      for (let i = 1; i < X.length; i++) {
        const visible = depth(X[i] + X[i - 1], Y[i] + Y[i - 1], Z[i] + Z[i - 1]) >= 0 === near
        if (visible) {
          if (!drawing) ctx.moveTo(px(X[i - 1], Y[i - 1]), py(X[i - 1], Y[i - 1], Z[i - 1]))
          ctx.lineTo(px(X[i], Y[i]), py(X[i], Y[i], Z[i]))
        }
        drawing = visible
      }
      ctx.stroke()
    }

    function axis(x, y, z, label, near) {
      if (depth(x, y, z) >= 0 !== near) return
      ctx.beginPath()
      ctx.moveTo(px(x, y), py(x, y, z))
      ctx.lineTo(px(1.12 * x, 1.12 * y), py(1.12 * x, 1.12 * y, 1.12 * z))
      ctx.stroke()
      ctx.fillText(label, px(1.2 * x, 1.2 * y), py(1.2 * x, 1.2 * y, 1.2 * z))
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
      axis(1, 0, 0, "γ₁", near)
      axis(0, 1, 0, "γ₂", near)
      axis(0, 0, 1, "γ₃", near)
      if (model.axis.length === 3) {
        const [a, b, c] = model.axis
        axis(a, b, c, "n₃", near)
        ctx.setLineDash([2 * ratio, 3 * ratio])
        for (const height of model.heights) stroke(circle(model.axis, height), near)
        ctx.setLineDash([])
      }
      ctx.globalAlpha = alpha
      for (const [name, dash, weight] of [["orbit", [], 1.3], ["stable", [], 3], ["unstable", [7, 5], 3]]) {
        const track = columns(name)
        if (track === null || track[0].length < 2) continue
        ctx.setLineDash(dash.map((d) => d * ratio))
        ctx.lineWidth = weight * ratio
        ctx.strokeStyle = COLOURS[name]
        stroke(track, near)
      }
      ctx.setLineDash([])
      if (point !== null && depth(...point) >= 0 === near) {
        ctx.beginPath()
        ctx.arc(px(point[0], point[1]), py(...point), 6.5 * ratio, 0, 2 * Math.PI)
        ctx.fillStyle = COLOURS.point
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
    document.dispatchEvent(new CustomEvent("hess:sphere-painted"))
  }

  function request() {
    if (requested) return
    requested = true
    document.dispatchEvent(new CustomEvent("hess:sphere-invalid"))
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
    point = event.detail.state ? ["g1", "g2", "g3"].map((name) => event.detail.state[name]) : null
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
  const showMessage = () => { tip.textContent = model.message; tip.hidden = model.message === "" }
  model.on("message", showMessage)
  model.on("axis", request)
  model.on("heights", request)
  showMessage()
  // The sources belong to other pictures: they are in the document once all of it is built.
  const watch = () => {
    if (signal.aborted) return
    const found = ["orbit", "stable", "unstable"].map(source)
    if (found.some((item) => item == null)) return void requestAnimationFrame(watch)
    for (const item of found) item.change.connect(request)
    request()
  }
  watch()
  signal.addEventListener("abort", () => {
    scheme.disconnect()
    resize.disconnect()
  })
}
