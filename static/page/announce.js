// @ts-check
// Announces changed verdicts to screen readers: once, after the hand rests and all parts of the state are there.

import { gallery } from "../pictures/gallery.js"
import { captionOf, nameOf } from "../pictures/picture.js"
import { listen } from "./bus.js"
import { element } from "./elements.js"

// Milliseconds without a new state until the hand rests.
const REST = 700

/** Return the element, unseen, whose text screen readers announce. */
export function announcer() {
  const item = element("p.unseen.announced", { role: "status" })
  // Picture → the verdict that was announced last, or found when the picture came into sight.
  /** @type {Map<string, string>} */
  const known = new Map()
  /** @type {ReturnType<typeof setTimeout>} */
  let resting = null

  function say() {
    const news = []
    for (const cell of gallery.cellsInSight()) {
      const [title, verdict, numbers] = captionOf(cell)
      const before = known.get(nameOf(cell))
      known.set(nameOf(cell), verdict)
      if (before !== undefined && before !== verdict) news.push([`${title}:`, verdict, numbers].join(" "))
    }
    if (news.length > 0) item.textContent = news.join(" ")
  }

  listen({
    // The captions of another scene are its own: no change, and the old announcement no longer holds.
    enter() {
      known.clear()
      item.textContent = ""
    },
    progress(progress) {
      clearTimeout(resting)
      // More parts of this state will come.
      if (progress === null) resting = setTimeout(say, REST)
    },
  })
  return item
}
