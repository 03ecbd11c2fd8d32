// A number: a slider for the hand, a box for exact values and expressions, which the server reads.  Its label is dragged,
// too; arrows move it by steps, by ten with Shift; a button moves it to and fro.

import { tell } from "../page/bus.js"
import { element } from "../page/mount.js"
import { animation } from "./animation.js"

const IDLE = "Disabled: under the choices made it changes nothing."
const TYPE = "Type an exact value or an expression such as pi/3, and press Enter."

// A label that is dragged across so many pixels goes from end to end, where steps are not longer.
const FULL_DRAG = 400
const ARROWS = { ArrowUp: 1, ArrowRight: 1, ArrowDown: -1, ArrowLeft: -1 }

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
  const box = element("input", {
    type: "text", inputMode: "decimal", spellcheck: false, title: `${help} ${TYPE}`,
    "aria-label": `${symbol}, exact value`, className: "exact",
  })
  const slider = element("input", {
    type: "range", className: "hand", title: help, "aria-label": label, "aria-description": help,
  })
  let shown = null
  let [low, high] = range
  let isAsked = false
  const change = (value) => {
    shown = value
    isAsked = false
    tell("change", { [name]: value })
  }
  // Both follow, as after a drag.
  const take = (value) => {
    if (value === shown) return
    slider.value = value
    box.value = String(value)
    box.setCustomValidity("")
    box.removeAttribute("aria-invalid")
    change(value)
  }
  const within = (value) => Math.min(Math.max(tidy(value), low), high)
  const stepOf = () => Number(slider.step) || (high - low) / FULL_DRAG
  slider.addEventListener("input", () => {
    const value = Math.min(Math.max(Number(slider.value), low), high)
    if (value !== Number(slider.value)) slider.value = value
    box.value = String(value)
    change(value)
  })
  box.addEventListener("change", () => {
    const text = box.value.trim().replaceAll("−", "-").replace(",", ".")
    const value = Number(text)
    const valid = text !== "" && Number.isFinite(value)
    if (text !== "" && !valid) {
      isAsked = true
      return tell("expression", { [name]: text })
    }
    box.setAttribute("aria-invalid", String(!valid))
    box.setCustomValidity(valid ? "" : "This is not a number: type one like 1.5, 1e-8 or pi/3.")
    if (!valid) box.reportValidity()
    else if (value !== shown) change(value)
    // As the server will write it: from here on another text is one that is being typed.
    if (valid) box.value = String(value)
  })
  box.addEventListener("input", () => box.setCustomValidity(""))
  box.addEventListener("keydown", (event) => {
    // While a text is typed the browser itself undoes.
    if ((event.ctrlKey || event.metaKey) && box.value !== String(shown)) event.stopPropagation()
    if (event.key === "ArrowUp" || event.key === "ArrowDown") {
      const typed = Number(box.value.trim().replaceAll("−", "-").replace(",", "."))
      const from = box.value.trim() !== "" && Number.isFinite(typed) ? typed : shown
      take(tidy(from + ARROWS[event.key] * stepOf() * (event.shiftKey ? 10 : 1)))
      event.preventDefault()
    }
    if (event.key !== "Escape") return
    // Whatever the server says of it now.
    isAsked = false
    box.value = String(shown)
    box.setCustomValidity("")
    box.removeAttribute("aria-invalid")
    event.preventDefault()
  })
  slider.addEventListener("keydown", (event) => {
    if (!event.shiftKey || !(event.key in ARROWS)) return
    take(within(shown + 10 * ARROWS[event.key] * stepOf()))
    event.preventDefault()
  })
  let grabbed = null
  title.addEventListener("pointerdown", (event) => {
    if (slider.disabled || event.button !== 0) return
    title.setPointerCapture(event.pointerId)
    grabbed = [event.clientX, shown]
  })
  title.addEventListener("pointermove", (event) => {
    if (grabbed === null) return
    const steps = Math.max(1, Math.round((high - low) / FULL_DRAG / stepOf())) * (event.shiftKey ? 10 : 1)
    take(within(grabbed[1] + Math.round(event.clientX - grabbed[0]) * steps * stepOf()))
  })
  for (const event of ["pointerup", "pointercancel"]) title.addEventListener(event, () => { grabbed = null })
  const frame = element("div", { className: `number param-${name}` })
  const [sway, pace] = animation(frame, symbol, () => [low, high, shown], (value) => (
    take(within(Math.round(value / stepOf()) * stepOf()))))
  frame.append(title, pace, sway, box, slider)
  const rest = (idle) => {
    if (idle === box.disabled) return
    box.disabled = slider.disabled = sway.disabled = idle
    title.classList.toggle("scrub", !idle)
    const says = idle ? `${IDLE} ${help}` : help
    title.title = slider.title = says
    box.title = idle ? says : `${help} ${TYPE}`
    sway.title = idle ? says : `Move ${symbol} to and fro`
    slider.setAttribute("aria-description", says)
  }
  let track = ""
  const show = ([value, from, to, step, idle = false]) => {
    rest(idle)
    // States may come while a number is typed, piece by piece of a section: they leave it alone.
    const typing = !isAsked && box.getRootNode().activeElement === box && box.value !== String(shown)
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
    if (typing) return
    isAsked = false
    // Nobody can look along a disabled box for digits that it has no room for.
    box.value = String(idle ? Number(value.toPrecision(6)) : value)
    box.removeAttribute("aria-invalid")
  }
  const refuse = (sentence) => {
    if (!isAsked) return
    isAsked = false
    box.setAttribute("aria-invalid", "true")
    box.setCustomValidity(sentence)
    if (box.getRootNode().activeElement === box) box.reportValidity()
  }
  return [frame, show, refuse]
}
