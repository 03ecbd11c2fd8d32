// The controls of the scene on show: a slider and a box for each number, a menu for each choice, one of examples.  Those
// that are essential come first, the others are folded in groups; on a phone one of them is at hand, chosen by its symbol.
// What the server says of all values comes by "controls": {name: [value, low, high, step,
// whether it is disabled] or option}.

import { button, element } from "../page/elements.js"
import { listen, tell } from "../page/bus.js"
import { sayDragMe } from "../page/handle.js"
import { PHONE } from "../page/windows.js"
import { comparison } from "./comparison.js"
import { optionsOf } from "./dialog.js"
import { number } from "./number.js"

const twice = (names) => names.map((name) => [name, name])

/**
 * Return [element, show(value)].
 * @param {string} name
 * @param {string} label
 * @param {[string, string][]} options value and text of each
 * @param {string} help
 * @param {(value: string) => void} choose
 */
function menu(name, label, options, help, choose) {
  const select = element("select", { title: help, ariaLabel: label, onchange: () => choose(select.value) }, ...optionsOf(options))
  const frame = element(`label.menu.param-${name}`, element("span", label), select)
  // The name of what is chosen may be longer than its place.
  const show = (option) => {
    select.value = option
    select.title = option === "" ? help : `${select.selectedOptions[0]?.textContent ?? option}. ${help}`
  }
  return [frame, show]
}

// [element, show(option)].
function choice({ name, label, options, help }) {
  const [frame, show] = menu(name, label, twice(options), help, (option) => tell("change", { [name]: option }))
  return [element("div", frame, element("p.text.help", help)), show]
}

const EXAMPLES = "preset"

export function render({ el }) {
  const column = element("div.board")
  const chooser = element("div.chooser", { role: "group", ariaLabel: "Control at hand" })
  el.append(chooser, column, comparison())
  let shows = {}
  let refusals = {}
  // Groups that the user has unfolded, in every scene; the control at hand on a phone.
  const unfolded = new Set()
  let items = new Map()
  let atHand = EXAMPLES

  function take(name) {
    atHand = items.has(name) ? name : items.keys().next().value
    for (const [other, item] of items) item.classList.toggle("at-hand", other === atHand)
    for (const chip of chooser.children) chip.ariaPressed = chip.dataset.name === atHand
  }

  function groupOf(name, members) {
    const group = element(`details.group.group-${name.toLowerCase()}`,
      element("summary", name), element("div.column", ...members))
    group.open = PHONE.matches || unfolded.has(name)
    group.addEventListener("toggle", () => {
      if (PHONE.matches) return
      if (group.open) unfolded.add(name)
      else unfolded.delete(name)
    })
    return group
  }

  function build(scene) {
    const isEssential = (name) => scene.essential.includes(name)
    const [examples, showExample] = menu(EXAMPLES, "Example", [["", "Choose an example…"], ...twice(scene.presets)],
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
    const further = scene.controls.filter(({ name }) => !isEssential(name))
    const groups = scene.groups.map((group) => [group, further.filter((control) => control.group === group)])
      .filter(([, members]) => members.length > 0)
    column.replaceChildren(
      element("div.column", examples, ...scene.essential.map((name) => items.get(name))),
      ...groups.map(([group, members]) => groupOf(group, members.map(({ name }) => items.get(name)))))
    const order = [...scene.essential, EXAMPLES, ...further.map(({ name }) => name)]
    chooser.replaceChildren(...order.map((name) => button(isEssential(name) ? "chip" : "chip.further", () => take(name), {
      dataset: { name },
    }, signs.get(name))))
    take(isEssential(atHand) ? atHand : order[0])
  }
  const show = (values) => {
    for (const [name, value] of Object.entries(values)) shows[name]?.(value)
  }
  PHONE.addEventListener("change", () => {
    for (const group of column.querySelectorAll(".group")) {
      group.open = PHONE.matches || unfolded.has(group.firstChild.textContent)
    }
  })
  // Beside the thumb of the slider, where there is room.
  sayDragMe(({ control }) => {
    const item = items.get(control)
    if (!item?.checkVisibility()) return null
    const { min, max, value } = item.querySelector(".hand")
    const share = 100 * (value - min) / (max - min)
    const place = share < 60 ? { left: `calc(${share}% + 1.4em)` } : { right: `calc(${100 - share}% + 1.4em)` }
    return { host: item, place: () => place }
  })
  listen({
    enter: build,
    // "error-" and the name of a number: why its expression is refused.
    texts(texts) { for (const [key, text] of Object.entries(texts)) refusals[key]?.(text) },
    controls: show,
  })
}
