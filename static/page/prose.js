// @ts-check
// The legend or the words of the scene on show, as HTML from the project's own files.

import { listen } from "../base/bus.js"
import { depthMenu } from "./depth.js"
import { element, update } from "../base/elements.js"

/**
 * Show the entries of a legend whose numbers are listed.
 * @param {HTMLElement} box
 * @param {string} signs numbers separated by commas
 */
function showSigns(box, signs) {
  const there = new Set(signs.split(","))
  /** @type {NodeListOf<HTMLElement>} */
  const entries = box.querySelectorAll(".legend li")
  entries.forEach((entry, i) => update(entry, { hidden: !there.has(String(i)) }))
}

/**
 * Render the legend or the words.
 * @param {{part: "legend" | "words", el: HTMLElement}} part
 */
export function render({ part, el }) {
  const item = element(`div.${part}`)
  // Formulas and tables that scroll by themselves are reached with the keyboard.
  new ResizeObserver(() => {
    for (const wide of /** @type {NodeListOf<HTMLElement>} */ (item.querySelectorAll('math[display="block"], table'))) {
      wide.tabIndex = wide.scrollWidth > wide.clientWidth ? 0 : -1
      wide.ariaLabel = wide.tabIndex < 0 ? null : wide.matches("table") ? "Table" : "Formula"
    }
  }).observe(item)
  const depth = part === "words" ? depthMenu(item) : null
  listen({
    enter(scene) {
      item.innerHTML = scene[part]
      depth?.follow()
    },
    texts({ signs }) { if (signs !== undefined) showSigns(item, signs) },
    // A lesson takes the place of the words.
    reading(on) { if (depth !== null) item.hidden = depth.menu.hidden = on },
  })
  if (depth !== null) el.append(depth.menu)
  el.append(item)
}
