// @ts-check
// The text box of a number.  It takes exact values, and expressions that the server evaluates; arrow keys change the value by
// one step, with Shift by ten.

import { tell } from "../base/bus.js"
import { element, update } from "../base/elements.js"

const TYPE = "Type a value or an expression such as pi/3, then press Enter."
/** @type {Record<string, number>} */
const STEPS = { ArrowUp: 1, ArrowDown: -1 }

// Matches a number, also with a decimal comma.
/** @param {string} text */
const pointed = (text) => text.trim().replace(",", ".")

/** Return the number that was typed; NaN for any other text, which the server reads. @param {string} text */
function numberOf(text) {
  const plain = pointed(text)
  return plain === "" || !Number.isFinite(Number(plain)) ? Number.NaN : Number(plain)
}

/**
 * Return the line beside a field for the reason why its text is refused, and the function that marks the field; "" removes the mark.
 * @param {HTMLInputElement} field
 */
export function reasonFor(field) {
  const why = element("p.why", { role: "alert", hidden: true })
  /** @param {string} text */
  const say = (text) => update(why, { textContent: text, hidden: text === "" })
  return {
    why, say,
    /** @param {string} text */
    mark(text) {
      if (text === "" && field.ariaInvalid !== "true") return
      field.ariaInvalid = String(text !== "")
      say(text)
    },
  }
}

/**
 * Return the box and the functions that fill, mark and disable it.
 * @param {import("./number.js").Controlled} number
 */
export function exactBox({ name, symbol, help, value, change, nudge, stepOf }) {
  const box = element("input.exact", {
    type: "text", inputMode: "decimal", spellcheck: false, title: `${help} ${TYPE}`, ariaLabel: `${symbol}, exact value`,
    onchange: take, oninput: () => mark(""), onkeydown,
  })
  const { why, say, mark } = reasonFor(box)
  // True while the server evaluates an expression.
  let isAsked = false

  const isFocused = () => /** @type {ShadowRoot} */ (box.getRootNode()).activeElement === box
  /** @param {number} shown */
  const put = (shown) => {
    isAsked = false
    box.value = String(shown)
    mark("")
  }

  function take() {
    const text = box.value.trim()
    const typed = numberOf(text)
    if (text !== "" && Number.isNaN(typed)) {
      isAsked = true
      return tell("expression", { [name]: pointed(text) })
    }
    mark(text === "" ? "This is not a number: type one like 1.5, 1e-8 or pi/3." : "")
    if (text === "") return
    if (typed !== value()) change(typed)
    // Compare with the text that the server writes; any other text is still being typed.
    box.value = String(typed)
  }

  /** @param {KeyboardEvent} event */
  function onkeydown(event) {
    // The browser undoes typing itself.
    if ((event.ctrlKey || event.metaKey) && box.value !== String(value())) event.stopPropagation()
    if (event.key in STEPS) {
      const typed = numberOf(box.value)
      nudge((Number.isNaN(typed) ? value() : typed) + STEPS[event.key] * stepOf() * (event.shiftKey ? 10 : 1))
    } else if (event.key === "Escape") put(value())
    else return
    event.preventDefault()
  }

  return {
    box, put, why,
    /** Say that the model limits the number; "" removes the sentence. */
    limit: say,
    /**
     * Show the value of a state, unless a number is being typed.
     * @param {number} before
     * @param {number} shown
     * @param {boolean} isIdle
     */
    show(before, shown, isIdle) {
      if (!isAsked && isFocused() && box.value !== String(before)) return
      isAsked = false
      // A disabled box cannot be scrolled, so show only as many digits as fit.
      box.value = String(isIdle ? Number(shown.toPrecision(6)) : shown)
      mark("")
    },
    /** Mark an expression that the server refuses. @param {string} sentence */
    refuse(sentence) {
      if (!isAsked) return
      isAsked = false
      mark(sentence)
    },
    /** Disable the box for a reason; "" enables it. @param {string} why */
    rest(why) {
      box.disabled = why !== ""
      box.title = why || `${help} ${TYPE}`
    },
    forget() { isAsked = false },
  }
}
