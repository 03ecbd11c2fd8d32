// A menu with its label.

import { element } from "../page/mount.js"

// options: [[text, value], …].  [element, show(value)].
export function menu(name, label, options, help, choose) {
  const select = element("select", { title: help, "aria-label": label }, ...options.map((option) => new Option(...option)))
  const frame = element("label", { className: `menu param-${name}` }, element("span", { textContent: label }), select)
  // The name of what is chosen may be longer than its place.
  const show = (option) => {
    select.value = option
    select.title = option === "" ? help : `${select.selectedOptions[0]?.textContent ?? option}. ${help}`
  }
  select.addEventListener("change", () => choose(select.value))
  return [frame, show]
}
