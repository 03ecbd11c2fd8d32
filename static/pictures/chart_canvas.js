// Draws a chart: coloured cells, axes, a colour bar, and a ring at the state on show.  The pointer and the arrow keys move
// a cursor from cell to cell (the hit test is `cellAt`); a drag draws a box.

import { onDrag } from "../page/drag.js"
import { arrowOf } from "../page/keys.js"
import { zoom } from "../page/presenting.js"
import { liveCanvas } from "./canvas.js"
import { cellsPainter } from "./cells.js"
import { coloursOf, filled } from "./chart_colours.js"
import { circlePath, POINT } from "./looks.js"
import { drawTicks, roundNumbers, tickLabels } from "./ticks.js"

// In units of the type's size.
const LEFT = 4.6
const RIGHT = 6.6
const TOP = 0.8
const BOTTOM = 3.6
const BAR = 1.1
// Pixels that a click may slip.
const SLIP = 6
const DARK = "#101010"

const stepOf = ({ low, high, count }) => (high - low) / (count - 1)
const within = (value, low, high) => Math.max(low, Math.min(high, value))

// From values to a line of the canvas.
const scaleOf = (low, size, from, to) => ({
  compute: (value) => from + (value - low) / size * (to - from), invert: (at) => low + (at - from) / (to - from) * size,
})

const labelled = (ticks, scale, letters = 1e9) => {
  const labels = tickLabels(ticks, letters)
  return ticks.map((tick, i) => [scale.compute(tick), labels[i]])
}

function drawBox(ctx, [x0, y0, x1, y1]) {
  ctx.fillStyle = "rgba(255, 255, 255, 0.25)"
  ctx.fillRect(x0, y0, x1 - x0, y1 - y0)
  ctx.strokeStyle = DARK
  ctx.lineWidth = 1.5
  ctx.setLineDash([4, 3])
  ctx.strokeRect(x0, y0, x1 - x0, y1 - y0)
}

/**
 * Return {canvas, show(chart), mark([x, y] or null, whether all else is as in the chart), cursor}.
 * @param {{plain: string[], round: string[]}} palettes `round` for numbers that differ by turns
 * @param {{pointed: (cell: number[] | null) => void, chosen: (cell: number[]) => void, boxed: (box: {x: number[], y: number[]}) => void}} handlers
 *   hear of [column, row], and of a box as [low, high] on both sides
 */
