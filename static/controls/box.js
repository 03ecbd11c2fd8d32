// The text box of a number: takes exact values, and expressions, which the server evaluates.  Arrow keys step, with Shift by
// ten steps.

import { tell } from "../page/bus.js"
import { element } from "../page/elements.js"

const TYPE = "Type an exact value or an expression such as pi/3, and press Enter."
const STEPS = { ArrowUp: 1, ArrowDown: -1 }

// With a point where the reader's language has a comma.
const pointed = (text) => text.trim().replace(",", ".")

// A number as it is typed; NaN for a text that is none, or one for the server to read.
function numberOf(text) {
  const plain = pointed(text)
  return plain === "" || !Number.isFinite(Number(plain)) ? Number.NaN : Number(plain)
}

/**
 * Return {box, put(value), show(value before, value, isIdle), refuse(sentence), rest(why or ""), forget()}.
 * @param {import("./number.js").Controlled} number
 */
export function exactBox({ name, symbol, help, value, change, nudge, stepOf }) {
  const box = element("input.exact", {
    type: "text", inputMode: "decimal", spellcheck: false, title: `${help} ${TYPE}`, ariaLabel: `${symbol}, exact value`,
    onchange: take, oninput: () => box.setCustomValidity(""), onkeydown,
  })
  // Whether the server is reading what was typed.
  let isAsked = false

  const isFocused = () => box.getRootNode().activeElement === box
  // `why`: what is wrong, "" for nothing.
  const mark = (why) => {
    box.ariaInvalid = why !== ""
    box.setCustomValidity(why)
  }
  const put = (shown) => {
    isAsked = false
    box.value = shown
    box.setCustomValidity("")
    box.ariaInvalid = null
  }

  function take() {
    const text = box.value.trim()
    const typed = numberOf(text)
    if (text !== "" && Number.isNaN(typed)) {
      isAsked = true
      return tell("expression", { [name]: pointed(text) })
    }
    mark(text === "" ? "This is not a number: type one like 1.5, 1e-8 or pi/3." : "")
    if (text === "") return void box.reportValidity()
    if (typed !== value()) change(typed)
    // As the server will write it: from here on another text is one that is being typed.
    box.value = typed
  }

  function onkeydown(event) {
    // While a text is typed the browser itself undoes.
    if ((event.ctrlKey || event.metaKey) && box.value !== String(value())) event.stopPropagation()
    if (event.key in STEPS) {
      const typed = numberOf(box.value)
      nudge((Number.isNaN(typed) ? value() : typed) + STEPS[event.key] * stepOf() * (event.shiftKey ? 10 : 1))
    } else if (event.key === "Escape") put(value())
    else return
    event.preventDefault()
  }

  return {
    box, put,
    // Of a state: those may come while a number is typed, piece by piece of a section, and leave it alone.
    show(before, shown, isIdle) {
      if (!isAsked && isFocused() && box.value !== String(before)) return
      isAsked = false
      // Nobody can look along a disabled box for digits that it has no room for.
      box.value = isIdle ? Number(shown.toPrecision(6)) : shown
      box.ariaInvalid = null
    },
    refuse(sentence) {
      if (!isAsked) return
      isAsked = false
      mark(sentence)
      if (isFocused()) box.reportValidity()
    },
    rest(why) {
      box.disabled = why !== ""
      box.title = why || `${help} ${TYPE}`
    },
    forget() { isAsked = false },
  }
}
