// Clouds of phase points: `cloudsOf(source)` moves them between the frames that the server has sent, and the pictures
// of kind "cloud" draw them over the (ω1, ω2)-plane, with the line of equilibria; "sphere.js" draws the same clouds.
//
// The source holds, for each of its clouds i, `frames<i>`: numbers [frame][column][point] at the even `times`, columns
// (x, y, γ1, γ2, γ3).  Without `signs<i>` x, y are ω1, ω2, of a motion with I13 = I23 = 0 in the field b3; with them
// they are (ω, ξ) and ln|s|, s = I13ω1 + I23ω2, without a field, and `signs<i>` the signs of s.
// `body` = [I11, I22, I13, I23, 𝒟, b3]; `sense`: 1, or −1 where the motion is seen backward in time.

class Cloud {
  constructor(frames, signs, body, times, sense) {
    Object.assign(this, { frames, signs, body, times, sense })
    this.count = frames.length / (5 * times.length)
    this.size = 5 * this.count
    this.step = times[1] - times[0]
    const column = () => new Float32Array(this.count)
    for (const name of ["w1", "w2", "g1", "g2", "g3", "x", "y"]) this[name] = column()
    // Both ends of an interval: slopes of x and y, and ω.
    this.ends = [0, 1].map(() => ({ x: column(), y: column(), w1: column(), w2: column() }))
    this.left = -1
    this.t = null
  }

  get axes() {
    const J = Math.hypot(this.body[2], this.body[3])
    return [J, this.body[2] / J, this.body[3] / J]
  }

  velocities(x, y, w1, w2) {
    if (this.signs === undefined) return void (w1.set(x), w2.set(y))
    const [J, n1, n2] = this.axes
    for (let i = 0; i < this.count; i++) {
      const across = (this.signs[i] * Math.exp(y[i])) / J
      w1[i] = n2 * x[i] + n1 * across
      w2[i] = n2 * across - n1 * x[i]
    }
  }

  // ω and the slopes of x and y at a frame, by `eq29`: ω̇ = s h with h = Î⁻¹(−ω2, ω1), so that d ln|s|/dt = (I13, I23)·h;
  // or Îω̇ = (b3γ2, −b3γ1).
  prepare(frame, end) {
    const { frames, count, size, signs, body } = this
    const [I11, I22, I13, I23, D, b3] = body
    const [, n1, n2] = this.axes
    const at = frame * size
    this.velocities(frames.subarray(at, at + count), frames.subarray(at + count, at + 2 * count), end.w1, end.w2)
    for (let i = 0; i < count; i++) {
      const [g1, g2, g3] = [frames[at + 2 * count + i], frames[at + 3 * count + i], frames[at + 4 * count + i]]
      const [a11, a12, a22] = [I11 + D * (g2 * g2 + g3 * g3), -D * g1 * g2, I22 + D * (g1 * g1 + g3 * g3)]
      const det = a11 * a22 - a12 * a12
      const free = signs !== undefined
      const [f1, f2] = free ? [-end.w2[i], end.w1[i]] : [b3 * g2, -b3 * g1]
      const [h1, h2] = [(a22 * f1 - a12 * f2) / det, (a11 * f2 - a12 * f1) / det]
      const s = free ? signs[i] * Math.exp(frames[at + count + i]) : 1
      end.x[i] = free ? s * (n2 * h1 - n1 * h2) : h1
      end.y[i] = free ? I13 * h1 + I23 * h2 : h2
    }
  }

