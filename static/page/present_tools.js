// @ts-check
// Tools of present mode: a drawer with bar, controls, player and legend, and a spot that follows the pointer.

import { listen, tell } from "../base/bus.js"
import { button, element, icon } from "../base/elements.js"
import { onKeys } from "../base/keys.js"
import { isPresenting } from "../base/modes.js"

const REST = 3000
const SLIDERS = "M4 8h16M4 16h16M15 5v6M9 13v6"

/** Return the button that opens and closes the drawer of present mode. @param {HTMLElement} el the frame of the page */
export function drawer(el) {
  const item = button("drawer", () => draw(!isDrawn), { title: "Controls and legend (M)", ariaLabel: "Controls and legend", innerHTML: icon(SLIDERS) })
  let isDrawn = false
  /** @param {boolean} on */
  const draw = (on) => {
    isDrawn = on
    item.ariaExpanded = String(on)
    el.classList.toggle("drawn-out", on)
  }
  draw(false)
  listen({ presenting: () => draw(false) })
  onKeys({ m: () => isPresenting() && draw(!isDrawn) })
  return item
}

/** Return a spot that follows the pointer and hides while it rests; Escape leaves present mode. */
export function spot() {
  const item = element("div.spot", { ariaHidden: true })
  /** @type {ReturnType<typeof setTimeout>} */
  let resting = null
  document.addEventListener("pointermove", ({ clientX, clientY }) => {
    if (!isPresenting()) return
    clearTimeout(resting)
    item.style.translate = `${clientX}px ${clientY}px`
    item.classList.add("moving")
    resting = setTimeout(() => item.classList.remove("moving"), REST)
  })
  // Earlier listeners of Escape have priority.
  onKeys({ escape: () => isPresenting() && tell("present") }, window)
  return item
}
