// @ts-check
// The controls of the scene on show: a slider and a box for each number, a menu for each choice, and a menu of examples.
// Essential controls come first, the others in groups that unfold.  A phone shows one control at a time, chosen by its symbol.

import { button, element } from "../base/elements.js"
import { listen, tell } from "../base/bus.js"
import { sayDragMe } from "../base/handle.js"
import { gallery } from "../pictures/gallery.js"
import { nameOf } from "../pictures/picture.js"
import { comparison } from "./comparison.js"
import { control, followers, menu, twice } from "./control.js"

const EXAMPLES = "preset"

/** Render the controls. @param {{el: HTMLElement}} part */
export function render({ el }) {
  const column = element("div.board")
  const chooser = element("div.chooser", { role: "group", ariaLabel: "Current control" })
  el.append(chooser, column, comparison())
  const put = followers()
  // Groups that the user has unfolded in any scene.
  const unfolded = new Set()
  /** @type {Map<string, HTMLElement>} */
  let items = new Map()
  // The control shown on a phone.
  let atHand = EXAMPLES

  /** @param {string} name */
  function take(name) {
    atHand = items.has(name) ? name : items.keys().next().value
    for (const [other, item] of items) item.classList.toggle("at-hand", other === atHand)
    for (const chip of /** @type {Iterable<HTMLElement>} */ (chooser.children)) {
      chip.ariaPressed = String(chip.dataset.name === atHand)
    }
  }

  /** @param {string} name @param {HTMLElement[]} members */
  function groupOf(name, members) {
    const group = element(`details.group.group-${name.toLowerCase()}`, {
      open: unfolded.has(name), hidden: name === "Chart",
      ontoggle: () => {
        if (group.open) unfolded.add(name)
        else unfolded.delete(name)
      },
    }, element("summary", name), element("div.column", ...members))
    return group
  }

  /** @param {SceneDescription} scene */
  function build(scene) {
    /** @param {string} name */
    const isEssential = (name) => scene.essential.includes(name)
    const example = menu(EXAMPLES, "Example", [["", "Choose an example…"], ...twice(scene.presets)],
      "Examples to start from", (name) => { if (name !== "") tell("preset", name) })
    const parts = { [EXAMPLES]: example, ...Object.fromEntries(scene.controls.map((one) => [one.name, control(one)])) }
    put(parts)
    items = new Map(Object.entries(parts).map(([name, { item }]) => [name, item]))
    const signs = new Map([[EXAMPLES, "Example"], ...scene.controls.map(
      ({ name, symbol, label }) => /** @type {[string, string]} */ ([name, symbol ?? label]))])
    const further = scene.controls.filter(({ name }) => !isEssential(name))
    const groups = scene.groups
      .map((group) => /** @type {[string, ControlDescription[]]} */ ([group, further.filter((control) => control.group === group)]))
      .filter(([, members]) => members.length > 0)
    example.item.hidden = scene.presets.length === 0
    column.replaceChildren(
      element("div.column", example.item, ...scene.essential.map((name) => items.get(name))),
      ...groups.map(([group, members]) => groupOf(group, members.map(({ name }) => items.get(name)))))
    const order = [...scene.essential, ...(example.item.hidden ? [] : [EXAMPLES]), ...further.map(({ name }) => name)]
    chooser.replaceChildren(...order.map((name) => button(isEssential(name) ? "chip" : "chip.further", () => take(name), {
      dataset: { name },
    }, signs.get(name))))
    chooser.hidden = order.length === 0
    if (order.length > 0) take(isEssential(atHand) ? atHand : order[0])
  }
  // Show the choices of the chart only with the chart.
  function showCharts() {
    const hidden = !gallery.openCells().some((cell) => nameOf(cell) === "chart")
    for (const item of /** @type {NodeListOf<HTMLElement>} */ (el.querySelectorAll('.group-chart, [data-name^="chart"]'))) {
      if (item instanceof HTMLDetailsElement && item.hidden && !hidden) item.open = true
      item.hidden = hidden
    }
  }
  // Place the sign beside the thumb of the slider, on the side with more room.
  sayDragMe((/** @type {{control: string}} */ { control }) => {
    const item = items.get(control)
    if (!item?.checkVisibility()) return null
    /** @type {HTMLInputElement} */
    const { min, max, valueAsNumber: value } = item.querySelector(".hand")
    const share = 100 * (value - Number(min)) / (Number(max) - Number(min))
    const place = share < 60 ? { left: `calc(${share}% + 1.4em)` } : { right: `calc(${100 - share}% + 1.4em)` }
    return { host: item, place: () => place }
  })
  listen({
    enter: build,
    painted: showCharts,
    folded: showCharts,
  })
}