export function chartCanvas(palettes, handlers) {
  let chart = null
  let mark = null
  let cursor = null
  /** @type {any} */
  let box = null
  // {palette, low, high, isBelow, isAbove, painter}
  /** @type {any} */
  let colours = null
  // A layer of cells, see "cells.js".
  /** @type {any} */
  let data = null
  // {frame, xs, ys: from values to the canvas}
  /** @type {any} */
  let place = null

  const { canvas, request } = liveCanvas("map", {
    tabIndex: 0, role: "application",
    ariaLabel: "Chart: arrow keys move, Enter opens the state, plus zooms, minus goes back",
    onpointermove: (event) => moveTo(cellAt(event)), onpointerleave: () => { if (box === null) moveTo(null) },
    onkeydown(event) {
      const arrow = arrowOf(event)
      if (arrow === undefined || chart?.values == null) return
      event.preventDefault()
      const sides = [chart.x, chart.y]
      const from = cursor ?? sides.map(({ count }) => Math.floor(count / 2))
      const far = event.shiftKey ? 10 : 1
      moveTo(sides.map(({ count }, k) => within(from[k] + far * arrow[k], 0, count - 1)))
    },
  }, paint)

  function renew() {
    if (chart?.values == null) return
    const { x, y, turn } = chart
    const [wide, high] = [stepOf(x), stepOf(y)]
    data = {
      image: [{ rows: y.count, columns: x.count, numbers: filled(chart) }], x: [x.low - wide / 2], y: [y.low - high / 2],
      dw: [x.high - x.low + wide], dh: [y.high - y.low + high],
    }
    const own = { palette: turn > 0 ? palettes.round : palettes.plain, ...coloursOf(chart) }
    colours = { ...own, painter: cellsPainter([{ source: "chart", ...own }], () => ({ data })) }
  }

  function paint(ctx, { width, height, text, dark }) {
    if (data === null) return
    const em = Number.parseFloat(getComputedStyle(canvas).fontSize)
    const frame = { left: LEFT * em, right: width - RIGHT * em, top: TOP * em, bottom: height - BOTTOM * em }
    const xs = scaleOf(data.x[0], data.dw[0], frame.left, frame.right)
    const ys = scaleOf(data.y[0], data.dh[0], frame.bottom, frame.top)
    place = { frame, xs, ys }
    colours.painter(ctx, xs, ys)
    ctx.font = `${0.9 * em}px system-ui, sans-serif`
    ctx.fillStyle = ctx.strokeStyle = text
    const edges = [frame.left, frame.top, frame.right - frame.left, frame.bottom - frame.top]
    ctx.strokeRect(...edges)
    drawAxes(ctx, em)
    drawBar(ctx, em)
    ctx.beginPath()
    ctx.rect(...edges)
    ctx.clip()
    if (mark !== null) drawMark(ctx, em, dark)
    if (cursor !== null) drawCursor(ctx)
    if (box !== null) drawBox(ctx, box)
  }

  function drawAxes(ctx, em) {
    const { x, y } = chart
    const { frame, xs, ys } = place
    const [across, up] = [(frame.right - frame.left) / em, (frame.bottom - frame.top) / em]
    drawTicks(ctx, frame,
      // Letters: of the horizontal ones there must be room for all.
      labelled(roundNumbers(x.low, x.high, Math.max(2, across / 5)), xs, 1.5 * across),
      labelled(roundNumbers(y.low, y.high, Math.max(2, up / 4)), ys), { length: 0.35 * em, gap: 0.5 * em })
    ctx.textAlign = "center"
    ctx.textBaseline = "top"
    ctx.fillText(x.symbol, (frame.left + frame.right) / 2, frame.bottom + 2 * em)
    ctx.save()
    ctx.translate(0.7 * em, (frame.top + frame.bottom) / 2)
    ctx.rotate(-Math.PI / 2)
    ctx.textBaseline = "middle"
    ctx.fillText(y.symbol, 0, 0)
    ctx.restore()
  }

  function drawBar(ctx, em) {
    const { low, high, isBelow, isAbove, palette } = colours
    const { frame } = place
    const left = frame.right + em
    const right = left + BAR * em
    const top = frame.top + 1.4 * em
    const size = frame.bottom - top
    palette.forEach((colour, i) => {
      ctx.fillStyle = colour
      ctx.fillRect(left, top + size * (1 - (i + 1) / palette.length), BAR * em, size / palette.length + 1)
    })
    ctx.fillStyle = ctx.strokeStyle
    ctx.strokeRect(left, top, BAR * em, size)
    ctx.textAlign = "left"
    ctx.textBaseline = "middle"
    const scale = scaleOf(low, high - low, frame.bottom, top)
    for (const [at, label] of labelled(roundNumbers(low, high, Math.max(3, size / em / 2.5)), scale)) {
      ctx.fillRect(right, at - 0.5, 0.3 * em, 1)
      ctx.fillText(label, right + 0.45 * em, at)
    }
    ctx.textBaseline = "alphabetic"
    ctx.fillText(chart.symbol, left, frame.top + 0.9 * em)
    // That some numbers are beyond the colours.
    ctx.textAlign = "center"
    if (isAbove) ctx.fillText("▴", left + (BAR + 0.9) * em, frame.top + 1.3 * em)
    if (isBelow) ctx.fillText("▾", left + BAR * em / 2, frame.bottom + 0.9 * em)
  }

  function drawMark(ctx, em, dark) {
    const { xs, ys } = place
    ctx.setLineDash(mark.isOfChart ? [] : [3, 3])
    for (const [colour, width] of [[dark ? "#000" : "#fff", 4], [dark ? POINT : DARK, 2]]) {
      circlePath(ctx, xs.compute(mark.at[0]), ys.compute(mark.at[1]), 0.55 * em * zoom())
      ctx.strokeStyle = colour
      ctx.lineWidth = width
      ctx.stroke()
    }
    ctx.setLineDash([])
  }

  function drawCursor(ctx) {
    const { xs, ys } = place
    // The ends of the cell along a side.
    /** @returns {number[]} */
    const ends = (side, i, scale) => [i - 0.5, i + 0.5].map((at) => scale.compute(side.low + stepOf(side) * at))
    const [left, right] = ends(chart.x, cursor[0], xs)
    const [bottom, top] = ends(chart.y, cursor[1], ys)
    ctx.lineWidth = 1
    for (const { colour, room } of [{ colour: "#fff", room: 2 }, { colour: DARK, room: 1 }]) {
      ctx.strokeStyle = colour
      ctx.strokeRect(left - room, top - room, right - left + 2 * room, bottom - top + 2 * room)
    }
  }

  function cellAt({ offsetX, offsetY }) {
    if (place === null) return null
    const cell = [[chart.x, place.xs.invert(offsetX)], [chart.y, place.ys.invert(offsetY)]]
      .map(([side, value]) => Math.round((value - side.low) / stepOf(side)))
    return cell.every((i, k) => i >= 0 && i < [chart.x, chart.y][k].count) ? cell : null
  }

  function moveTo(cell) {
    cursor = cell
    request()
    handlers.pointed(cell)
  }

  // [low, high] between two places of the canvas, within a side.
  const between = ({ low, high }, scale, places) => (
    places.map((at) => within(scale.invert(at), low, high)).sort((one, other) => one - other))

  onDrag(canvas, (event) => (event.button === 0 && cellAt(event) !== null ? [event.offsetX, event.offsetY] : null),
    ([x, y], { offsetX, offsetY }) => { if (Math.hypot(offsetX - x, offsetY - y) > SLIP) box = [x, y, offsetX, offsetY] },
    (from, event) => {
      const drawn = box
      const cell = event && cellAt(event)
      box = null
      request()
      if (drawn !== null && event !== null) {
        const [x0, y0, x1, y1] = drawn
        handlers.boxed({ x: between(chart.x, place.xs, [x0, x1]), y: between(chart.y, place.ys, [y0, y1]) })
      } else if (cell !== null) {
        moveTo(cell)
        handlers.chosen(cell)
      }
    })

  return {
    canvas,
    get cursor() { return cursor },
    show(next) {
      if (chart !== next) cursor = null
      chart = next
      renew()
      request()
    },
    mark(at, isOfChart) {
      mark = at === null ? null : { at, isOfChart }
      request()
    },
  }
}
