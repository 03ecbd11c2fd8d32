// A dialog over the page, with its title, tools and Close in its head; a click beside it closes it too.

import { element } from "../page/mount.js"

export function dialogOf(title, className, tools, ...parts) {
  const close = element("button", { type: "button", className: "button", textContent: "Close" })
  const dialog = element("dialog", { className, "aria-label": title },
    element("div", { className: "head" }, element("h2", { textContent: title }), ...tools, close), ...parts)
  close.addEventListener("click", () => dialog.close())
  dialog.addEventListener("click", ({ target }) => { if (target === dialog) dialog.close() })
  // Nothing of it is for the page beneath.
  dialog.addEventListener("keydown", (event) => event.stopPropagation())
  return dialog
}
