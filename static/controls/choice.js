// @ts-check
// The control of a choice: a menu of its options.

import { element } from "../base/elements.js"
import { tell } from "../base/bus.js"
import { optionsOf } from "./dialog.js"

/** @typedef {(value: any) => void} Show shows the value of a control */

/** @param {string[]} names @returns {[string, string][]} */
export const twice = (names) => names.map((name) => [name, name])

/**
 * Return a menu and the function that shows an option.
 * @param {string} name
 * @param {string} label
 * @param {[string, string][]} options value and text of each
 * @param {string} help
 * @param {(value: string) => void} choose
 * @returns {[HTMLElement, Show]}
 */
export function menu(name, label, options, help, choose) {
  // A menu itself shows one line, and cuts it: the whole text lies over the menu.  An unseen copy of the longest one keeps
  // its place, so that no choice moves the controls below.
  const text = element("span", { ariaHidden: true })
  const longest = options.reduce((most, [, one]) => (one.length > most.length ? one : most), "")
  const say = () => { text.textContent = select.selectedOptions[0]?.textContent ?? "" }
  const select = element("select", {
    title: help, ariaLabel: label,
    onchange: () => {
      say()
      choose(select.value)
    },
  }, ...optionsOf(options))
  const frame = element(`label.menu.param-${name}`, element("span", label),
    element("span.whole", select, text, element("span.longest", { ariaHidden: true }, longest)))
  /** @param {string} option */
  const show = (option) => {
    select.value = option
    say()
  }
  say()
  return [frame, show]
}

/**
 * Return the control of a choice and the function that shows its option.
 * @param {ControlDescription} description
 * @returns {[HTMLElement, Show]}
 */
export function choice({ name, label, options, help }) {
  const [frame, show] = menu(name, label, twice(options), help, (option) => tell("change", { [name]: option }))
  return [element("div", frame, element("p.text.help", help)), show]
}
