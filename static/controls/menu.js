// A menu with its label.

import { element } from "../page/mount.js"

// options: [[text, value], …].  [element, show(value)].
export function menu(name, label, options, help, choose) {
  const select = element("select", { title: help, "aria-label": label }, ...options.map((option) => new Option(...option)))
  const frame = element("label", { className: `menu param-${name}` }, element("span", { textContent: label }), select)
  select.addEventListener("change", () => choose(select.value))
  return [frame, (option) => { select.value = option }]
}
