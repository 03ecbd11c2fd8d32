// @ts-check
// The overflow menu of the bar: on a phone it holds the tools that do not fit.

import { button, element } from "../base/elements.js"
import { PHONE } from "../base/windows.js"

/**
 * Return the menu and its button, for the end of the bar.
 * @param {HTMLElement[]} tools buttons in the bar
 * @param {string} icon
 */
export function moreMenu(tools, icon) {
  const places = tools.map((tool) => ({ tool, mark: document.createComment("") }))
  const menu = element("div.more", {
    popover: "auto", role: "group", ariaLabel: "More tools", onclick: () => menu.hidePopover(),
    ontoggle: (/** @type {ToggleEvent} */ { newState }) => { more.ariaExpanded = String(newState === "open") },
  })
  const more = button("tool.param-more", null, {
    title: "More", ariaLabel: "More", innerHTML: icon, popoverTargetElement: menu, ariaExpanded: false,
  })
  const place = () => {
    for (const { tool, mark } of places) {
      if (PHONE.matches) {
        if (mark.parentNode === null) tool.before(mark)
        menu.append(tool)
      } else if (mark.parentNode !== null) mark.replaceWith(tool)
    }
    more.hidden = !PHONE.matches
  }
  PHONE.addEventListener("change", place)
  // After the tools are in the bar.
  queueMicrotask(place)
  return [more, menu]
}
