// The chart of a quantity over two parameters of a scene, beside the pictures: what is computed, how far it is, and what a
// cell means.  The server computes it while the user goes on, in any scene.

import { button, element } from "../page/elements.js"
import { listen, tell } from "../page/bus.js"
import { linkTo } from "../page/embedding.js"
import { chartCanvas } from "../pictures/chart_canvas.js"
import { gallery } from "../pictures/gallery.js"
import { around, isWithoutNumber, numberIn, placeOf, reading, stateOf } from "./chart_cells.js"
import { fromFile, toFile } from "./chart_file.js"
import { chartJob } from "./chart_job.js"
import { sideForm } from "./chart_side.js"
import { optionsOf, saveFile } from "./dialog.js"

// Milliseconds that the mouse rests on a cell before the server is asked why it has no number.
const REST = 250
// About the cell of the cursor, by a key.
const CLOSER = 0.5

function lasting(seconds) {
  if (seconds === null) return ""
  if (seconds < 1) return ", less than a second left"
  return seconds < 100 ? `, ${Math.ceil(seconds)} s left` : `, ${Math.ceil(seconds / 60)} min left`
}

/** Return {panel, open(), show(description of the scene on show)}. */
export function chartPanel(palettes) {
  let scene = null
  // Control → what it shows.
  let values = {}
  let chart = null
  // Those that were zoomed into.
  let before = []
  let opener = null
  let resting = null

  const titles = new Map()
  const press = (name, textContent, onclick, title) => {
    const item = button(`button.param-chart-${name}`, onclick, { textContent, title })
    titles.set(item, title)
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

  const quantity = element("select.param-quantity", { ariaLabel: "Quantity", onchange: () => offer(null) })
  const part = element("select.param-part", { ariaLabel: "Which of its numbers" })
  const x = sideForm("x", endsOf, () => keepApart(y, x))
  const y = sideForm("y", endsOf, () => keepApart(x, y))
  const start = press("start", "Start", () => begin(wanted()), "Compute the chart")
  const stop = press("stop", "Stop", () => job.stop(), "Leave the chart at what is computed")
  const out = press("out", "Zoom out", zoomOut, "The chart before (minus key)")
  const save = press("save", "Save", keep, "A file that Load shows again")
  const file = element("input", { type: "file", accept: ".json,application/json", hidden: true, onchange: take })
  const load = press("load", "Load", () => file.click(), "A chart that was saved")
  const close = press("close", "Close", hide, "The chart goes on meanwhile")
  const bar = element("progress", { ariaLabel: "Computed", max: 1 })
  const said = element("p.why", { role: "status" })
  const about = element("output.reading", { ariaLive: "polite" })
  const heading = element("h2", "Chart")
  const form = element("div.form", element("div.side", quantity, part), x.frame, y.frame)
  const map = chartCanvas(palettes, { pointed: read, chosen: open, boxed: closer })
  const picture = element("div.drawn", { hidden: true }, map.canvas, about)
  const panel = element("div.chart", { popover: "manual", role: "dialog", ariaLabel: "Chart", onkeydown },
    element("div.head", heading, close), form,
    element("div.row", start, stop, out, save, load, file, bar), said, picture)

  const job = chartJob((changed) => { if (changed === chart) follow() }, (sentence, place) => {
    const cell = map.cursor
    if (cell !== null && String(placeOf(chart, cell)) === String(place)) about.textContent = reading(chart, cell, sentence)
  })

  const described = () => scene.charts.find((one) => one.quantity === quantity.value)

  // Both sides are different parameters.
  function keepApart(other, moved) {
    if (other.name !== moved.name) return
    const next = described().over.find((name) => name !== moved.name)
    other.choose(next, ...endsOf(next))
  }

  // The axes of a picture, where both are parameters of the scene: [[name, low, high], …].
  function axesOf(name) {
    const plot = gallery.plot(name)?.model
    if (plot === undefined) return null
    const found = [[plot.below[0], plot.x_range], [plot.left[0], plot.y_range]].map(([axis, range]) => [
      numbers().find((one) => [one.name, one.symbol].includes(axis?.axis_label))?.name, range.start, range.end])
    return found.every(([one]) => described().over.includes(one)) && found[0][0] !== found[1][0] ? found : null
  }

  // The sides that are in sight: the axes of this picture, else what has open controls.
  function offer(pictureName) {
    const { over, parts } = described()
    const offered = over.filter((name) => values[name]?.[4] !== true).map(controlOf).filter(Boolean)
    part.replaceChildren(...optionsOf(parts.map((name, i) => [i, name.replaceAll("_", " ")])))
    part.hidden = parts.length === 0
    for (const side of [x, y]) side.offer(offered)
    offerIf(start, offered.length >= 2, "nothing of this scene can be charted over two of its numbers")
    if (start.disabled) return
    const sides = axesOf(pictureName) ?? offered.slice(0, 2).map(({ name }) => [name, ...endsOf(name)])
    x.choose(...sides[0])
    y.choose(...sides[1])
  }

  // With the places that it has at first, where the link says nothing of them.
  function state() {
    const query = new URL(linkTo()).searchParams
    for (const { name, place } of scene.sides) {
      const [list] = name.split(":")
      if (!query.get(list)) query.set(list, place)
    }
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

  // Another chart is on show.
  function turnTo(next) {
    chart = next
    fillForm()
    follow()
  }

  function begin(next) {
    if (![next.x, next.y].every(({ low, high, count }) => Number.isFinite(low) && Number.isFinite(high) && Number.isInteger(count))) {
      said.textContent = "Give numbers for from, to and cells."
      return
    }
    const begun = { ...next, level: "", error: null, version: "", values: null, status: null, known: 0, share: 0, left: null, said: "" }
    job.start(begun)
    turnTo(begun)
  }

  function closer(box) {
    if (!(box.x[1] > box.x[0] && box.y[1] > box.y[0])) return
    const side = (one, [low, high]) => ({ ...one, low, high })
    before.push(chart)
    begin({ ...chart, x: side(chart.x, box.x), y: side(chart.y, box.y) })
  }

  function zoomOut() {
    if (before.length === 0) return
    job.stop()
    turnTo(before.pop())
  }

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
    const isThere = cell !== null && chart?.values != null
    about.textContent = isThere ? reading(chart, cell) : ""
    if (isThere && isWithoutNumber(chart, cell)) resting = setTimeout(() => job.why(chart, placeOf(chart, cell)), REST)
  }

  // The state of a cell, in its scene.
  function open(cell) { tell("restore", stateOf(chart, cell)) }

  const numberOf = (name) => (name.includes(":") ? numberIn(new URLSearchParams(state()), name) : values[name]?.[0])

  // The ring at the state on show: broken where another parameter is not the chart's.
  function mark() {
    const sides = chart !== null && chart.scene === scene?.name ? [chart.x.name, chart.y.name] : []
    const own = sides.map(numberOf)
    if (!own.every(Number.isFinite) || own.length < 2) return map.mark(null, false)
    const base = new URLSearchParams(chart.state)
    map.mark(own, scene.controls.every(({ name, kind }) => (
      kind !== "number" || sides.includes(name) || !base.has(name) || numberIn(base, name) === values[name]?.[0])))
  }

  function follow() {
    const isThere = chart !== null && chart.values !== null
    const isRunning = chart !== null && job.running === chart
    picture.hidden = !isThere
    offerIf(stop, isRunning, "nothing is computed")
    offerIf(out, before.length > 0, "this chart was not zoomed into")
    offerIf(save, isThere, "there is no chart yet")
    bar.hidden = !isRunning
    if (chart === null) return
    bar.value = chart.share
    heading.textContent = `Chart: ${chart.symbol}`
    heading.title = chart.title
    const size = isThere ? `${chart.x.count} × ${chart.y.count}, ${chart.level} accuracy` : ""
    const ended = chart.said || (isThere && chart.share < 1 ? "It was not computed to its end." : "")
    said.textContent = isRunning ? `${Math.floor(100 * chart.share)} % of ${size}${lasting(chart.left)}.`
      : `${size}${isThere ? ". " : ""}${ended}`
    map.show(chart)
    mark()
  }

  function keep() {
    // Coordinates of places by their symbols, which files may have but for the stroke of L/G.
    const [across, up] = [chart.x, chart.y].map(({ name, symbol }) => (name.includes(":") ? symbol.replaceAll("/", "") : name))
    saveFile(new Blob([toFile(chart)], { type: "application/json" }), `${chart.scene}-${chart.quantity}-${across}-${up}.json`)
  }

  async function take() {
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
    turnTo(found)
  }

  function hide() {
    panel.hidePopover()
    opener?.focus()
  }

  // Enter, minus and plus are for the canvas.
  function onkeydown(event) {
    const onCanvas = {
      Enter: () => { if (map.cursor !== null) open(map.cursor) },
      "-": zoomOut,
      "+": () => closer(around(chart, map.cursor ?? [chart.x, chart.y].map(({ count }) => Math.floor(count / 2)), CLOSER)),
    }
    const act = event.key === "Escape" ? hide : event.target === map.canvas ? onCanvas[event.key] : undefined
    if (act === undefined) return
    event.preventDefault()
    event.stopPropagation()
    act()
  }

  listen({
    controls(changed) {
      Object.assign(values, changed)
      mark()
    },
  })
  follow()

  return {
    panel,
    show(description) {
      if (scene?.name === description.name) return
      scene = description
      values = {}
      const { charts } = scene
      quantity.replaceChildren(...optionsOf(charts.map((one) => [one.quantity, `${one.symbol}  ${one.title}`])))
      form.hidden = charts.length === 0
      offerIf(start, charts.length > 0, "nothing of this scene can be charted")
      mark()
    },
    open() {
      if (panel.matches(":popover-open")) return hide()
      opener = panel.getRootNode().activeElement
      const { charts } = scene
      if (charts.length > 0 && chart?.scene !== scene.name) {
        const large = new URLSearchParams(location.search).get("large")?.split(",")[0]
        const pointed = gallery.pointed ?? large
        quantity.value = (charts.find(({ pictures }) => pictures.includes(pointed)) ?? charts[0]).quantity
        offer(pointed)
      }
      if (chart === null) {
        said.textContent = charts.length > 0 ? "" : "Nothing of this scene can be charted: choose another one, or load a chart."
      }
      panel.showPopover()
      ;(form.hidden ? load : start).focus()
    },
  }
}