  // Cubic curves between two frames, where all slopes are known: γ̇ = γ × ω.
  moveTo(t) {
    if (t === this.t) return
    this.t = t
    const { frames, count, size, times, step } = this
    const left = Math.max(0, Math.min(times.length - 2, Math.floor((t - times[0]) / step)))
    if (left !== this.left) {
      this.left = left
      this.prepare(left, this.ends[0])
      this.prepare(left + 1, this.ends[1])
    }
    const u = Math.max(0, Math.min(1, (t - times[left]) / step))
    const b = u * u * (3 - 2 * u)
    const a = 1 - b
    const [e, f] = [u * (1 - u) * (1 - u) * step * this.sense, u * u * (u - 1) * step * this.sense]
    const [from, to] = this.ends
    const at = left * size
    for (let i = 0; i < count; i++) {
      const p = at + i
      const q = p + size
      this.x[i] = a * frames[p] + b * frames[q] + e * from.x[i] + f * to.x[i]
      this.y[i] = a * frames[p + count] + b * frames[q + count] + e * from.y[i] + f * to.y[i]
      const [p1, p2, p3] = [frames[p + 2 * count], frames[p + 3 * count], frames[p + 4 * count]]
      const [q1, q2, q3] = [frames[q + 2 * count], frames[q + 3 * count], frames[q + 4 * count]]
      const [v1, v2, w1, w2] = [from.w1[i], from.w2[i], to.w1[i], to.w2[i]]
      const g1 = a * p1 + b * q1 - e * p3 * v2 - f * q3 * w2
      const g2 = a * p2 + b * q2 + e * p3 * v1 + f * q3 * w1
      const g3 = a * p3 + b * q3 + e * (p1 * v2 - p2 * v1) + f * (q1 * w2 - q2 * w1)
      const inverse = 1 / Math.sqrt(g1 * g1 + g2 * g2 + g3 * g3)
      this.g1[i] = g1 * inverse
      this.g2[i] = g2 * inverse
      this.g3[i] = g3 * inverse
    }
    this.velocities(this.x, this.y, this.w1, this.w2)
  }
}

const allClouds = new WeakMap()

// The clouds of a source, for all pictures that draw them; `at(t)` gives them at that time, each moved once.
function cloudsOf(source) {
  if (allClouds.has(source)) return allClouds.get(source)
  let [data, clouds] = [null, []]
  const at = (t) => {
    if (data !== source.data) {
      data = source.data
      clouds = [0, 1].filter((i) => data[`frames${i}`]?.length > 0).map((i) => (
        new Cloud(data[`frames${i}`], data[`signs${i}`], data.body, data.times, data.sense)))
    }
    for (const cloud of clouds) cloud.moveTo(t)
    return clouds
  }
  allClouds.set(source, { at })
  return allClouds.get(source)
}

const CLOUD_COLOURS = [[0, 114, 178], [204, 121, 167]]

// A transparent layer of points, each a small square: where many lie together it is opaque.
function pointLayer() {
  const sheet = document.createElement("canvas")
  const paper = sheet.getContext("2d")
  let pixels = null
  return {
    begin(size, [red, green, blue]) {
      if (sheet.width !== size || pixels === null) {
        sheet.width = sheet.height = size
        pixels = paper.createImageData(size, size)
      }
      // Bytes in the order of memory, as all browsers' machines have it: alpha last.
      new Uint32Array(pixels.data.buffer).fill((blue << 16) | (green << 8) | red)
    },
    add(x, y, side, alpha) {
      const size = sheet.width
      const [left, top] = [Math.round(x - side / 2), Math.round(y - side / 2)]
      if (!(left >= 0 && top >= 0 && left + side <= size && top + side <= size)) return
      for (let row = 0; row < side; row++) {
        const at = 4 * ((top + row) * size + left) + 3
        for (let i = 0; i < side; i++) pixels.data[at + 4 * i] += alpha
      }
    },
    end(ctx) {
      paper.putImageData(pixels, 0, 0)
      ctx.drawImage(sheet, 0, 0)
    },
  }
}

const sideOf = (ratio) => Math.round(1.6 * ratio)
const alphaOf = (cloud) => Math.max(110, Math.min(230, 1_100_000 / cloud.count))

