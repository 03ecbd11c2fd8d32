// A select element with its label.

import { element } from "../page/elements.js"
import { optionsOf } from "./dialog.js"

/**
 * Return [element, show(value)].
 * @param {string} name
 * @param {string} label
 * @param {[string, string][]} options value and text of each
 * @param {string} help
 * @param {(value: string) => void} choose
 */
export function menu(name, label, options, help, choose) {
  const select = element("select", { title: help, ariaLabel: label, onchange: () => choose(select.value) }, ...optionsOf(options))
  const frame = element(`label.menu.param-${name}`, element("span", label), select)
  // The name of what is chosen may be longer than its place.
  const show = (option) => {
    select.value = option
    select.title = option === "" ? help : `${select.selectedOptions[0]?.textContent ?? option}. ${help}`
  }
  return [frame, show]
}
