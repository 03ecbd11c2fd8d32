// A chart as a picture: coloured cells, axes, a bar of the colours, and where the state on show is.

import { element } from "../page/mount.js"
import { zoom } from "../page/presenting.js"
import { cellsPainter } from "./cells.js"
import { isDark, POINT, setDark } from "./looks.js"
import { tickLabels } from "./ticks.js"

// In units of the type's size.
const LEFT = 4.6
const RIGHT = 6.6
const TOP = 0.8
const BOTTOM = 3.6
const BAR = 1.1
// Cells along a side that come first, see "sweep/chart.py".
const COARSE = 24
// Of the numbers so many lie beyond each end of the colours: one that is far off would take all of them.
const BEYOND = 0.01
// Pixels that a click may slip.
const SLIP = 6

// About `count` round numbers from low to high.
function ticks(low, high, count) {
  const rough = (high - low) / count
  const power = 10 ** Math.floor(Math.log10(rough))
  const step = [1, 2, 5, 10].map((one) => one * power).find((one) => one >= rough)
  const found = []
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; i++) found.push(i * step)
  return found
}

// The colours' ends: all numbers but a few, and whether there are some beyond.
function endsOf(values) {
  const sorted = values.filter(Number.isFinite).sort()
  if (sorted.length === 0) return { low: 0, high: 1, isBelow: false, isAbove: false }
  const at = (share) => sorted[Math.round(share * (sorted.length - 1))]
  let [low, high] = [at(BEYOND), at(1 - BEYOND)]
  if (!(high > low)) [low, high] = [sorted[0], sorted[sorted.length - 1]]
  const isFlat = !(high > low)
  if (isFlat) {
    const room = Math.max(Math.abs(low) * 1e-6, 1e-9)
    ;[low, high] = [low - room, high + room]
  }
  return { low, high, isBelow: sorted[0] < low, isAbove: sorted[sorted.length - 1] > high }
}

// Every cell that is not computed looks like the nearest one that is, but no farther away than the coarse ones are.
function filled({ values, status, x: { count: columns }, y: { count: rows } }) {
  let coarse = 1
  while (Math.max(rows, columns) > COARSE * coarse) coarse *= 2
  const out = new Float32Array(values.length)
  const nearest = (i, step, count) => Math.min(Math.round(i / step) * step, Math.floor((count - 1) / step) * step)
  for (let row = 0; row < rows; row++) {
    for (let column = 0; column < columns; column++) {
      let at = row * columns + column
      const own = at
      for (let step = 2; status[at] === 0 && step <= coarse; step *= 2) {
        at = nearest(row, step, rows) * columns + nearest(column, step, columns)
      }
      out[own] = status[at] === 0 ? NaN : values[at]
    }
  }
  return out
}

const place = ({ low, high, count }, i) => low + (high - low) * i / (count - 1)
const stepOf = ({ low, high, count }) => (high - low) / (count - 1)

