// @ts-check
// The control of a parameter: a slider with a box, a menu, or a line for a formula.

import { tell } from "../base/bus.js"
import { element } from "../base/elements.js"
import { choice } from "./choice.js"
import { number } from "./number.js"

const TYPE = "Press Enter to use it."

/**
 * Return the line of a formula and the functions that show it and mark it as refused.
 * @param {ControlDescription} description
 * @returns {[HTMLElement, import("./choice.js").Show, (why: string) => void]}
 */
function formula({ name, label, help }) {
  let shown = ""
  // Whether the server is reading a formula that was typed.
  let isAsked = false
  const line = element("input.formula", {
    type: "text", spellcheck: false, autocomplete: "off", title: `${help} ${TYPE}`, maxLength: 200,
    oninput: () => mark(""),
    onchange() {
      isAsked = line.value.trim() !== shown
      if (isAsked) tell("change", { [name]: line.value.trim() })
    },
    /** @param {KeyboardEvent} event */
    onkeydown(event) {
      if (event.key === "Escape") {
        line.value = shown
        mark("")
      }
      // The browser itself undoes typing.
      if ((event.ctrlKey || event.metaKey) && line.value !== shown) event.stopPropagation()
    },
  })
  /** Mark the line as invalid for a reason; "" removes the mark. @param {string} why */
  const mark = (why) => {
    line.ariaInvalid = String(why !== "")
    line.setCustomValidity(why)
  }
  const isFocused = () => /** @type {ShadowRoot} */ (line.getRootNode()).activeElement === line
  /** @param {string} value */
  const show = (value) => {
    // A formula that was refused stays, to be corrected.
    if (value !== shown || !(isAsked || isFocused())) {
      line.value = value
      mark("")
    }
    isAsked = false
    shown = value
  }
  const item = element("div", element(`label.menu.param-${name}`, element("span", label), line), element("p.text.help", help))
  return [item, show, mark]
}

/**
 * Return the control of a parameter and its functions: show a value, refuse an expression, follow an animated number.
 * @param {ControlDescription} description
 * @returns {any[]}
 */
export function control(description) {
  if (description.kind === "number") return number(description)
  return description.kind === "choice" ? choice(description) : formula(description)
}
