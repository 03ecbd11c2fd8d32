// The controls of the scene on show: a slider and a box for each number, a menu for each choice, one of examples.  Those
// that are essential come first, the others are folded in groups; on a phone one of them is at hand, chosen by its symbol.
// What the server says of all values comes by "controls": {name: [value, low, high, step,
// whether it is disabled] or option}.

import { listen, tell } from "../page/bus.js"
import { sayDragMe } from "../page/handle.js"
import { element, lifetime } from "../page/mount.js"
import { wear } from "../page/presenting.js"
import { PHONE } from "../page/windows.js"
import { comparison } from "./comparison.js"
import { menu } from "./menu.js"
import { number } from "./number.js"

function choice({ name, label, options, help }) {
  const plain = options.map((option) => [option, option])
  const [frame, show] = menu(name, label, plain, help, (option) => tell("change", { [name]: option }))
  return [element("div", {}, frame, element("p", { className: "text help", textContent: help })), show]
}

const EXAMPLES = "preset"

export function render({ model, view, el }) {
  const signal = lifetime({ model, view })
  const column = element("div", { className: "board" })
  const chooser = element("div", { className: "chooser", role: "group", "aria-label": "Control at hand" })
  el.append(chooser, column, comparison(signal))
  let shows = {}
  let refusals = {}
  // Groups that the user has unfolded, in every scene; the control at hand on a phone.
  const unfolded = new Set()
  let items = new Map()
  let atHand = EXAMPLES

  function take(name) {
    atHand = items.has(name) ? name : items.keys().next().value
    for (const [other, item] of items) item.classList.toggle("at-hand", other === atHand)
    for (const chip of chooser.children) chip.setAttribute("aria-pressed", String(chip.dataset.name === atHand))
  }

  function groupOf(name, members) {
    const group = element("details", { className: `group group-${name.toLowerCase()}` },
      element("summary", { textContent: name }), element("div", { className: "column" }, ...members))
    group.open = PHONE.matches || unfolded.has(name)
    group.addEventListener("toggle", () => {
      if (PHONE.matches) return
      if (group.open) unfolded.add(name)
      else unfolded.delete(name)
    })
    return group
  }

  function build(scene) {
    const [examples, showExample] = menu(EXAMPLES, "Example",
      [["Choose an example…", ""], ...scene.presets.map((name) => [name, name])],
      "States to begin with", (name) => { if (name !== "") tell("preset", name) })
    shows = { [EXAMPLES]: showExample }
    refusals = {}
    items = new Map([[EXAMPLES, examples]])
    const signs = new Map([[EXAMPLES, "Example"]])
    for (const control of scene.controls) {
      const [item, show, refuse] = control.kind === "number" ? number(control) : choice(control)
      shows[control.name] = show
      refusals[`error-${control.name}`] = refuse
      items.set(control.name, item)
      signs.set(control.name, control.symbol ?? control.label)
    }
    const essential = scene.essential.map((name) => items.get(name))
    const groups = scene.groups.map((group) => [group, scene.controls.filter((control) => (
      control.group === group && !scene.essential.includes(control.name))).map(({ name }) => items.get(name))])
    column.replaceChildren(
      element("div", { className: "column" }, examples, ...essential),
      ...groups.filter(([, members]) => members.length > 0).map(([group, members]) => groupOf(group, members)))
    const order = [...scene.essential, EXAMPLES, ...[...items.keys()].filter((name) => (
      name !== EXAMPLES && !scene.essential.includes(name)))]
    chooser.replaceChildren(...order.map((name) => {
      const chip = element("button", { type: "button", className: "chip", textContent: signs.get(name) })
      chip.dataset.name = name
      chip.classList.toggle("further", !scene.essential.includes(name))
      chip.addEventListener("click", () => take(name))
      return chip
    }))
    take(scene.essential.includes(atHand) ? atHand : order[0])
  }
  const show = (values) => {
    for (const [name, value] of Object.entries(values)) shows[name]?.(value)
  }
  PHONE.addEventListener("change", () => {
    for (const group of column.querySelectorAll(".group")) {
      group.open = PHONE.matches || unfolded.has(group.firstChild.textContent)
    }
  }, { signal })
  wear(el, signal)
  // Beside the thumb of the slider, where there is room.
  sayDragMe(({ control }) => {
    const item = items.get(control)
    if (!item?.checkVisibility()) return null
    const { min, max, value } = item.querySelector(".hand")
    const share = 100 * (value - min) / (max - min)
    const place = share < 60 ? { left: `calc(${share}% + 1.4em)` } : { right: `calc(${100 - share}% + 1.4em)` }
    return { host: item, place: () => place }
  }, signal)
  listen("enter", build, signal)
  // What is wrong with an expression is said by "error-" and the name of the number.
  listen("texts", (texts) => { for (const [key, text] of Object.entries(texts)) refusals[key]?.(text) }, signal)
  listen("controls", show, signal)
  tell("mounted", { kind: "scene", show: build })
  tell("mounted", { kind: "controls", show })
}
