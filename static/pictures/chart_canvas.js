// @ts-check
// The canvas of a chart: coloured cells, axes, a colour bar, and a ring at the state on show.  The pointer and the arrow keys
// move a cursor from cell to cell; a drag draws a box.

import { onDrag } from "../page/drag.js"
import { arrowOf } from "../page/keys.js"
import { zoom } from "../page/presenting.js"
import { liveCanvas } from "./canvas.js"
import { cellsPainter } from "./cells.js"
import { categoriesOf, categoryColours, coloursOf, filled, NO_NUMBER } from "./chart_colours.js"
import { circlePath, POINT } from "./looks.js"
import { drawTicks, roundNumbers, tickLabels } from "./ticks.js"

// Margins and the width of the colour bar, in units of the font size.
const LEFT = 4.6
const RIGHT = 6.6
const TOP = 0.8
const BOTTOM = 3.6
const BAR = 1.1
// The same for a key of categories: the right margin, the distance of their marks, and the longest line of a name.
const KEY = 10.5
const MARKS = 2.6
const LETTERS = 16
// Pixels that the pointer may move during a click.
const SLIP = 6
const DARK = "#101010"
// Cells without a number, see "cells.js".
const EMPTY = "#808080"

/** @param {ChartAxis} axis */
const stepOf = ({ low, high, count }) => (high - low) / (count - 1)
/** @param {number} value @param {number} low @param {number} high */
const within = (value, low, high) => Math.max(low, Math.min(high, value))

/**
 * Return the scale that maps values from low to low + size to pixels.
 * @param {number} low
 * @param {number} size
 * @param {number} from
 * @param {number} to
 * @returns {Scale}
 */
const scaleOf = (low, size, from, to) => ({
  compute: (value) => from + (value - low) / size * (to - from), invert: (at) => low + (at - from) / (to - from) * size,
})

/** @param {number[]} ticks @param {Scale} scale @returns {[number, string][]} */
const labelled = (ticks, scale, letters = 1e9) => {
  const labels = tickLabels(ticks, letters)
  return ticks.map((tick, i) => [scale.compute(tick), labels[i]])
}

/**
 * Return a name in lines of at most `most` letters, if its words allow.
 * @param {string} name
 * @param {number} most
 */
const wrapped = (name, most) => name.split(" ").reduce((/** @type {string[]} */ lines, word) => {
  const longer = `${lines.at(-1) ?? ""} ${word}`.trim()
  return longer.length <= most || lines.length === 0 ? [...lines.slice(0, -1), longer] : [...lines, word]
}, [])

/**
 * Draw the mark of a category, dark with a white rim, in the middle of a place.
 * @param {CanvasRenderingContext2D} ctx
 * @param {string} sign
 * @param {number} x
 * @param {number} y
 */
function drawSign(ctx, sign, x, y) {
  ctx.save()
  ctx.textAlign = "center"
  ctx.textBaseline = "middle"
  ctx.lineWidth = 2.5
  ctx.strokeStyle = "#fff"
  ctx.fillStyle = DARK
  ctx.strokeText(sign, x, y)
  ctx.fillText(sign, x, y)
  ctx.restore()
}

/** @param {CanvasRenderingContext2D} ctx @param {number[]} box */
function drawBox(ctx, [x0, y0, x1, y1]) {
  ctx.fillStyle = "rgba(255, 255, 255, 0.25)"
  ctx.fillRect(x0, y0, x1 - x0, y1 - y0)
  ctx.strokeStyle = DARK
  ctx.lineWidth = 1.5
  ctx.setLineDash([4, 3])
  ctx.strokeRect(x0, y0, x1 - x0, y1 - y0)
}

/**
 * Return the canvas, its cursor, and the functions that show a chart and mark the state on show.
 * @param {Palettes} palettes `round` is for numbers that are defined up to full turns
 * @param {{pointed: (cell: Cell | null) => void, chosen: (cell: Cell) => void, boxed: (box: ChartBox) => void}} handlers
 */