// hands: pointed([column, row] or null), chosen([column, row]), boxed({x: [low, high], y: [low, high]}).
// {canvas, show(chart), mark([x, y] or null, whether all else is as in the chart), cursor, moveTo, request()}.
// palettes: {plain, round}, the second for numbers that come round, as those that differ by a turn are the same.
export function chartCanvas(palettes, hands, signal) {
  const canvas = element("canvas", {
    className: "map", tabIndex: 0, role: "application", "aria-label": "Chart: arrow keys move, Enter opens the state, plus zooms, minus goes back",
  })
  const ctx = canvas.getContext("2d")
  let chart = null
  let mark = null
  let cursor = null
  let box = null
  let painter = null
  let colours = null
  let palette = palettes.plain
  let data = null
  let frame = null
  let requested = false

  const request = () => {
    if (requested) return
    requested = true
    requestAnimationFrame(draw)
  }

  function renew() {
    if (chart?.values == null) return
    const { turn } = chart
    palette = turn > 0 ? palettes.round : palettes.plain
    colours = turn > 0 ? { low: -turn / 2, high: turn / 2, isBelow: false, isAbove: false } : endsOf(chart.values)
    const numbers = filled(chart)
    const { x, y } = chart
    const [wide, high] = [stepOf(x), stepOf(y)]
    data = {
      image: [{ rows: y.count, columns: x.count, numbers }], x: [x.low - wide / 2], y: [y.low - high / 2],
      dw: [x.high - x.low + wide], dh: [y.high - y.low + high],
    }
    painter = cellsPainter([{ source: "chart", palette, ...colours }], () => ({ data }))
  }

  const scaleOf = (low, size, from, to) => ({ compute: (value) => from + (value - low) / size * (to - from) })
  const scales = () => [scaleOf(data.x[0], data.dw[0], frame.left, frame.right), scaleOf(data.y[0], data.dh[0], frame.bottom, frame.top)]

  function draw() {
    requested = false
    const { clientWidth: width, clientHeight: height } = canvas
    if (width === 0 || height === 0) return
    const ratio = window.devicePixelRatio || 1
    ;[canvas.width, canvas.height] = [Math.round(ratio * width), Math.round(ratio * height)]
    ctx.setTransform(ratio, 0, 0, ratio, 0, 0)
    const style = getComputedStyle(canvas)
    const ink = style.color
    setDark(isDark(ink))
    const em = Number.parseFloat(style.fontSize)
    frame = { left: LEFT * em, right: width - RIGHT * em, top: TOP * em, bottom: height - BOTTOM * em }
    ctx.font = `${0.9 * em}px system-ui, sans-serif`
    ctx.fillStyle = ctx.strokeStyle = ink
    ctx.lineWidth = 1
    if (data === null) return
    const [xs, ys] = scales()
    painter(ctx, xs, ys)
    ctx.fillStyle = ctx.strokeStyle = ink
    ctx.strokeRect(frame.left, frame.top, frame.right - frame.left, frame.bottom - frame.top)
    drawAxes(xs, ys, em)
    drawBar(em, ink)
    ctx.save()
    ctx.beginPath()
    ctx.rect(frame.left, frame.top, frame.right - frame.left, frame.bottom - frame.top)
    ctx.clip()
    drawMark(xs, ys, em, ink)
    drawCursor(xs, ys)
    if (box !== null) drawBox()
    ctx.restore()
  }

  function drawAxes(xs, ys, em) {
    const { x, y } = chart
    const [across, up] = [(frame.right - frame.left) / em, (frame.bottom - frame.top) / em]
    const alongX = ticks(x.low, x.high, Math.max(2, across / 5))
    const alongY = ticks(y.low, y.high, Math.max(2, up / 4))
    // Letters: of the horizontal ones there must be room for all.
    const [labelsX, labelsY] = [tickLabels(alongX, 1.5 * across), tickLabels(alongY, 1e9)]
    ctx.textAlign = "center"
    ctx.textBaseline = "top"
    alongX.forEach((tick, i) => {
      const at = xs.compute(tick)
      line(at, frame.bottom, at, frame.bottom + 0.35 * em)
      ctx.fillText(labelsX[i], at, frame.bottom + 0.5 * em)
    })
    ctx.fillText(x.symbol, (frame.left + frame.right) / 2, frame.bottom + 2 * em)
    ctx.textAlign = "right"
    ctx.textBaseline = "middle"
    alongY.forEach((tick, i) => {
      const at = ys.compute(tick)
      line(frame.left - 0.35 * em, at, frame.left, at)
      ctx.fillText(labelsY[i], frame.left - 0.5 * em, at)
    })
    ctx.save()
    ctx.translate(0.7 * em, (frame.top + frame.bottom) / 2)
    ctx.rotate(-Math.PI / 2)
    ctx.textAlign = "center"
    ctx.fillText(y.symbol, 0, 0)
    ctx.restore()
  }

  function drawBar(em) {
    const { low, high, isBelow, isAbove } = colours
    const left = frame.right + em
    const top = frame.top + 1.4 * em
    const size = frame.bottom - top
    palette.forEach((colour, i) => {
      ctx.fillStyle = colour
      ctx.fillRect(left, top + size * (1 - (i + 1) / palette.length), BAR * em, size / palette.length + 1)
    })
    ctx.fillStyle = ctx.strokeStyle
    ctx.strokeRect(left, top, BAR * em, size)
    const along = ticks(low, high, Math.max(3, size / em / 2.5))
    const labels = tickLabels(along, 1e9)
    ctx.textAlign = "left"
    ctx.textBaseline = "middle"
    along.forEach((tick, i) => {
      const at = top + size * (1 - (tick - low) / (high - low))
      line(left + BAR * em, at, left + (BAR + 0.3) * em, at)
      ctx.fillText(labels[i], left + (BAR + 0.45) * em, at)
    })
    ctx.textBaseline = "alphabetic"
    ctx.fillText(chart.symbol, left, frame.top + 0.9 * em)
    // That some numbers are beyond the colours.
    ctx.textAlign = "center"
    if (isAbove) ctx.fillText("▴", left + (BAR + 0.9) * em, frame.top + 1.3 * em)
    if (isBelow) ctx.fillText("▾", left + BAR * em / 2, frame.bottom + 0.9 * em)
  }

  function drawMark(xs, ys, em, ink) {
    if (mark === null) return
    const [at, up] = [xs.compute(mark.place[0]), ys.compute(mark.place[1])]
    for (const [colour, width] of [[isDark(ink) ? "#000" : "#fff", 4], [isDark(ink) ? POINT : "#101010", 2]]) {
      ctx.beginPath()
      ctx.arc(at, up, 0.55 * em * zoom(), 0, 2 * Math.PI)
      ctx.strokeStyle = colour
      ctx.lineWidth = width
      ctx.setLineDash(mark.isOfChart ? [] : [3, 3])
      ctx.stroke()
    }
    ctx.setLineDash([])
  }

  function drawCursor(xs, ys) {
    if (cursor === null) return
    const [wide, high] = [stepOf(chart.x), stepOf(chart.y)]
    const [x, y] = [place(chart.x, cursor[0]), place(chart.y, cursor[1])]
    const [left, right] = [xs.compute(x - wide / 2), xs.compute(x + wide / 2)]
    const [bottom, top] = [ys.compute(y - high / 2), ys.compute(y + high / 2)]
    for (const [colour, room] of [["#fff", 2], ["#101010", 1]]) {
      ctx.strokeStyle = colour
      ctx.lineWidth = 1
      ctx.strokeRect(left - room, top - room, right - left + 2 * room, bottom - top + 2 * room)
    }
  }

  function drawBox() {
    const [x0, y0, x1, y1] = box
    ctx.fillStyle = "rgba(255, 255, 255, 0.25)"
    ctx.fillRect(x0, y0, x1 - x0, y1 - y0)
    ctx.strokeStyle = "#101010"
    ctx.lineWidth = 1.5
    ctx.setLineDash([4, 3])
    ctx.strokeRect(x0, y0, x1 - x0, y1 - y0)
    ctx.setLineDash([])
  }

  function line(x0, y0, x1, y1) {
    ctx.beginPath()
    ctx.moveTo(x0, y0)
    ctx.lineTo(x1, y1)
    ctx.stroke()
  }

  // Where in the chart a place of the canvas is, within it.
  function valueAt(px, py) {
    const share = [(px - frame.left) / (frame.right - frame.left), (frame.bottom - py) / (frame.bottom - frame.top)]
    return [data.x[0] + data.dw[0] * share[0], data.y[0] + data.dh[0] * share[1]]
  }

  function cellAt(px, py) {
    if (data === null || frame === null) return null
    const [x, y] = valueAt(px, py)
    const [column, row] = [[chart.x, x], [chart.y, y]].map(([side, value]) => Math.round((value - side.low) / stepOf(side)))
    return column < 0 || row < 0 || column >= chart.x.count || row >= chart.y.count ? null : [column, row]
  }

  function moveTo(cell) {
    cursor = cell
    request()
    hands.pointed(cell)
  }

  let from = null
  canvas.addEventListener("pointerdown", ({ offsetX, offsetY, button, pointerId }) => {
    if (button !== 0 || cellAt(offsetX, offsetY) === null) return
    from = [offsetX, offsetY]
    canvas.setPointerCapture(pointerId)
  })
  canvas.addEventListener("pointermove", ({ offsetX, offsetY }) => {
    if (from !== null && Math.hypot(offsetX - from[0], offsetY - from[1]) > SLIP) box = [...from, offsetX, offsetY]
    moveTo(cellAt(offsetX, offsetY))
  })
  canvas.addEventListener("pointerup", ({ offsetX, offsetY }) => {
    const [begun, drawn] = [from, box]
    from = box = null
    request()
    if (begun === null) return
    if (drawn === null) {
      const cell = cellAt(offsetX, offsetY)
      if (cell === null) return
      moveTo(cell)
      hands.chosen(cell)
      return
    }
    const corners = [valueAt(drawn[0], drawn[1]), valueAt(drawn[2], drawn[3])]
    const within = ({ low, high }, i) => {
      const ends = corners.map((corner) => Math.min(high, Math.max(low, corner[i])))
      return [Math.min(...ends), Math.max(...ends)]
    }
    hands.boxed({ x: within(chart.x, 0), y: within(chart.y, 1) })
  })
  canvas.addEventListener("pointercancel", () => {
    from = box = null
    request()
  })
  canvas.addEventListener("pointerleave", () => { if (from === null) moveTo(null) })
  canvas.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, -1], ArrowUp: [0, 1] }[event.key]
    if (step === undefined || chart?.values == null) return
    event.preventDefault()
    const middle = [Math.floor(chart.x.count / 2), Math.floor(chart.y.count / 2)]
    const [column, row] = cursor ?? middle
    const far = event.shiftKey ? 10 : 1
    const within = (i, count) => Math.max(0, Math.min(count - 1, i))
    moveTo([within(column + far * step[0], chart.x.count), within(row + far * step[1], chart.y.count)])
  })
  const theme = new MutationObserver(request)
  for (const item of [document.documentElement, document.body]) {
    theme.observe(item, { attributes: true, attributeFilter: ["data-theme", "class", "style"] })
  }
  const resize = new ResizeObserver(request)
  resize.observe(canvas)
  signal.addEventListener("abort", () => {
    theme.disconnect()
    resize.disconnect()
  })

  return {
    canvas, request,
    get cursor() { return cursor },
    show(next) {
      if (chart !== next) cursor = null
      chart = next
      renew()
      request()
    },
    mark(place, isOfChart) {
      mark = place === null ? null : { place, isOfChart }
      request()
    },
  }
}
