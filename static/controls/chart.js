// The chart of a quantity over two parameters of a scene, beside the pictures: what is computed, how far it is, and what a
// cell means.  The server computes it while the user goes on, in any scene.

import { listen, tell } from "../page/bus.js"
import { linkTo } from "../page/embedding.js"
import { element } from "../page/mount.js"
import { chartCanvas } from "../pictures/chart_canvas.js"
import { gallery } from "../pictures/gallery.js"
import { fromFile, toFile } from "./chart_file.js"
import { chartJob } from "./chart_job.js"

const CELLS = 192
const MOST_SIDE = 256
// Milliseconds that the mouse rests on a cell before the server is asked why it has no number.
const REST = 250
// From this status on a cell has no number, see "sweep/quantity.py".
const NO_NUMBER = 10
const DIGITS = 6
// About the cell of the cursor, by a key.
const CLOSER = 0.5

const options = (pairs) => pairs.map(([value, textContent]) => element("option", { value, textContent }))
const short = (value) => String(Number(value.toPrecision(DIGITS))).replaceAll("-", "−")
const placesOf = ({ low, high, count }, i) => (i === count - 1 ? high : low + (high - low) / (count - 1) * i)

function lasting(seconds) {
  if (seconds === null) return ""
  if (seconds < 1) return ", less than a second left"
  return seconds < 100 ? `, ${Math.ceil(seconds)} s left` : `, ${Math.ceil(seconds / 60)} min left`
}

// One side: {frame, offer(controls), choose(name), put(low, high), value() or null}.
function sideForm(label, ends, chosen) {
  const name = element("select", { className: `param-${label}`, "aria-label": `Parameter ${label}` })
  const box = (what) => element("input", { type: "number", step: "any", className: `param-${label}-${what}`, "aria-label": `${label} ${what}` })
  const [low, high] = [box("from"), box("to")]
  const count = element("input", {
    type: "number", min: 2, max: MOST_SIDE, step: 1, value: CELLS, className: `param-${label}-cells`, "aria-label": `${label} cells`,
  })
  const put = (from, to) => {
    ;[low.value, high.value] = [from, to].map((end) => String(Number(end.toPrecision(DIGITS))))
  }
  const symbolOf = () => name.selectedOptions[0]?.textContent ?? ""
  name.addEventListener("change", () => {
    put(...ends(name.value))
    chosen()
  })
  return {
    frame: element("div", { className: "side" }, name, element("label", {}, "from ", low), element("label", {}, "to ", high),
      element("label", {}, "cells ", count)),
    offer(controls) { name.replaceChildren(...options(controls.map((one) => [one.name, one.symbol]))) },
    get name() { return name.value },
    choose(wanted, from, to) {
      name.value = wanted
      put(from, to)
    },
    value: () => ({ name: name.value, symbol: symbolOf(), low: low.valueAsNumber, high: high.valueAsNumber, count: count.valueAsNumber }),
  }
}

