// @ts-check
// Says what a change did, above the pictures and to screen readers: once, after the hand rests and all parts of the state are there.

import { gallery } from "../pictures/gallery.js"
import { captionOf, nameOf } from "../pictures/picture.js"
import { element } from "../base/elements.js"
import { listen } from "../base/bus.js"
import { written } from "../base/numbers.js"
import { byHand } from "../base/modes.js"

// Milliseconds without a new state until the hand rests.
const REST = 700
// Numbers of a larger change, such as an example, are not listed.
const MOST = 2
const DIGITS = 4

/**
 * Return the element, unseen, whose text screen readers announce.
 * @param {HTMLElement} sentence says what the controls of a scene do, then what the last change did
 */
export function announcer(sentence) {
  const item = element("p.unseen.announced", { role: "status" })
  // Picture → the verdict that was announced last, or found when the picture came into sight.
  /** @type {Map<string, string>} */
  const known = new Map()
  // Control → its number now, and when the hand rested last.
  /** @type {Map<string, number>} */
  const now = new Map()
  let before = new Map(now)
  /** @type {Map<string, string>} */
  let symbols = new Map()
  /** @type {ReturnType<typeof setTimeout>} */
  let resting = null

  /** Return the numbers that the hand has changed, in words. */
  function changes() {
    const found = [...now].filter(([name, value]) => before.has(name) && before.get(name) !== value)
      .map(([name, value]) => `${symbols.get(name)} ${written(before.get(name), DIGITS)} → ${written(value, DIGITS)}`)
    before = new Map(now)
    return found.length > MOST ? [] : found
  }

  function say() {
    /** @type {string[][]} */
    const news = []
    // A step of a lesson may hide captions, which are news when they come back.
    for (const cell of gallery.cellsInSight().filter(({ classList }) => !classList.contains("veiled"))) {
      const [title, verdict, numbers] = captionOf(cell)
      const last = known.get(nameOf(cell))
      known.set(nameOf(cell), verdict)
      if (last !== undefined && last !== verdict) news.push([`${title}:`, verdict, numbers])
    }
    if (news.length > 0) item.textContent = news.map((one) => one.join(" ")).join(" ")
    const changed = changes().join(", ")
    if (changed === "" && news.length === 0) return
    const verdicts = news.map(([title, verdict]) => `${title} ${verdict}`).join(" ") || "No verdict changed."
    sentence.textContent = sentence.title = [changed, verdicts].filter(Boolean).join(". ")
  }

  listen({
    // The captions of another scene are its own: no change, and the old announcement no longer holds.
    enter({ moves, controls }) {
      known.clear()
      now.clear()
      before.clear()
      symbols = new Map(controls.map(({ name, symbol, label }) => [name, symbol ?? label]))
      item.textContent = ""
      sentence.textContent = sentence.title = byHand(moves)
    },
    controls(changed) { for (const [name, [value]] of Object.entries(changed)) if (typeof value === "number") now.set(name, value) },
    progress(progress) {
      clearTimeout(resting)
      // More parts of this state will come.
      if (progress === null) resting = setTimeout(say, REST)
    },
  })
  return item
}
