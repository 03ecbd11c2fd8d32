// A number: a slider for the hand, with a box ("box.js"), a label to be dragged and a button that moves it to and fro.

import { tell } from "../page/bus.js"
import { element } from "../page/mount.js"
import { animation } from "./animation.js"
import { exactBox } from "./box.js"
import { scrub } from "./scrub.js"

const IDLE = "Disabled: under the choices made it changes nothing."
const ARROWS = { ArrowUp: 1, ArrowRight: 1, ArrowDown: -1, ArrowLeft: -1 }
// Of a slider without steps.
const PARTS = 400

// 0.1 + 0.2 as it would be typed.
const tidy = (value) => Number(value.toPrecision(12))

// Where less than this share of a slider is possible, the slider shows that part only.
const LEAST_SHARE = 1 / 8

// [low, high] of the slider's scale.  It is the parameter's own, whatever the others are: then the thumb of a slider
// that nobody touches stays where it is, and what is possible is drawn on the track.
export function scaleOf([own, end], low, high, value) {
  const [from, to] = high - low < LEAST_SHARE * (end - own) ? [low, high] : [Math.min(own, low), Math.max(end, high)]
  return [Math.min(from, value), Math.max(to, value)]
}

// [element, show([value, low, high, step, whether it is disabled]), refuse(sentence on the expression)].
export function number({ name, label, symbol, help, range }) {
  const title = element("span", { className: "label scrub", textContent: label, title: help })
  const slider = element("input", {
    type: "range", className: "hand", title: help, "aria-label": label, "aria-description": help,
  })
  let shown = null
  let [low, high] = range
  const change = (value) => {
    shown = value
    exact.forget()
    tell("change", { [name]: value })
  }
  // Slider and box follow, as after a drag.
  const take = (value) => {
    if (value === shown) return
    slider.value = value
    exact.put(value)
    change(value)
  }
  const within = (value) => Math.min(Math.max(tidy(value), low), high)
  const stepOf = () => Number(slider.step) || (high - low) / PARTS
  const exact = exactBox({
    name, symbol, help, value: () => shown, change, nudge: (value) => take(tidy(value)), stepOf,
  })
  slider.addEventListener("input", () => {
    const value = Math.min(Math.max(Number(slider.value), low), high)
    if (value !== Number(slider.value)) slider.value = value
    exact.put(value)
    change(value)
  })
  slider.addEventListener("keydown", (event) => {
    if (!event.shiftKey || !(event.key in ARROWS)) return
    take(within(shown + 10 * ARROWS[event.key] * stepOf()))
    event.preventDefault()
  })
  scrub(title, {
    limits: () => [low, high], stepOf, value: () => shown, move: (value) => take(within(value)), isIdle: () => slider.disabled,
  })
  const frame = element("div", { className: `number param-${name}` })
  const [sway, pace] = animation(frame, symbol, () => [low, high, shown], (value) => (
    take(within(Math.round(value / stepOf()) * stepOf()))))
  const moves = sway.title
  frame.append(title, pace, sway, exact.box, slider)

  const rest = (idle) => {
    if (idle === slider.disabled) return
    const why = idle ? `${IDLE} ${help}` : ""
    slider.disabled = sway.disabled = idle
    exact.rest(why)
    title.classList.toggle("scrub", !idle)
    title.title = slider.title = why || help
    sway.title = why || moves
    slider.setAttribute("aria-description", why || help)
  }
  let track = ""
  const show = ([value, from, to, step, idle = false]) => {
    rest(idle)
    exact.show(shown, value, idle)
    shown = value
    ;[low, high] = [Math.min(from, value), Math.max(to, value)]
    const [start, end] = scaleOf(range, from, to, value)
    slider.min = start
    slider.max = end
    slider.step = step
    slider.value = value
    const parts = [low, high].map((edge) => `${(100 * (edge - start) / (end - start)).toFixed(2)}%`)
    if (track !== (track = parts.join())) {
      slider.style.setProperty("--from", parts[0])
      slider.style.setProperty("--to", parts[1])
      Object.assign(slider.dataset, { low, high })
    }
  }
  return [frame, show, exact.refuse]
}