// For "sphere.js": paint(ctx, size, ratio, project, depth, near) draws the half of the points that is near, or far.
function sphereClouds(source) {
  const clouds = cloudsOf(source)
  const layer = pointLayer()
  let t = 0
  return {
    set t(value) { t = value },
    paint(ctx, size, ratio, px, py, depth, near) {
      clouds.at(t).forEach((cloud, k) => {
        const { count, g1, g2, g3 } = cloud
        const [side, alpha] = [sideOf(ratio), alphaOf(cloud)]
        layer.begin(size, CLOUD_COLOURS[k])
        for (let i = 0; i < count; i++) {
          const [x, y, z] = [g1[i], g2[i], g3[i]]
          if (depth(x, y, z) >= 0 === near) layer.add(px(x, y), py(x, y, z), side, alpha)
        }
        layer.end(ctx)
      })
    },
  }
}

const MARGIN = { left: 46, right: 8, top: 8, bottom: 42 }

// The (ω1, ω2)-plane.  Besides the clouds its source holds `half`, the axes' ± range, `curves` [[look, xs, ys]] and
// `points` [[look, x, y]], and `bins` = [first, width, count] of ln|s|: the density over |s| at the moving time goes to
// the source that the option `density` names.
function cloudPlane(el, options, source, signal, isShown) {
  const canvas = document.createElement("canvas")
  canvas.className = "sphere cloud"
  canvas.style.cursor = "crosshair"
  canvas.setAttribute("role", "img")
  canvas.setAttribute("aria-label", "Cloud of phase points on the plane of ω₁ and ω₂")
  el.append(canvas)
  const ctx = canvas.getContext("2d")
  const own = source(options.name)
  const clouds = cloudsOf(own)
  const layer = pointLayer()
  let [t, width, half, requested] = [0, 0, 1, false]
  const painted = () => document.dispatchEvent(new CustomEvent("hess:canvas-painted", { detail: canvas }))
  // For whoever wants to know where the points are, such as the tests.
  canvas.clouds = () => clouds.at(t)

  function place() {
    const [w, h] = [width - MARGIN.left - MARGIN.right, width - MARGIN.top - MARGIN.bottom]
    half = own.data.half ?? half
    return {
      w, h, half, x: (a) => MARGIN.left + (w * (a + half)) / (2 * half), y: (b) => MARGIN.top + (h * (half - b)) / (2 * half),
    }
  }

  function drawAxes({ w, h, half, x, y }, text) {
    ctx.globalAlpha = 0.4
    ctx.lineWidth = 1
    ctx.strokeStyle = ctx.fillStyle = text
    ctx.setLineDash([])
    ctx.strokeRect(MARGIN.left, MARGIN.top, w, h)
    ctx.font = "12px system-ui, sans-serif"
    for (const share of [-1, -0.5, 0, 0.5, 1]) {
      const value = share * half
      const label = String(Number(value.toPrecision(3))).replace("-", "−")
      ctx.globalAlpha = 0.4
      ctx.beginPath()
      ctx.moveTo(x(value), MARGIN.top + h)
      ctx.lineTo(x(value), MARGIN.top + h + 5)
      ctx.moveTo(MARGIN.left - 5, y(value))
      ctx.lineTo(MARGIN.left, y(value))
      ctx.stroke()
      ctx.globalAlpha = 0.75
      ctx.textAlign = share === 1 ? "right" : "center"
      ctx.textBaseline = "top"
      ctx.fillText(label, x(value), MARGIN.top + h + 7)
      ctx.textAlign = "right"
      ctx.textBaseline = share === 1 ? "top" : "middle"
      ctx.fillText(label, MARGIN.left - 7, y(value))
    }
    ctx.globalAlpha = 1
    ctx.font = "14px system-ui, sans-serif"
    ctx.textAlign = "center"
    ctx.textBaseline = "alphabetic"
    ctx.fillText("ω₁", x(0), MARGIN.top + h + 37)
    ctx.save()
    ctx.translate(12, y(0))
    ctx.rotate(-Math.PI / 2)
    ctx.fillText("ω₂", 0, 0)
    ctx.restore()
  }

  function drawLines({ x, y }, text) {
    for (const [look, xs, ys] of own.data.curves ?? []) {
      const { colour, dash, weight } = LOOKS[look]
      ctx.setLineDash(dash)
      ctx.lineWidth = weight
      ctx.strokeStyle = colour ?? text
      ctx.beginPath()
      for (let i = 0; i < xs.length; i++) ctx.lineTo(x(xs[i]), y(ys[i]))
      ctx.stroke()
    }
    ctx.setLineDash([])
    for (const [look, a, b] of own.data.points ?? []) {
      ctx.lineWidth = 2.5
      ctx.strokeStyle = ctx.fillStyle = LOOKS[look].colour
      ctx.beginPath()
      ctx.arc(x(a), y(b), 5, 0, 2 * Math.PI)
      if (look !== "unstable") ctx.fill()
      ctx.stroke()
    }
  }

  function draw() {
    if (!requested) return
    requested = false
    const ratio = window.devicePixelRatio || 1
    const size = Math.round(width * ratio)
    if (size === 0) return void painted()
    if (canvas.width !== size) canvas.width = canvas.height = size
    const text = getComputedStyle(canvas).color
    const here = place()
    ctx.setTransform(1, 0, 0, 1, 0, 0)
    ctx.clearRect(0, 0, size, size)
    ctx.scale(ratio, ratio)
    drawAxes(here, text)
    ctx.save()
    ctx.beginPath()
    ctx.rect(MARGIN.left, MARGIN.top, here.w, here.h)
    ctx.clip()
    ctx.save()
    ctx.setTransform(1, 0, 0, 1, 0, 0)
    clouds.at(t).forEach((cloud, k) => {
      const { count, w1, w2 } = cloud
      const [side, alpha] = [sideOf(ratio), alphaOf(cloud)]
      layer.begin(size, CLOUD_COLOURS[k])
      for (let i = 0; i < count; i++) layer.add(ratio * here.x(w1[i]), ratio * here.y(w2[i]), side, alpha)
      layer.end(ctx)
    })
    ctx.restore()
    drawLines(here, text)
    ctx.restore()
    painted()
  }

  function request() {
    if (requested) return
    requested = true
    document.dispatchEvent(new CustomEvent("hess:canvas-invalid", { detail: canvas }))
    requestAnimationFrame(draw)
  }

  // Points per unit of |s|, in bins that are even in ln|s|.
  function showDensity() {
    const [cloud] = clouds.at(t)
    if (cloud === undefined) return void source(options.density).put({ x: [], y: [] })
    const [first, wide, count] = own.data.bins
    const counts = new Float64Array(count)
    for (let i = 0; i < cloud.count; i++) counts[Math.floor((cloud.y[i] - first) / wide)] += 1
    const [x, y] = [[], []]
    counts.forEach((found, k) => {
      if (found === 0) return
      const s = Math.exp(first + (k + 0.5) * wide)
      x.push(s)
      y.push(found / (cloud.count * wide * s))
    })
    source(options.density).put({ x, y })
  }

  canvas.addEventListener("click", (event) => {
    const { w, h, half } = place()
    const box = canvas.getBoundingClientRect()
    const a = ((event.clientX - box.left - MARGIN.left) / w) * 2 * half - half
    const b = half - ((event.clientY - box.top - MARGIN.top) / h) * 2 * half
    document.dispatchEvent(new CustomEvent("hess:pick", { detail: { pick: [options.name, a, b], drag: false } }))
  })
  const refresh = () => {
    request()
    showDensity()
  }
  document.addEventListener("hess:time", (event) => {
    if (!isShown()) return
    t = event.detail.t
    refresh()
  }, { signal })
  document.addEventListener("hess:paint", draw, { signal })
  const scheme = new MutationObserver(request)
  for (const item of [document.documentElement, document.body]) {
    scheme.observe(item, { attributes: true, attributeFilter: ["data-theme", "class", "style"] })
  }
  const resize = new ResizeObserver(() => {
    width = canvas.clientWidth
    request()
  })
  resize.observe(canvas)
  own.watch(refresh, signal)
  request()
  signal.addEventListener("abort", () => {
    scheme.disconnect()
    resize.disconnect()
  })
}
