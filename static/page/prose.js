// @ts-check
// The legend or the text of the scene on show, as HTML from the project's own files.  The browser remembers how much of the text
// is shown: the idea, the level of a student, or everything in the paper.

import { listen } from "../base/bus.js"
import { element, update } from "../base/elements.js"
import { browserStore } from "../base/stores.js"
import { byHand } from "../base/modes.js"

/** @type {[value: string, text: string][]} */
const DEPTHS = [["idea", "Idea"], ["student", "What you see"], ["paper", "With equations"]]
const ALL = "paper"

/**
 * Return the menu of depths of a text.
 * @param {HTMLElement} text its first section describes the pictures, its first paragraph the idea
 */
function depthMenu(text) {
  const select = element("select", {
    ariaLabel: "Depth of the text", title: "How much of the text is shown, in every scene",
    onchange: () => {
      browserStore.set("depth", select.value)
      follow()
    },
  }, ...DEPTHS.map(([value, words]) => new Option(words, value)))
  select.value = DEPTHS.find(([value]) => value === browserStore.get("depth"))?.[0] ?? ALL

  // See "page.css".
  function follow() { text.dataset.depth = select.value }

  follow()
  return element("label.depth", select)
}

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
  // Make formulas and tables that scroll reachable with the keyboard.
  new ResizeObserver(() => {
    for (const wide of /** @type {NodeListOf<HTMLElement>} */ (item.querySelectorAll('math[display="block"], table'))) {
      wide.tabIndex = wide.scrollWidth > wide.clientWidth ? 0 : -1
      wide.ariaLabel = wide.tabIndex < 0 ? null : wide.matches("table") ? "Table" : "Formula"
    }
  }).observe(item)
  const menu = part === "words" ? depthMenu(item) : null
  listen({
    enter(scene) { item.innerHTML = byHand(scene[part]) },
    texts({ signs }) { if (signs !== undefined) showSigns(item, signs) },
    // A lesson takes the place of the words.
    reading(on) { if (menu !== null) item.hidden = menu.hidden = on },
  })
  if (menu !== null) el.append(menu)
  el.append(item)
}
