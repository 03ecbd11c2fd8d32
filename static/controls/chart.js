// @ts-check
// The chart panel: a quantity over two parameters of a scene, its progress, and the reading of a cell.  The server computes
// the chart in the background, whatever scene is on show.

import { button, element } from "../page/elements.js"
import { listen, tell } from "../page/bus.js"
import { linkTo } from "../page/embedding.js"
import { chartCanvas } from "../pictures/chart_canvas.js"
import { gallery } from "../pictures/gallery.js"
import { nameOf } from "../pictures/picture.js"
import { around, isWithoutNumber, numberIn, placeOf, reading, stateOf } from "./chart_cells.js"
import { fromFile, toFile } from "./chart_file.js"
import { chartJob } from "./chart_job.js"
import { sideForm } from "./chart_side.js"
import { optionsOf, saveFile } from "./dialog.js"

// Milliseconds that the pointer rests on a cell before the server is asked why it has no number.
const REST = 250
// Share of each side that the plus key zooms to.
const CLOSER = 0.5

/** Return the remaining time in words. @param {number | null} seconds */
function lasting(seconds) {
  if (seconds === null) return ""
  if (seconds < 1) return ", less than a second left"
  return seconds < 100 ? `, ${Math.ceil(seconds)} s left` : `, ${Math.ceil(seconds / 60)} min left`
}

