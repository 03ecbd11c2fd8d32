// @ts-check
// The control of a number: a slider, a box for exact values ("box.js"), and a label that can be dragged.

import { tell } from "../base/bus.js"
import { onDrag } from "../base/drag.js"
import { arrowOf } from "../base/keys.js"
import { within } from "../base/numbers.js"
import { element, update } from "../base/elements.js"
import { exactBox } from "./box.js"

const IDLE = "Disabled: no effect with the current choices."
// Number of steps of a slider without a step size.
const PARTS = 400

// Pixels of a drag of the label over the whole range, unless steps are longer.
const FULL_DRAG = 400

// Rounding turns 0.1 + 0.2 into 0.3.
/** @param {number} value */
const tidy = (value) => Number(value.toPrecision(12))

// Where less than this share of the scale is possible, the slider shows only the possible part.
const LEAST_SHARE = 1 / 8

/**
 * Return [low, high] of the slider.  The scale is that of the parameter, so that the thumb stays in place when other parameters
 * change; the track shows the possible part.
 * @param {[number, number]} own
 * @param {number} low
 * @param {number} high
 * @param {number} value
 */
function scaleOf([own, end], low, high, value) {
  const [from, to] = high - low < LEAST_SHARE * (end - own) ? [low, high] : [Math.min(own, low), Math.max(end, high)]
  return [Math.min(from, value), Math.max(to, value)]
}

/**
 * Return the control.
 * @param {Extract<ControlDescription, {kind: "number"}>} description
 * @returns {import("./control.js").Control}
 */
export function number({ name, label, symbol, help, range }) {
  /** @type {number | null} */
  let shown = null
  let [low, high] = range
  let track = ""
  // Slider and box follow, as during a drag.
  /** @param {number} value */
  const take = (value) => {
    slider.valueAsNumber = value
    if (value === shown) return
    exact.put(value)
    change(value)
  }
  /** @param {number} value */
  const change = (value) => {
    shown = value
    tell("change", { [name]: value })
  }
  /** @param {number} value */
  const move = (value) => take(within(tidy(value), low, high))
  const stepOf = () => Number(slider.step) || (high - low) / PARTS

  const title = element("span.label.scrub", { title: help }, label)
  const slider = element("input.hand", {
    type: "range", title: help, ariaLabel: label, ariaDescription: help,
    oninput: () => take(within(slider.valueAsNumber, low, high)),
    /** @param {KeyboardEvent} event */
    onkeydown(event) {
      const arrow = arrowOf(event)
      if (!event.shiftKey || arrow === undefined) return
      move(shown + 10 * (arrow[0] + arrow[1]) * stepOf())
      event.preventDefault()
    },
  })
  const exact = exactBox({ name, symbol, help, stepOf, change, value: () => shown, nudge: (value) => take(tidy(value)) })
  onDrag(title, ({ button, clientX }) => (slider.disabled || button !== 0 ? null : [clientX, shown]),
    ([x, from], { clientX, shiftKey }) => {
      const step = stepOf()
      const steps = Math.max(1, Math.round((high - low) / FULL_DRAG / step)) * (shiftKey ? 10 : 1)
      move(from + Math.round(clientX - x) * steps * step)
    })
  const frame = element(`div.number.param-${name}`, title, exact.box, slider, exact.why)

  /** @param {boolean} idle */
  const rest = (idle) => {
    if (idle === slider.disabled) return
    const why = idle ? `${IDLE} ${help}` : ""
    slider.disabled = idle
    exact.rest(why)
    title.classList.toggle("scrub", !idle)
    title.title = slider.title = slider.ariaDescription = why || help
  }
  /** @type {(value: [number, number, number, number, boolean?]) => void} */
  const show = ([value, from, to, step, idle = false]) => {
    rest(idle)
    exact.show(shown, value, idle)
    shown = value
    ;[low, high] = [Math.min(from, value), Math.max(to, value)]
    const [min, max] = scaleOf(range, from, to, value)
    update(slider, { min: String(min), max: String(max), step: String(step), value: String(value) })
    const parts = [low, high].map((edge) => `${(100 * (edge - min) / (max - min)).toFixed(2)}%`)
    if (track !== (track = parts.join())) {
      slider.style.setProperty("--from", parts[0])
      slider.style.setProperty("--to", parts[1])
      Object.assign(slider.dataset, { low, high })
    }
  }
  /** @param {number} value */
  const follow = (value) => {
    if (value === shown) return
    shown = value
    slider.valueAsNumber = value
    exact.put(tidy(value))
  }
  return { item: frame, show, refuse: exact.refuse, limit: exact.limit, follow }
}
