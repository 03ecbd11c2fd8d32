// A number: a slider for the hand, with a box ("box.js"), a label to be dragged and a button that moves it to and fro.

import { tell } from "../page/bus.js"
import { arrowOf } from "../page/keys.js"
import { element } from "../page/mount.js"
import { animation } from "./animation.js"
import { exactBox } from "./box.js"
import { scrub } from "./scrub.js"

const IDLE = "Disabled: under the choices made it changes nothing."
// Of a slider without steps.
const PARTS = 400

// 0.1 + 0.2 as it would be typed.
const tidy = (value) => Number(value.toPrecision(12))

// Where less than this share of a slider is possible, the slider shows that part only.
const LEAST_SHARE = 1 / 8

/**
 * Return [low, high] of the slider's scale.  It is the parameter's own, whatever the others are: then the thumb of a slider
 * that nobody touches stays where it is, and what is possible is drawn on the track.
 */
export function scaleOf([own, end], low, high, value) {
  const [from, to] = high - low < LEAST_SHARE * (end - own) ? [low, high] : [Math.min(own, low), Math.max(end, high)]
  return [Math.min(from, value), Math.max(to, value)]
}

/**
 * Return [element, show([value, low, high, step, whether it is disabled]), refuse(sentence on the expression)].
 * @param {{name: string, label: string, symbol: string, help: string, range: [number, number]}} description
 */
export function number({ name, label, symbol, help, range }) {
  const title = element("span", { className: "label scrub", textContent: label, title: help })
  const slider = element("input", { type: "range", className: "hand", title: help, ariaLabel: label, ariaDescription: help })
  let shown = null
  let [low, high] = range
  const value = () => shown
  const stepOf = () => Number(slider.step) || (high - low) / PARTS
  const within = (wanted) => Math.min(Math.max(wanted, low), high)
  const change = (wanted) => {
    shown = wanted
    exact.forget()
    tell("change", { [name]: wanted })
  }
  // Slider and box follow, as after a drag.
  const take = (wanted) => {
    if (wanted === shown) return
    slider.value = wanted
    exact.put(wanted)
    change(wanted)
  }
  const move = (wanted) => take(within(tidy(wanted)))
  const exact = exactBox({ name, symbol, help, value, change, nudge: (wanted) => take(tidy(wanted)), stepOf })
  slider.addEventListener("input", () => {
    const wanted = within(Number(slider.value))
    if (wanted !== Number(slider.value)) slider.value = wanted
    exact.put(wanted)
    change(wanted)
  })
  slider.addEventListener("keydown", (event) => {
    const arrow = arrowOf(event)
    if (!event.shiftKey || arrow === undefined) return
    move(shown + 10 * (arrow[0] + arrow[1]) * stepOf())
    event.preventDefault()
  })
  scrub(title, { limits: () => [low, high], stepOf, value, move, isIdle: () => slider.disabled })
  const frame = element("div", { className: `number param-${name}` })
  const [sway, pace] = animation(frame, symbol, () => [low, high, shown], (wanted) => (
    move(Math.round(wanted / stepOf()) * stepOf())))
  const moves = sway.title
  frame.append(title, pace, sway, exact.box, slider)

  const rest = (idle) => {
    if (idle === slider.disabled) return
    const why = idle ? `${IDLE} ${help}` : ""
    slider.disabled = sway.disabled = idle
    exact.rest(why)
    title.classList.toggle("scrub", !idle)
    title.title = slider.title = slider.ariaDescription = why || help
    sway.title = why || moves
  }
  let track = ""
  const show = ([wanted, from, to, step, idle = false]) => {
    rest(idle)
    exact.show(shown, wanted, idle)
    shown = wanted
    ;[low, high] = [Math.min(from, wanted), Math.max(to, wanted)]
    const [min, max] = scaleOf(range, from, to, wanted)
    Object.assign(slider, { min, max, step, value: wanted })
    const parts = [low, high].map((edge) => `${(100 * (edge - min) / (max - min)).toFixed(2)}%`)
    if (track !== (track = parts.join())) {
      slider.style.setProperty("--from", parts[0])
      slider.style.setProperty("--to", parts[1])
      Object.assign(slider.dataset, { low, high })
    }
  }
  return [frame, show, exact.refuse]
}
