// @ts-check
// The controls that a step of a lesson names, beside its text.  They are the components of the column of controls: both hear
// the same events, so that each follows the other.  A number in the text that can be dragged is the label of such a control.

import { listen } from "../base/bus.js"
import { element } from "../base/elements.js"
import { arrowOf } from "../base/keys.js"
import { written } from "../base/numbers.js"
import { isEmbedded, isPresenting, NARROW, PHONE } from "../base/modes.js"
import { control, followers } from "./control.js"

const DIGITS = 4

/** Return the group of controls, empty at first, and the function that fills it. */
export function stepControls() {
  const group = element("div.step-controls", { role: "group", ariaLabel: "Controls of this step" })
  /** @type {string[]} */
  let names = []
  /** @type {HTMLButtonElement[]} */
  let words = []
  let isAlone = false
  // These controls are not needed where the column of controls is beside the text.
  const isColumnAway = () => NARROW.matches || PHONE.matches || isPresenting() || isEmbedded || isAlone
  /** @type {ControlDescription[]} */
  let known = []
  const [put, putWords] = [followers(), followers()]

  function build() {
    const wanted = isColumnAway() ? names.map((name) => known.find((one) => one.name === name)).filter(Boolean) : []
    const controls = wanted.map((one) => /** @type {const} */ ([one.name, control(one)]))
    group.replaceChildren(...controls.map(([, { item }]) => item))
    group.hidden = wanted.length === 0
    put(Object.fromEntries(controls))
    putWords(Object.fromEntries(words.flatMap(draggable)))
  }

  /** @param {HTMLButtonElement} word @returns {[string, import("./control.js").Control][]} */
  function draggable(word) {
    const description = known.find(({ name }) => name === word.value)
    if (description === undefined) return []
    const made = control(description)
    /** @type {[HTMLElement, HTMLInputElement]} */
    const [label, hand] = [made.item.querySelector(".label"), made.item.querySelector(".hand")]
    word.replaceChildren(label)
    word.title = `${description.label}: drag, or use the arrow keys`
    word.onkeydown = (event) => {
      const [right, up] = arrowOf(event) ?? [0, 0]
      if (right + up === 0) return
      hand[right + up > 0 ? "stepUp" : "stepDown"]()
      hand.dispatchEvent(new Event("input"))
      event.preventDefault()
    }
    /** @param {number} value */
    const say = (value) => { label.textContent = written(value, DIGITS) }
    return [[word.value, {
      ...made,
      show(values) {
        made.show(values)
        say(values[0])
      },
      follow(value) {
        made.follow(value)
        say(value)
      },
    }]]
  }

  for (const query of [NARROW, PHONE]) query.addEventListener("change", build)
  listen({
    enter(scene) {
      known = scene.controls
      build()
    },
    presenting: build,
    alone(pictures) {
      isAlone = pictures.length > 0
      build()
    },
  })
  return {
    group,
    /**
     * Show the controls of these names, as far as the scene has them, and let numbers in the text be dragged.
     * @param {string[]} wanted
     * @param {Iterable<HTMLButtonElement>} numbers
     */
    fill(wanted, numbers = []) {
      names = wanted
      words = [...numbers]
      build()
    },
  }
}