/** Return the panel and the functions that open it and set its scene. @param {Palettes} palettes */
export function chartPanel(palettes) {
  /** @type {SceneDescription | null} */
  let scene = null
  // Control → its value.
  /** @type {Record<string, ControlValue>} */
  let values = {}
  /** @type {Chart | null} */
  let chart = null
  // Charts that were zoomed into.
  /** @type {Chart[]} */
  let before = []
  const isStateGiven = new URLSearchParams(location.search).has("scene")
  let isServed = false
  // Whether the form offers what can be charted in this scene: when the values of its controls are there.
  let isFilled = false
  /** @type {HTMLElement | null} */
  let opener = null
  /** @type {ReturnType<typeof setTimeout>} */
  let resting = null

  /** @type {Map<HTMLElement, string>} */
  const titles = new Map()
  /** @param {string} name @param {string} textContent @param {() => void} onclick @param {string} title */
  const press = (name, textContent, onclick, title) => {
    const item = button(`button.param-chart-${name}`, onclick, { textContent, title })
    titles.set(item, title)
    return item
  }
  /**
   * Enable a button, or disable it with a reason.
   * @param {HTMLButtonElement} item
   * @param {boolean} isUsable
   * @param {string} without
   */
  const offerIf = (item, isUsable, without) => {
    item.disabled = !isUsable
    item.title = isUsable ? titles.get(item) : `Disabled: ${without}`
  }
  /** @returns {{name: string, symbol?: string, range?: [number, number]}[]} */
  const numbers = () => [...scene.controls, ...scene.sides]
  /** @param {string} name */
  const controlOf = (name) => numbers().find((one) => one.name === name)
  /** @type {(name: string) => [number, number]} */
  const endsOf = (name) => /** @type {[number, number] | undefined} */ (values[name]?.slice(1, 3)) ?? controlOf(name).range

  const quantity = element("select.param-quantity", { ariaLabel: "Quantity", onchange: () => offer(null) })
  const part = element("select.param-part", { ariaLabel: "Which of its numbers" })
  const x = sideForm("x", endsOf, () => keepApart(y, x))
  const y = sideForm("y", endsOf, () => keepApart(x, y))
  const start = press("start", "Start", () => begin(wanted()), "Compute the chart")
  const stop = press("stop", "Stop", () => job.stop(), "Keep the cells so far")
  const out = press("out", "Zoom out", zoomOut, "The previous chart (minus key)")
  const save = press("save", "Save", keep, "Save the chart to a file")
  const file = element("input", { type: "file", accept: ".json,application/json", hidden: true, onchange: take })
  const load = press("load", "Load", () => file.click(), "Load a chart from a file")
  const close = press("close", "Close", hide, "Close the panel; the chart continues")
  const bar = element("progress", { ariaLabel: "Computed", max: 1 })
  const message = element("p.why", { role: "status" })
  const about = element("output.reading", { ariaLive: "polite" })
  const heading = element("h2", "Chart")
  const form = element("div.form", element("div.side", quantity, part), x.frame, y.frame)
  const map = chartCanvas(palettes, { pointed: read, chosen: open, boxed: closer })
  const picture = element("div.drawn", { hidden: true }, map.canvas, about)
  const panel = element("div.chart", { popover: "manual", role: "dialog", ariaLabel: "Chart", onkeydown },
    element("div.head", heading, close), form,
    element("div.row", start, stop, out, save, load, file, bar), message, picture)

  const job = chartJob((changed) => { if (changed === chart) follow() }, (sentence, place) => {
    const cell = map.cursor
    if (cell !== null && String(placeOf(chart, cell)) === String(place)) about.textContent = reading(chart, cell, sentence)
  })

  const described = () => scene.charts.find((one) => one.quantity === quantity.value)

  /**
   * Keep the parameters of both sides different.
   * @param {ReturnType<typeof sideForm>} other
   * @param {ReturnType<typeof sideForm>} moved
   */
  function keepApart(other, moved) {
    if (other.name !== moved.name) return
    const next = described().over.find((name) => name !== moved.name)
    other.choose(next, ...endsOf(next))
  }

  /**
   * Return [name, low, high] of the axes of a picture if both are parameters.
   * @param {string} name
   * @returns {[string, number, number][] | null}
   */
  function axesOf(name) {
    const plot = gallery.plot(name)?.model
    if (plot === undefined) return null
    const found = /** @type {[BokehModel, BokehRange][]} */ ([[plot.below[0], plot.x_range], [plot.left[0], plot.y_range]])
      .map(([axis, range]) => /** @type {[string, number, number]} */ ([
        numbers().find((one) => [one.name, one.symbol].includes(axis?.axis_label))?.name, range.start, range.end]))
    return found.every(([one]) => described().over.includes(one)) && found[0][0] !== found[1][0] ? found : null
  }

  /** Offer parameters for the sides: the axes of a picture, else the enabled controls. @param {string | null} pictureName */
  function offer(pictureName) {
    const { over, parts } = described()
    const offered = over.filter((name) => values[name]?.[4] !== true).map(controlOf).filter(Boolean)
    part.replaceChildren(...optionsOf(parts.map((name, i) => [String(i), name.replaceAll("_", " ")])))
    part.hidden = parts.length === 0
    for (const side of [x, y]) side.offer(offered)
    offerIf(start, offered.length >= 2, "this scene has no two parameters to chart over")
    if (start.disabled) return
    /** @type {[string, number, number][]} */
    const sides = axesOf(pictureName) ?? offered.slice(0, 2).map(({ name }) => [name, ...endsOf(name)])
    x.choose(...sides[0])
    y.choose(...sides[1])
  }

  /** Return the query of the state, with the default places that the link leaves out. */
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
    const { symbol, title, units, turn, parts, names } = described()
    const chosen = Number(part.value || 0)
    return {
      scene: scene.name, state: state(), quantity: quantity.value, part: chosen, title, units, turn,
      symbol: parts.length === 0 ? symbol : [...names[chosen].length > 0 ? [] : [symbol], part.selectedOptions[0].textContent].join(" "),
      names: names[chosen],
      x: x.value(), y: y.value(),
    }
  }

  /** Show another chart. @param {Chart} next */
  function turnTo(next) {
    chart = next
    fillForm()
    follow()
  }

  /** @param {ReturnType<typeof wanted>} next */
  function begin(next) {
    if (![next.x, next.y].every(({ low, high, count }) => Number.isFinite(low) && Number.isFinite(high) && Number.isInteger(count))) {
      message.textContent = "Give numbers for from, to and cells."
      return
    }
    /** @type {Chart} */
    const begun = { ...next, level: "", error: null, version: "", values: null, status: null, known: 0, share: 0, left: null, reason: "" }
    job.start(begun)
    turnTo(begun)
  }

  /** @param {ChartBox} box */
  function closer(box) {
    if (!(box.x[1] > box.x[0] && box.y[1] > box.y[0])) return
    /** @param {ChartAxis} one @param {number[]} ends */
    const side = (one, [low, high]) => ({ ...one, low, high })
    before.push(chart)
    begin({ ...chart, x: side(chart.x, box.x), y: side(chart.y, box.y) })
  }

  function zoomOut() {
    if (before.length === 0) return
    job.stop()
    turnTo(before.pop())
  }

  // The panel stands on the side where it covers less of the pictures that show its quantity.
  function stepAside() {
    const shown = described()?.pictures ?? []
    const charted = gallery.cellsInSight().filter((cell) => shown.includes(nameOf(cell)) || nameOf(cell) === gallery.pointed)
    const { width, left } = panel.getBoundingClientRect()
    const room = innerWidth
    /** @param {number} from */
    const covered = (from) => charted.map((cell) => cell.getBoundingClientRect())
      .reduce((sum, one) => sum + Math.max(0, Math.min(from + width, one.right) - Math.max(from, one.left)), 0)
    const isLeft = panel.classList.contains("aside")
    const gap = isLeft ? left : room - left - width
    panel.classList.toggle("aside", covered(gap) < covered(room - gap - width))
  }

  // The form describes the chart on show, if the chart belongs to this scene.
  function fillForm() {
    if (chart.scene !== scene.name) return
    quantity.value = chart.quantity
    offer(null)
    part.value = String(chart.part)
    for (const [side, { name, low, high, count }] of /** @type {[typeof x, ChartAxis][]} */ ([[x, chart.x], [y, chart.y]])) {
      side.choose(name, low, high, count)
    }
  }

  /** Show the reading of a cell; the server explains a cell without a number. @param {Cell | null} cell */
  function read(cell) {
    clearTimeout(resting)
    const isThere = cell !== null && chart?.values != null
    about.textContent = isThere ? reading(chart, cell) : ""
    if (isThere && isWithoutNumber(chart, cell)) resting = setTimeout(() => job.why(chart, placeOf(chart, cell)), REST)
  }

  /** Show the state of a cell, in its scene. @param {Cell} cell */
  function open(cell) { tell("restore", stateOf(chart, cell)) }

  /** @param {string} name */
  const numberOf = (name) => (name.includes(":") ? numberIn(new URLSearchParams(state()), name) : Number(values[name]?.[0]))

  // The ring at the state on show is dashed where another parameter differs from that of the chart.
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
    const ended = chart.reason || (isThere && chart.share < 1 ? "It was not computed to its end." : "")
    message.textContent = isRunning ? `${Math.floor(100 * chart.share)} % of ${size}${lasting(chart.left)}.`
      : `${size}${isThere ? ". " : ""}${ended}`
    map.show(chart)
    mark()
  }

  function keep() {
    // Files are named after the symbols of coordinates, without the slash of L/G.
    const [across, up] = [chart.x, chart.y].map(({ name, symbol }) => (name.includes(":") ? symbol.replaceAll("/", "") : name))
    saveFile(new Blob([toFile(chart)], { type: "application/json" }), `${chart.scene}-${chart.quantity}-${across}-${up}.json`)
  }

  async function take() {
    const [given] = file.files
    if (given === undefined) return
    turnToText(await given.text())
    file.value = ""
  }

  /** Show the chart in the text of a file. @param {string} text */
  function turnToText(text) {
    const { chart: found, why } = fromFile(text)
    if (why !== undefined) {
      message.textContent = why
      return
    }
    job.stop()
    before = []
    turnTo(found)
  }

  /** Open the chart that the server was started with, if there is one, and its state, unless the address names another one. */
  async function openServed() {
    const address = document.querySelector('meta[name="chart"]')?.getAttribute("content")
    if (address === undefined || address === null || window.top !== window) return
    const served = await fetch(new URL(address, document.baseURI))
    turnToText(await served.text())
    panel.showPopover()
    stepAside()
    if (chart !== null && !isStateGiven) tell("restore", chart.state)
  }

  function hide() {
    panel.hidePopover()
    opener?.focus()
  }

  // Enter, minus and plus act on the canvas.
  /** @param {KeyboardEvent} event */
  function onkeydown(event) {
    /** @type {Record<string, () => void>} */
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
    painted() {
      if (isFilled) return
      isFilled = true
      if (!isServed) openServed()
      isServed = true
      if (scene.charts.length > 0) offer(null)
      if (chart !== null) fillForm()
    },
  })
  follow()

  return {
    box: panel,
    /** @param {SceneDescription} description */
    show(description) {
      if (scene?.name === description.name) return
      scene = description
      values = {}
      isFilled = false
      const { charts } = scene
      quantity.replaceChildren(...optionsOf(charts.map((one) => [one.quantity, `${one.symbol}  ${one.title}`])))
      form.hidden = charts.length === 0
      offerIf(start, charts.length > 0, "this scene has nothing to chart")
      mark()
    },
    open() {
      if (panel.matches(":popover-open")) return hide()
      opener = /** @type {HTMLElement} */ (/** @type {ShadowRoot} */ (panel.getRootNode()).activeElement)
      const { charts } = scene
      if (charts.length > 0 && chart?.scene !== scene.name) {
        const large = new URLSearchParams(location.search).get("large")?.split(",")[0]
        const pointed = gallery.pointed ?? large
        quantity.value = (charts.find(({ pictures }) => pictures.includes(pointed)) ?? charts[0]).quantity
        offer(pointed)
      }
      if (chart === null) {
        message.textContent = charts.length > 0 ? "" : "This scene has nothing to chart: choose another one."
      }
      panel.showPopover()
      stepAside()
      ;(form.hidden ? load : start).focus()
    },
  }
}
