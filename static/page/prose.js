// HTML of the scene on show, from the project's own files: its legend or its words.

import { listen } from "./bus.js"
import { element } from "./elements.js"

// Of the entries of a legend, show those whose numbers are there.
export function showSigns(box, signs) {
  const there = new Set(signs.split(","))
  for (const [i, entry] of box.querySelectorAll(".legend li").entries()) entry.hidden = !there.has(String(i))
}

export function render({ part, el }) {
  const item = element(`div.${part}`)
  // A formula or a table that scrolls by itself is reached by the keyboard.
  new ResizeObserver(() => {
    for (const wide of item.querySelectorAll('math[display="block"], table')) {
      wide.tabIndex = wide.scrollWidth > wide.clientWidth ? 0 : -1
    }
  }).observe(item)
  listen({
    enter(scene) { item.innerHTML = scene[part] },
    texts({ signs }) { if (signs !== undefined) showSigns(item, signs) },
    // A lesson has the place of the words.
    reading(on) { item.hidden = on && part === "words" },
  })
  el.append(item)
}
