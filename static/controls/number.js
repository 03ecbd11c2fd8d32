// A number: a slider for the hand, a box for exact values.

import { tell } from "../page/bus.js"
import { element } from "../page/mount.js"

const IDLE = "Disabled: under the choices made it changes nothing."

// Where less than this share of a slider is possible, the slider shows that part only.
const LEAST_SHARE = 1 / 8

// [low, high] of the slider's scale.  It is the parameter's own, whatever the others are: then the thumb of a slider
// that nobody touches stays where it is, and what is possible is drawn on the track.
export function scaleOf([own, end], low, high, value) {
  const [from, to] = high - low < LEAST_SHARE * (end - own) ? [low, high] : [Math.min(own, low), Math.max(end, high)]
  return [Math.min(from, value), Math.max(to, value)]
}

// [element, show([value, low, high, step, whether it is disabled])].
export function number({ name, label, symbol, help, range }) {
  const title = element("span", { className: "label", textContent: label, title: help })
  const box = element("input", {
    type: "text", inputMode: "decimal", spellcheck: false, title: `${help} Type an exact value and press Enter.`,
    "aria-label": `${symbol}, exact value`, className: "exact",
  })
  const slider = element("input", {
    type: "range", className: "hand", title: help, "aria-label": label, "aria-description": help,
  })
  let shown = null
  let [low, high] = range
  const change = (value) => {
    shown = value
    tell("change", { [name]: value })
  }
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
    box.setAttribute("aria-invalid", String(!valid))
    box.setCustomValidity(valid ? "" : "This is not a number: type one like 1.5 or 1e-8.")
    if (!valid) box.reportValidity()
    else if (value !== shown) change(value)
    // As the server will write it: from here on another text is one that is being typed.
    if (valid) box.value = String(value)
  })
  box.addEventListener("input", () => box.setCustomValidity(""))
  box.addEventListener("keydown", (event) => {
    // While a text is typed the browser itself undoes.
    if ((event.ctrlKey || event.metaKey) && box.value !== String(shown)) event.stopPropagation()
    if (event.key !== "Escape") return
    box.value = String(shown)
    box.setCustomValidity("")
    box.removeAttribute("aria-invalid")
    event.preventDefault()
  })
  const frame = element("div", { className: `number param-${name}` }, title, box, slider)
  const rest = (idle) => {
    if (idle === box.disabled) return
    box.disabled = slider.disabled = idle
    const says = idle ? `${IDLE} ${help}` : help
    title.title = slider.title = says
    slider.setAttribute("aria-description", says)
  }
  let track = ""
  const show = ([value, from, to, step, idle = false]) => {
    rest(idle)
    // States may come while a number is typed, piece by piece of a section: they leave it alone.
    const typing = box.getRootNode().activeElement === box && box.value !== String(shown)
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
    // Nobody can look along a disabled box for digits that it has no room for.
    box.value = String(idle ? Number(value.toPrecision(6)) : value)
    box.removeAttribute("aria-invalid")
  }
  return [frame, show]
}
