// @ts-check
// A text box that keeps what is being typed, with the reason why its text is refused.

import { element, say } from "../base/elements.js"

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
  /** Mark the text as refused; "" removes the mark. @param {string} text the reason */
  const mark = (text) => {
    if (text === "" && box.ariaInvalid !== "true") return
    box.ariaInvalid = String(text !== "")
    say(why, text)
  }
  const own = {
    box, why, mark, isAsked: false,
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
