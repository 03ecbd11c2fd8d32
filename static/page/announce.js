// @ts-check
// Says what a change did, above the pictures and to screen readers: once, when the user is idle and the state is complete.

import { gallery } from "../pictures/gallery.js"
import { captionOf, nameOf } from "../pictures/picture.js"
import { element } from "../base/elements.js"
import { listen } from "../base/bus.js"
import { written } from "../base/numbers.js"
import { byHand } from "../base/modes.js"

// Milliseconds without a new state after which the user counts as idle.
const REST = 700
// Larger changes, such as an example, are not listed number by number.
const MOST = 2
const DIGITS = 4

/**
 * Return the visually hidden element whose text screen readers announce.
 * @param {HTMLElement} sentence says what the controls of a scene do, then what the last change did
 */
export function announcer(sentence) {
  const item = element("p.unseen.announced", { role: "status" })
  // Maps a picture to the verdict that was announced last, or that was there when the picture appeared.
  /** @type {Map<string, string>} */
  const known = new Map()
  // Maps a control to its current number and its number at the last idle time.
  /** @type {Map<string, number>} */
  const now = new Map()
  let before = new Map(now)
  /** @type {Map<string, string>} */
  let symbols = new Map()
  /** @type {ReturnType<typeof setTimeout>} */
  let resting = null

  /** Return the numbers that the user has changed, as text. */
  function changes() {
    const found = [...now].filter(([name, value]) => before.has(name) && before.get(name) !== value)
      .map(([name, value]) => `${symbols.get(name)} ${written(before.get(name), DIGITS)} → ${written(value, DIGITS)}`)
    before = new Map(now)
    return found.length > MOST ? [] : found
  }

  function say() {
    /** @type {string[][]} */
    const news = []
    // A step of a lesson may hide captions, which count as new when they reappear.
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
    // Do not announce the captions of another scene as changes, and forget the old announcement.
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
      // Wait for the remaining parts of this state.
      if (progress === null) resting = setTimeout(say, REST)
    },
  })
  return item
}
