// @ts-check
// The controls that a step of a lesson names, beside its text.  They are the components of the column of controls: both hear
// the same events, so that each follows the other.

import { listen } from "../base/bus.js"
import { isEmbedded } from "../base/embedding.js"
import { element } from "../base/elements.js"
import { isPresenting } from "../base/presenting.js"
import { NARROW, PHONE } from "../base/windows.js"
import { control as controlOf } from "./control.js"

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
  // Latest values from the server for the current scene.
  /** @type {Record<string, ControlValue>} */
  let values = {}
  /** @type {Record<string, {show: (value: any) => void, refuse?: (why: string) => void, follow?: (value: number) => void}>} */
  let parts = {}

  /** @param {Record<string, ControlValue>} changed */
  const show = (changed) => {
    Object.assign(values, changed)
    for (const [name, value] of Object.entries(changed)) parts[name]?.show(value)
  }

  function build() {
    parts = {}
    const wanted = isColumnAway() ? names.map((name) => known.find((control) => control.name === name)).filter(Boolean) : []
    group.replaceChildren(...wanted.map((control) => {
      const [item, showOne, refuse, follow] = controlOf(control)
      parts[control.name] = { show: showOne, refuse, follow }
      return item
    }))
    group.hidden = wanted.length === 0
    show(values)
  }

  /** @param {string} name @param {number | string} value */
  function follow(name, value) {
    const shown = values[name]
    // The server sends a control again only when it is released.
    if (Array.isArray(shown) && typeof value === "number") values[name] = [value, shown[1], shown[2], shown[3], shown[4]]
    if (typeof value === "number") parts[name]?.follow?.(value)
    else show({ [name]: value })
  }

  for (const query of [NARROW, PHONE]) query.addEventListener("change", build)
  listen({
    enter(scene) {
      known = scene.controls
      values = {}
      build()
    },
    controls: show,
    change(changed) { for (const [name, value] of Object.entries(changed)) follow(name, value) },
    // Key "error-" and the name of a number.
    texts(texts) { for (const [name, part] of Object.entries(parts)) if (texts[`error-${name}`]) part.refuse?.(texts[`error-${name}`]) },
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
