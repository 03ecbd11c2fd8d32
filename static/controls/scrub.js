// Scrubbing: a number follows the pointer while its label is dragged.  A full drag goes from one end to the other, where
// steps are not longer.

import { onDrag } from "../page/drag.js"

const FULL_DRAG = 400

/**
 * Let a label be dragged.
 * @param {HTMLElement} label
 * @param {import("./number.js").Controlled} number
 */
export function scrub(label, { limits, stepOf, value, move, isIdle }) {
  onDrag(label, ({ button, clientX }) => (isIdle() || button !== 0 ? null : [clientX, value()]),
    ([x, from], { clientX, shiftKey }) => {
      const [low, high] = limits()
      const steps = Math.max(1, Math.round((high - low) / FULL_DRAG / stepOf())) * (shiftKey ? 10 : 1)
      move(from + Math.round(clientX - x) * steps * stepOf())
    })
}