export function chartCanvas(palettes, handlers) {
  /** @type {Chart | null} */
  let chart = null
  /** @type {{at: number[], isOfChart: boolean} | null} */
  let mark = null
  /** @type {Cell | null} */
  let cursor = null
  /** @type {number[] | null} */
  let box = null
  /** @type {ReturnType<typeof coloursOf> & {palette: string[], painter: ReturnType<typeof cellsPainter>} | null} */
  let colours = null
  // A layer of cells, see "cells.js".
  /** @type {{image: Grid[], x: number[], y: number[], dw: number[], dh: number[]} | null} */
  let data = null
  // The frame of the chart, and the scales from values to pixels.
  /** @type {{frame: {left: number, right: number, top: number, bottom: number}, xs: Scale, ys: Scale} | null} */
  let place = null
  /** @type {ReturnType<typeof categoriesOf>} */
  let categories = []

  const { canvas, request } = liveCanvas("map", {
    tabIndex: 0, role: "application",
    ariaLabel: "Chart: arrow keys move, Enter opens the state, plus zooms, minus goes back",
    onpointermove: (/** @type {PointerEvent} */ event) => moveTo(cellAt(event)),
    onpointerleave: () => { if (box === null) moveTo(null) },
    /** @param {KeyboardEvent} event */
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
    categories = categoriesOf(chart)
    const own = categories.length > 0 ? categoryColours(categories)
      : { palette: turn > 0 ? palettes.round : palettes.plain, ...coloursOf(chart) }
    colours = { ...own, painter: cellsPainter([{ source: "chart", ...own }], () => ({ data })) }
  }

  /** @param {CanvasRenderingContext2D} ctx @param {CanvasLook} look */
  function paint(ctx, { width, height, text, dark }) {
    if (data === null) return
    const em = Number.parseFloat(getComputedStyle(canvas).fontSize)
    const frame = { left: LEFT * em, right: width - (categories.length > 0 ? KEY : RIGHT) * em, top: TOP * em, bottom: height - BOTTOM * em }
    const xs = scaleOf(data.x[0], data.dw[0], frame.left, frame.right)
    const ys = scaleOf(data.y[0], data.dh[0], frame.bottom, frame.top)
    place = { frame, xs, ys }
    colours.painter(ctx, xs, ys)
    ctx.font = `${0.9 * em}px system-ui, sans-serif`
    ctx.fillStyle = ctx.strokeStyle = text
    /** @type {[number, number, number, number]} */
    const edges = [frame.left, frame.top, frame.right - frame.left, frame.bottom - frame.top]
    ctx.strokeRect(...edges)
    drawAxes(ctx, em)
    if (categories.length > 0) drawKey(ctx, em)
    else drawBar(ctx, em)
    ctx.beginPath()
    ctx.rect(...edges)
    ctx.clip()
    if (categories.length > 0) drawMarks(ctx, em)
    if (mark !== null) drawMark(ctx, em, dark)
    if (cursor !== null) drawCursor(ctx)
    if (box !== null) drawBox(ctx, box)
  }

  /** @param {CanvasRenderingContext2D} ctx @param {number} em */
  function drawAxes(ctx, em) {
    const { x, y } = chart
    const { frame, xs, ys } = place
    const [across, up] = [(frame.right - frame.left) / em, (frame.bottom - frame.top) / em]
    drawTicks(ctx, frame,
      // All labels of the horizontal axis must fit side by side.
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

  /** @param {CanvasRenderingContext2D} ctx @param {number} em */
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
    // Triangles show that some numbers lie beyond the colours.
    ctx.textAlign = "center"
    if (isAbove) ctx.fillText("▴", left + (BAR + 0.9) * em, frame.top + 1.3 * em)
    if (isBelow) ctx.fillText("▾", left + BAR * em / 2, frame.bottom + 0.9 * em)
  }

  /** @param {CanvasRenderingContext2D} ctx @param {number} em */
  function drawKey(ctx, em) {
    const { frame } = place
    const [left, line] = [frame.right + em, 1.15 * em]
    const text = ctx.strokeStyle
    let top = frame.top + 0.9 * em
    ctx.textAlign = "left"
    ctx.textBaseline = "alphabetic"
    ctx.fillText(chart.symbol, left, top)
    top += 0.7 * em
    const isEmpty = chart.status.some((one) => one >= NO_NUMBER)
    for (const { name, colour, mark: sign } of [...categories, ...isEmpty ? [{ name: "no value", colour: EMPTY, mark: "" }] : []]) {
      ctx.fillStyle = colour
      ctx.fillRect(left, top, 1.3 * em, line)
      ctx.lineWidth = 1
      ctx.strokeStyle = text
      ctx.strokeRect(left, top, 1.3 * em, line)
      drawSign(ctx, sign, left + 0.65 * em, top + line / 2)
      ctx.fillStyle = text
      ctx.textAlign = "left"
      ctx.textBaseline = "middle"
      const lines = wrapped(name, LETTERS)
      lines.forEach((words, i) => ctx.fillText(words, left + 1.7 * em, top + (i + 0.5) * line))
      top += (lines.length + 0.35) * line
    }
    ctx.strokeStyle = text
  }

  // Marks stand a few letters apart: most cells are smaller than a letter.
  /** @param {CanvasRenderingContext2D} ctx @param {number} em */
  function drawMarks(ctx, em) {
    const { frame, xs, ys } = place
    const [{ rows, columns, numbers }] = data.image
    const step = MARKS * em
    for (let y = frame.top + step / 2; y < frame.bottom; y += step) {
      for (let x = frame.left + step / 2; x < frame.right; x += step) {
        const column = within(Math.round((xs.invert(x) - chart.x.low) / stepOf(chart.x)), 0, columns - 1)
        const row = within(Math.round((ys.invert(y) - chart.y.low) / stepOf(chart.y)), 0, rows - 1)
        const found = categories.find(({ value }) => value === numbers[row * columns + column])
        if (found !== undefined) drawSign(ctx, found.mark, x, y)
      }
    }
  }

  /** @param {CanvasRenderingContext2D} ctx @param {number} em @param {boolean} dark */
  function drawMark(ctx, em, dark) {
    const { xs, ys } = place
    ctx.setLineDash(mark.isOfChart ? [] : [3, 3])
    /** @type {[string, number][]} */
    const strokes = [[dark ? "#000" : "#fff", 4], [dark ? POINT : DARK, 2]]
    for (const [colour, width] of strokes) {
      circlePath(ctx, xs.compute(mark.at[0]), ys.compute(mark.at[1]), 0.55 * em * zoom())
      ctx.strokeStyle = colour
      ctx.lineWidth = width
      ctx.stroke()
    }
    ctx.setLineDash([])
  }

  /** @param {CanvasRenderingContext2D} ctx */
  function drawCursor(ctx) {
    const { xs, ys } = place
    /**
     * Return the ends of a cell along a side.
     * @param {ChartAxis} side
     * @param {number} i
     * @param {Scale} scale
     */
    const ends = (side, i, scale) => [i - 0.5, i + 0.5].map((at) => scale.compute(side.low + stepOf(side) * at))
    const [left, right] = ends(chart.x, cursor[0], xs)
    const [bottom, top] = ends(chart.y, cursor[1], ys)
    ctx.lineWidth = 1
    for (const [colour, room] of /** @type {[string, number][]} */ ([["#fff", 2], [DARK, 1]])) {
      ctx.strokeStyle = colour
      ctx.strokeRect(left - room, top - room, right - left + 2 * room, bottom - top + 2 * room)
    }
  }

  /** @param {MouseEvent} event */
  function cellAt({ offsetX, offsetY }) {
    if (place === null) return null
    const values = [place.xs.invert(offsetX), place.ys.invert(offsetY)]
    const sides = [chart.x, chart.y]
    const cell = sides.map((side, k) => Math.round((values[k] - side.low) / stepOf(side)))
    return cell.every((i, k) => i >= 0 && i < sides[k].count) ? cell : null
  }

  /** @param {Cell | null} cell */
  function moveTo(cell) {
    cursor = cell
    request()
    handlers.pointed(cell)
  }

  /** Return [low, high] between two places, within a side. @param {ChartAxis} side @param {Scale} scale @param {number[]} places */
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
    /** @param {Chart} next */
    show(next) {
      if (chart !== next) cursor = null
      chart = next
      renew()
      request()
    },
    /** @param {number[] | null} at @param {boolean} isOfChart whether all other parameters are those of the chart */
    mark(at, isOfChart) {
      mark = at === null ? null : { at, isOfChart }
      request()
    },
  }
}
