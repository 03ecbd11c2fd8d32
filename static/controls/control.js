// @ts-check
// The control of a parameter: a slider with a box, a menu, or a line for a formula.

import { listen, tell } from "../base/bus.js"
import { element } from "../base/elements.js"
import { textBox } from "./box.js"
import { optionsOf } from "./dialog.js"
import { number } from "./number.js"

/**
 * A control; show(value) shows the value of a state, refuse(why) marks an expression as refused, limit(why) says that the model
 * limits the value, and follow(value) shows a change from elsewhere before the server answers.
 * @typedef {{item: HTMLElement, show: (value: any) => void, refuse?: (why: string) => void, limit?: (why: string) => void,
 *   follow?: (value: any) => void}} Control
 */

/** @param {string[]} names @returns {[string, string][]} */
export const twice = (names) => names.map((name) => [name, name])

/**
 * Return a menu.
 * @param {string} name
 * @param {string} label
 * @param {[string, string][]} options value and text of each
 * @param {string} help
 * @param {(value: string) => void} choose
 * @returns {Control}
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
  const item = element(`label.menu.param-${name}`, element("span", label),
    element("span.whole", select, text, element("span.longest", { ariaHidden: true }, longest)))
  /** @param {string} option */
  const show = (option) => {
    select.value = option
    say()
  }
  say()
  return { item, show, follow: show }
}

/**
 * Return the control of a choice.
 * @param {ControlDescription} description
 * @returns {Control}
 */
function choice({ name, label, options, help }) {
  const found = menu(name, label, twice(options), help, (option) => tell("change", { [name]: option }))
  return { ...found, item: element("div", found.item, element("p.text.help", help)) }
}

const TYPE = "Press Enter to use it."

/**
 * Return the line of a formula.
 * @param {ControlDescription} description
 * @returns {Control}
 */
function formula({ name, label, help }) {
  let shown = ""
  const line = textBox("formula", {
    autocomplete: "off", title: `${help} ${TYPE}`, maxLength: 200,
    onchange() {
      const typed = line.box.value.trim()
      line.isAsked = typed !== shown
      if (line.isAsked) tell("change", { [name]: typed })
    },
  }, () => shown)
  /** @param {string} value */
  const show = (value) => {
    // A formula that was refused stays, to be corrected.
    if (value !== shown || !(line.isAsked || line.isFocused())) line.put(value)
    line.isAsked = false
    shown = value
  }
  const item = element("div",
    element(`label.menu.param-${name}`, element("span", label), line.box), line.why, element("p.text.help", help))
  return { item, show, refuse: line.mark }
}

/**
 * Return the control of a parameter.
 * @param {ControlDescription} description
 * @returns {Control}
 */
export function control(description) {
  if (description.kind === "number") return number(description)
  return description.kind === "choice" ? choice(description) : formula(description)
}

/** Return the function that puts controls, by name, in the place of those that followed the page until then. */
export function followers() {
  /** @type {Record<string, Control>} */
  let parts = {}
  // Latest values of the current scene.
  /** @type {Record<string, ControlValue>} */
  let values = {}
  /** @param {Record<string, ControlValue>} changed */
  const show = (changed) => {
    Object.assign(values, changed)
    for (const [name, value] of Object.entries(changed)) parts[name]?.show(value)
  }
  listen({
    enter() { values = {} },
    controls: show,
    change(changed) {
      for (const [name, value] of Object.entries(changed)) {
        const shown = values[name]
        // Show the value at once, because the server sends a control only when it is released.
        if (shown !== undefined) values[name] = /** @type {ControlValue} */ (Array.isArray(shown) ? [value, ...shown.slice(1)] : value)
        parts[name]?.follow?.(value)
      }
    },
    // Key "error-" and the name of a number or formula: why it is refused; "limit-": why it has another value.
    texts(texts) {
      for (const [name, { refuse, limit }] of Object.entries(parts)) {
        const [why, within] = [texts[`error-${name}`], texts[`limit-${name}`]]
        if (why !== undefined) refuse?.(why)
        if (within !== undefined) limit?.(within)
      }
    },
  })
  return (/** @type {Record<string, Control>} */ given) => {
    parts = given
    show(values)
  }
}
