// Clouds of phase points on the (ω1, ω2)-plane, with the line of equilibria.
//
// Besides the clouds ("cloud.js") its source holds `half`, the axes' ± range, `curves` [[look, xs, ys]], `points`
// [[look, x, y]], and `bins` = [first, width, count] of ln|s|: the density over |s| at the moving time goes to the
// source that the option `density` names.

import { listen, tell } from "../page/bus.js"
import { zoom } from "../page/presenting.js"
import { cloudsOf } from "./cloud.js"
import { CLOUDS, LOOKS } from "./looks.js"
import { alphaOf, pointLayer, sideOf } from "./point_layer.js"
import { squareCanvas } from "./square_canvas.js"

const MARGIN = { left: 46, right: 8, top: 8, bottom: 42 }

export function cloudPlane(el, options, source, signal, isShown) {
  const own = source(options.name)
  const clouds = cloudsOf(own)
  const layer = pointLayer()
  const sheet = squareCanvas(el, {
    className: "sphere cloud", role: "img", "aria-label": "Cloud of phase points on the plane of ω₁ and ω₂",
  }, paint, signal)
  let t = 0
  // The axes stay while there are no clouds.
  let range = 1

  function place() {
    const edge = sheet.width / zoom()
    const [w, h] = [edge - MARGIN.left - MARGIN.right, edge - MARGIN.top - MARGIN.bottom]
    range = own.data.half ?? range
    const half = range
    return {
      w, h, half, x: (a) => MARGIN.left + (w * (a + half)) / (2 * half), y: (b) => MARGIN.top + (h * (half - b)) / (2 * half),
    }
  }

  function drawAxes(ctx, { w, h, half, x, y }, text) {
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

  function drawClouds(ctx, here, size, ratio) {
    clouds.at(t).forEach((cloud, k) => {
      const { count, w1, w2 } = cloud
      const [side, alpha] = [sideOf(ratio), alphaOf(cloud)]
      layer.begin(size, CLOUDS[k])
      for (let i = 0; i < count; i++) layer.add(ratio * here.x(w1[i]), ratio * here.y(w2[i]), side, alpha)
      layer.end(ctx)
    })
  }

  function drawLines(ctx, { x, y }, text) {
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

  function paint(ctx, { size, ratio, text }) {
    const here = place()
    ctx.scale(ratio, ratio)
    drawAxes(ctx, here, text)
    ctx.save()
    ctx.beginPath()
    ctx.rect(MARGIN.left, MARGIN.top, here.w, here.h)
    ctx.clip()
    // Over the points of rest: there all of a cloud may end.
    drawLines(ctx, here, text)
    ctx.save()
    ctx.setTransform(1, 0, 0, 1, 0, 0)
    drawClouds(ctx, here, size, ratio)
    ctx.restore()
    ctx.restore()
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

  sheet.canvas.addEventListener("click", (event) => {
    const { w, h, half } = place()
    const box = sheet.canvas.getBoundingClientRect()
    const a = (((event.clientX - box.left) / zoom() - MARGIN.left) / w) * 2 * half - half
    const b = half - (((event.clientY - box.top) / zoom() - MARGIN.top) / h) * 2 * half
    tell("pick", { pick: [options.name, a, b], drag: false })
  })
  const refresh = () => {
    sheet.request()
    showDensity()
  }
  listen("time", (now) => {
    if (!isShown()) return
    t = now.t
    refresh()
  }, signal)
  own.watch(refresh, signal)
  return { shoot: sheet.shoot }
}
