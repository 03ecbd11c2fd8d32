// The tools of the bar for which a phone has no room, in a menu at its end.

import { element } from "../page/mount.js"
import { PHONE } from "../page/windows.js"

// tools: buttons that stand in the bar, each in its group; [button, menu], to be put at the end of the bar.
export function moreMenu(tools, icon, signal) {
  const places = tools.map((tool) => ({ tool, mark: document.createComment("") }))
  const menu = element("div", { className: "more", popover: "auto", role: "group", "aria-label": "More tools" })
  const button = element("button", {
    type: "button", className: "tool param-more", title: "More", "aria-label": "More", innerHTML: icon, popoverTargetElement: menu,
    "aria-expanded": "false",
  })
  menu.addEventListener("toggle", ({ newState }) => button.setAttribute("aria-expanded", String(newState === "open")))
  menu.addEventListener("click", () => menu.hidePopover())
  const place = () => {
    for (const { tool, mark } of places) {
      if (PHONE.matches) {
        if (mark.parentNode === null) tool.before(mark)
        menu.append(tool)
      } else if (mark.parentNode !== null) mark.replaceWith(tool)
    }
    button.hidden = !PHONE.matches
  }
  PHONE.addEventListener("change", place, { signal })
  // When they stand in the bar.
  queueMicrotask(place)
  return [button, menu]
}
