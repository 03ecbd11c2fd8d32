// @ts-check
// The controls that a step of a lesson names, beside its text.  They are the components of the column of controls: both hear
// the same events, so that each follows the other.

import { listen } from "../base/bus.js"
import { isEmbedded } from "../base/embedding.js"
import { element } from "../base/elements.js"
import { isPresenting } from "../base/presenting.js"
import { NARROW, PHONE } from "../base/windows.js"
import { control, followers } from "./control.js"

/** Return the group of controls, empty at first, and the function that fills it. */
export function stepControls() {
  const group = element("div.step-controls", { role: "group", ariaLabel: "Controls of this step" })
  /** @type {string[]} */
  let names = []
  let isAlone = false
  // Where the column of controls is beside the text, it is enough.
  const isColumnAway = () => NARROW.matches || PHONE.matches || isPresenting() || isEmbedded() || isAlone
  /** @type {ControlDescription[]} */
  let known = []
  const put = followers()

  function build() {
    const wanted = isColumnAway() ? names.map((name) => known.find((one) => one.name === name)).filter(Boolean) : []
    const controls = wanted.map((one) => /** @type {const} */ ([one.name, control(one)]))
    group.replaceChildren(...controls.map(([, { item }]) => item))
    group.hidden = wanted.length === 0
    put(Object.fromEntries(controls))
  }

  for (const query of [NARROW, PHONE]) query.addEventListener("change", build)
  listen({
    enter(scene) {
      known = scene.controls
      build()
    },
    presenting: build,
    embedding: build,
    alone(pictures) {
      isAlone = pictures.length > 0
      build()
    },
  })
  return {
    group,
    /** Show the controls of these names, as far as the scene has them. @param {string[]} wanted */
    fill(wanted) {
      names = wanted
      build()
    },
  }
}
