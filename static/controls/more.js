// The overflow menu at the end of the bar: the tools for which a phone has no room.

import { button, element } from "../page/elements.js"
import { PHONE } from "../page/windows.js"

/** Return [button, menu], to be put at the end of the bar; `tools` are buttons that stand in the bar, each in its group. */
export function moreMenu(tools, icon) {
  const places = tools.map((tool) => ({ tool, mark: document.createComment("") }))
  const menu = element("div.more", {
    popover: "auto", role: "group", ariaLabel: "More tools", onclick: () => menu.hidePopover(),
    ontoggle: ({ newState }) => { more.ariaExpanded = newState === "open" },
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
  // When they stand in the bar.
  queueMicrotask(place)
  return [more, menu]
}