// {panel, open(), show(description of the scene on show)}.
export function chartPanel(palettes, signal) {
  let scene = null
  // Control → what it shows.
  let values = {}
  let chart = null
  // Those that were zoomed into.
  let before = []
  let opener = null
  let resting = null

  const titles = new Map()
  const button = (name, textContent, press, title) => {
    const item = element("button", { type: "button", className: `button param-${name}`, textContent, title })
    titles.set(item, title)
    item.addEventListener("click", press)
    return item
  }
  // A button that can be pressed, or says why not.
  const offerIf = (item, isUsable, without) => {
    item.disabled = !isUsable
    item.title = isUsable ? titles.get(item) : `Disabled: ${without}`
  }
  const numbers = () => [...scene.controls, ...scene.sides]
  const controlOf = (name) => numbers().find((one) => one.name === name)
  const endsOf = (name) => values[name]?.slice(1, 3) ?? controlOf(name).range

  const quantity = element("select", { className: "param-quantity", "aria-label": "Quantity" })
  const part = element("select", { className: "param-part", "aria-label": "Which of its numbers" })
  const x = sideForm("x", endsOf, () => keepApart(y, x))
  const y = sideForm("y", endsOf, () => keepApart(x, y))
  const start = button("chart-start", "Start", () => begin(wanted()), "Compute the chart")
  const stop = button("chart-stop", "Stop", () => job.stop(), "Leave the chart at what is computed")
  const out = button("chart-out", "Zoom out", zoomOut, "The chart before (minus key)")
  const save = button("chart-save", "Save", keep, "A file that Load shows again")
  const file = element("input", { type: "file", accept: ".json,application/json", hidden: true })
  const load = button("chart-load", "Load", () => file.click(), "A chart that was saved")
  const close = button("chart-close", "Close", hide, "The chart goes on meanwhile")
  const bar = element("progress", { "aria-label": "Computed", max: 1 })
  const said = element("p", { className: "why", role: "status" })
  const reading = element("output", { className: "reading", "aria-live": "polite" })
  const heading = element("h2", { textContent: "Chart" })
  const form = element("div", { className: "form" }, element("div", { className: "side" }, quantity, part), x.frame, y.frame)
  const map = chartCanvas(palettes, { pointed: read, chosen: open, boxed: closer }, signal)
  const picture = element("div", { className: "drawn", hidden: true }, map.canvas, reading)
  const panel = element("div", { className: "chart", popover: "manual", role: "dialog", "aria-label": "Chart" },
    element("div", { className: "head" }, heading, close), form,
    element("div", { className: "row" }, start, stop, out, save, load, file, bar), said, picture)

  const job = chartJob((changed) => {
    if (changed === chart) follow()
  }, (sentence, place) => {
    const cell = map.cursor
    if (cell !== null && place[0] === placesOf(chart.x, cell[0]) && place[1] === placesOf(chart.y, cell[1])) {
      reading.textContent = `${where(cell)}: ${sentence}`
    }
  }, signal)

  const described = () => scene.charts.find((one) => one.quantity === quantity.value)

  // Both sides are different parameters.
  function keepApart(other, moved) {
    if (other.name !== moved.name) return
    const next = described().over.find((name) => name !== moved.name)
    other.choose(next, ...endsOf(next))
  }

  // The axes of a picture, where both are parameters of the scene: [[name, low, high], …].
  function axesOf(picture) {
    const plot = gallery.shown.plots.find(({ model }) => model.name === picture)?.model
    if (plot === undefined) return null
    const found = [[plot.below[0], plot.x_range], [plot.left[0], plot.y_range]].map(([axis, range]) => [
      numbers().find(({ name, symbol }) => [name, symbol].includes(axis?.axis_label))?.name, range.start, range.end])
    return found.every(([name]) => described().over.includes(name)) && found[0][0] !== found[1][0] ? found : null
  }

  // The sides that are in sight: the axes of this picture, else what has open controls.
  function offer(picture) {
    const { over, parts } = described()
    const offered = over.filter((name) => values[name]?.[4] !== true).map(controlOf).filter(Boolean)
    part.replaceChildren(...options(parts.map((name, i) => [i, name.replaceAll("_", " ")])))
    part.hidden = parts.length === 0
    for (const side of [x, y]) side.offer(offered)
    offerIf(start, offered.length >= 2, "nothing of this scene can be charted over two of its numbers")
    if (start.disabled) return
    const sides = axesOf(picture) ?? offered.slice(0, 2).map(({ name }) => [name, ...endsOf(name)])
    x.choose(...sides[0])
    y.choose(...sides[1])
  }

  // With the places that it has at first, where the link says nothing of them.
  function state() {
    const query = new URL(linkTo()).searchParams
    for (const { name, place } of scene.sides) if (!query.get(name.split(":")[0])) query.set(name.split(":")[0], place)
    return query.toString()
  }

  function wanted() {
    tell("address")
    const { symbol, title, units, turn, parts } = described()
    return {
      scene: scene.name, state: state(), quantity: quantity.value, part: Number(part.value || 0), title, units, turn,
      symbol: parts.length > 0 ? `${symbol} ${part.selectedOptions[0].textContent}` : symbol, x: x.value(), y: y.value(),
    }
  }

  function begin(next) {
    if (![next.x, next.y].every(({ low, high, count }) => Number.isFinite(low) && Number.isFinite(high) && Number.isInteger(count))) {
      said.textContent = "Give numbers for from, to and cells."
      return
    }
    chart = { ...next, level: "", values: null, status: null, known: 0, share: 0, left: null, said: "" }
    job.start(chart)
    fillForm()
    follow()
  }

  function closer(box) {
    if (!(box.x[1] > box.x[0] && box.y[1] > box.y[0])) return
    const { scene: of, state: query, quantity: what, part: which, title, symbol, units, turn } = chart
    const side = (one, [low, high]) => ({ name: one.name, symbol: one.symbol, count: one.count, low, high })
    before.push(chart)
    begin({ scene: of, state: query, quantity: what, part: which, title, symbol, units, turn, x: side(chart.x, box.x), y: side(chart.y, box.y) })
  }

  function zoomOut() {
    if (before.length === 0) return
    job.stop()
    chart = before.pop()
    fillForm()
    follow()
  }

  const where = ([column, row]) => `${chart.x.symbol} = ${short(placesOf(chart.x, column))}, ${chart.y.symbol} = ${short(placesOf(chart.y, row))}`

  // The boxes say what is on show, where that is of this scene.
  function fillForm() {
    if (chart.scene !== scene.name) return
    if (quantity.value !== chart.quantity) {
      quantity.value = chart.quantity
      offer(null)
    }
    part.value = chart.part
    x.choose(chart.x.name, chart.x.low, chart.x.high)
    y.choose(chart.y.name, chart.y.low, chart.y.high)
  }

  // What is known of a cell; why it has no number, the server says.
  function read(cell) {
    clearTimeout(resting)
    reading.textContent = ""
    if (cell === null || chart?.values == null) return
    const at = cell[1] * chart.x.count + cell[0]
    const status = chart.status[at]
    if (status === 0) reading.textContent = `${where(cell)}: not computed yet`
    else if (status < NO_NUMBER) {
      const units = chart.units === "1" ? "" : ` ${chart.units}`
      reading.textContent = `${where(cell)}: ${chart.symbol} = ${short(chart.values[at])}${units}`
    } else {
      reading.textContent = `${where(cell)}: no number`
      resting = setTimeout(() => job.why(chart, [placesOf(chart.x, cell[0]), placesOf(chart.y, cell[1])]), REST)
    }
  }

  const placeIn = (query, name) => query.get(name.split(":")[0]).split(";").at(-1).split(",")

  // A number in a link; or a coordinate of its last place, which alone is left.
  function put(query, name, value) {
    const [key, coordinate] = name.split(":")
    if (coordinate === undefined) return query.set(name, value)
    const place = placeIn(query, name)
    place[coordinate] = value
    query.set(key, place.join(","))
  }

  // The state of a cell, in its scene.
  function open([column, row]) {
    const query = new URLSearchParams(chart.state)
    put(query, chart.x.name, placesOf(chart.x, column))
    put(query, chart.y.name, placesOf(chart.y, row))
    tell("restore", query.toString())
  }

  const numberOf = (name) => (name.includes(":") ? Number(placeIn(new URLSearchParams(state()), name)[name.split(":")[1]]) : values[name]?.[0])

  // The ring at the state on show: broken where another parameter is not the chart's.
  function mark() {
    const own = chart !== null && chart.scene === scene?.name ? [chart.x, chart.y].map(({ name }) => numberOf(name)) : []
    if (!own.every(Number.isFinite) || own.length < 2) return map.mark(null, false)
    const base = new URLSearchParams(chart.state)
    const isSame = scene.controls.every(({ name, kind }) => (
      kind !== "number" || [chart.x.name, chart.y.name].includes(name) || !base.has(name) || Number(base.get(name)) === values[name]?.[0]))
    map.mark(own, isSame)
  }

  function follow() {
    const isRunning = job.running === chart && chart !== null
    picture.hidden = chart?.values == null
    offerIf(stop, isRunning, "nothing is computed")
    offerIf(out, before.length > 0, "this chart was not zoomed into")
    offerIf(save, chart?.values != null, "there is no chart yet")
    bar.hidden = !isRunning
    if (chart === null) return
    bar.value = chart.share
    heading.textContent = `Chart: ${chart.symbol}`
    heading.title = chart.title
    const size = chart.values === null ? "" : `${chart.x.count} × ${chart.y.count}, ${chart.level} accuracy. `
    said.textContent = isRunning ? `${Math.floor(100 * chart.share)} % of ${size.replace(". ", "")}${lasting(chart.left)}.`
      : `${size}${chart.said}${chart.share < 1 && chart.values !== null && chart.said === "" ? "It was not computed to its end." : ""}`
    map.show(chart)
    mark()
  }

  function keep() {
    const content = new Blob([toFile(chart)], { type: "application/json" })
    const address = URL.createObjectURL(content)
    // Coordinates of places by their symbols, which files may have but for the stroke of L/G.
    const [across, up] = [chart.x, chart.y].map(({ name, symbol }) => (name.includes(":") ? symbol.replaceAll("/", "") : name))
    element("a", { href: address, download: `${chart.scene}-${chart.quantity}-${across}-${up}.json` }).click()
    URL.revokeObjectURL(address)
  }

  file.addEventListener("change", async () => {
    const [given] = file.files
    if (given === undefined) return
    const { chart: found, why } = fromFile(await given.text())
    file.value = ""
    if (why !== undefined) {
      said.textContent = why
      return
    }
    job.stop()
    before = []
    chart = found
    fillForm()
    follow()
  })

  function hide() {
    panel.hidePopover()
    opener?.focus()
  }

  panel.addEventListener("keydown", (event) => {
    const act = { Escape: hide }[event.key] ?? (event.target === map.canvas ? {
      Enter: () => { if (map.cursor !== null) open(map.cursor) },
      "-": zoomOut,
      "+": () => {
        const [column, row] = map.cursor ?? [chart.x.count / 2, chart.y.count / 2].map(Math.floor)
        const about = (side, i) => {
          const [half, middle] = [CLOSER * (side.high - side.low) / 2, placesOf(side, i)]
          return [Math.max(side.low, middle - half), Math.min(side.high, middle + half)]
        }
        closer({ x: about(chart.x, column), y: about(chart.y, row) })
      },
    }[event.key] : undefined)
    if (act === undefined) return
    event.preventDefault()
    event.stopPropagation()
    act()
  })
  quantity.addEventListener("change", () => offer(null))
  listen("controls", (changed) => {
    Object.assign(values, changed)
    mark()
  }, signal)
  tell("mounted", { kind: "controls", show: (known) => { values = { ...known } } })
  follow()

  return {
    panel,
    show(description) {
      if (scene?.name === description.name) return
      scene = description
      values = {}
      const can = scene.charts
      quantity.replaceChildren(...options(can.map((one) => [one.quantity, `${one.symbol}  ${one.title}`])))
      form.hidden = can.length === 0
      offerIf(start, can.length > 0, "nothing of this scene can be charted")
      mark()
    },
    open() {
      if (panel.matches(":popover-open")) return hide()
      opener = panel.getRootNode().activeElement
      const isFirst = chart === null || chart.scene !== scene.name
      if (scene.charts.length > 0 && isFirst) {
        const large = new URLSearchParams(window.location.search).get("large")?.split(",")[0]
        const pointed = gallery.pointed ?? large
        quantity.value = (scene.charts.find(({ pictures }) => pictures.includes(pointed)) ?? scene.charts[0]).quantity
        offer(pointed)
      }
      if (chart === null) {
        said.textContent = scene.charts.length > 0 ? "" : "Nothing of this scene can be charted: choose another one, or load a chart."
      }
      panel.showPopover()
      ;(form.hidden ? load : start).focus()
    },
  }
}
