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
 * Return a text box and the line beside it for the reason why its text is refused.  isAsked: whether the server is reading the text.
 * @param {string} name its class
 * @param {object} properties see `element`
 * @param {() => string} shown returns the text of the state on show, to which Escape returns
 * @param {(event: KeyboardEvent) => boolean} onKey returns whether it has used a key
 */
export function textBox(name, properties, shown, onKey = () => false) {
  const box = element(`input.${name}`, {
    type: "text", spellcheck: false, ...properties, oninput: () => mark(""),
    /** @param {KeyboardEvent} event */
    onkeydown(event) {
      // The browser itself undoes typing.
      if ((event.ctrlKey || event.metaKey) && box.value !== shown()) event.stopPropagation()
      if (event.key === "Escape") own.put(shown())
      else if (!onKey(event)) return
      event.preventDefault()
    },
  })
  const why = element("p.why", { role: "alert", hidden: true })
  /** @param {string} text */
  const say = (text) => update(why, { textContent: text, hidden: text === "" })
  /** Mark the text as refused; "" removes the mark. @param {string} text the reason */
  const mark = (text) => {
    if (text === "" && box.ariaInvalid !== "true") return
    box.ariaInvalid = String(text !== "")
    say(text)
  }
  const own = {
    box, why, say, mark, isAsked: false,
    isFocused: () => /** @type {ShadowRoot} */ (box.getRootNode()).activeElement === box,
    /** @param {string} text */
    put(text) {
      own.isAsked = false
      box.value = text
      mark("")
    },
  }
  return own
}

/**
 * A number as its box sees it: value() is the shown value, stepOf() the step of an arrow key; change(value) takes a typed value,
 * nudge(value) the result of an arrow key.
 * @typedef {{name: string, symbol: string, help: string, value: () => number, stepOf: () => number,
 *   change: (value: number) => void, nudge: (value: number) => void}} Controlled
 */

/**
 * Return the box of a number, and the functions that fill, mark and disable it.
 * @param {Controlled} number
 */
export function exactBox({ name, symbol, help, value, change, nudge, stepOf }) {
  const own = textBox("exact", {
    inputMode: "decimal", title: `${help} ${TYPE}`, ariaLabel: `${symbol}, exact value`, onchange: take,
  }, () => String(value()), ({ key, shiftKey }) => {
    if (!(key in STEPS)) return false
    const typed = numberOf(box.value)
    nudge((Number.isNaN(typed) ? value() : typed) + STEPS[key] * stepOf() * (shiftKey ? 10 : 1))
    return true
  })
  const { box, why, say, mark } = own

  function take() {
    if (box.value.trim() === "") return mark("This is not a number: type one like 1.5, 1e-8 or pi/3.")
    const typed = numberOf(box.value)
    own.isAsked = Number.isNaN(typed)
    if (own.isAsked) return tell("expression", { [name]: pointed(box.value) })
    if (typed !== value()) change(typed)
    // Compare with the text that the server writes; any other text is still being typed.
    box.value = String(typed)
  }

  return {
    box, why,
    /** @param {number} shown */
    put: (shown) => own.put(String(shown)),
    /** Say that the model limits the number; "" removes the sentence. */
    limit: say,
    /**
     * Show the value of a state, unless a number is being typed.
     * @param {number} before
     * @param {number} shown
     * @param {boolean} isIdle
     */
    show(before, shown, isIdle) {
      if (!own.isAsked && own.isFocused() && box.value !== String(before)) return
      // A disabled box cannot be scrolled: show as many digits as fit.
      own.put(String(isIdle ? Number(shown.toPrecision(6)) : shown))
    },
    /** Mark an expression that the server refuses. @param {string} sentence */
    refuse(sentence) {
      if (own.isAsked) mark(sentence)
      own.isAsked = false
    },
    /** Disable the box for a reason; "" enables it. @param {string} why */
    rest(why) {
      box.disabled = why !== ""
      box.title = why || `${help} ${TYPE}`
    },
  }
}
