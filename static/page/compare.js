// @ts-check
// Comparison of two states in the same pictures: the state before a drag, and a pinned state with a table of differences.
import { gallery } from "../pictures/gallery.js"
import { listen, tell } from "../base/bus.js"
import { onKeys } from "../base/keys.js"

/** @typedef {{query: string, scene: SceneDescription, derived: string}} Shown a state on show */
/** @typedef {Shown & {ghost: ReturnType<typeof gallery.takeGhost>}} Kept a state that was kept, and its picture */

// Keys of a query that are not compared.
const OTHER_KEYS = new Set(["v", "scene"])

/**
 * Split a line into name and value: "a = b = 1" → ["a = b", "1"].
 * @param {string} line
 * @returns {[string, string]}
 */
function parted(line) {
  const at = line.lastIndexOf(" = ")
  return at < 0 ? [line, ""] : [line.slice(0, at), line.slice(at + 3)]
}

/**
 * Return [label, first value, second value] of all entries that differ.
 * @param {[string, string][]} first
 * @param {[string, string][]} second
 * @param {Map<string, string>} names name → label
 * @returns {[string, string, string][]}
 */
function differences(first, second, names) {
  const one = new Map(first)
  const two = new Map(second)
  return [...new Set([...one.keys(), ...two.keys()])].filter((key) => one.get(key) !== two.get(key))
    .map((key) => [names.get(key) ?? key, one.get(key) ?? "–", two.get(key) ?? "–"])
}

/**
 * Return the function that is called when a state was painted.
 * @param {() => Shown} now returns the state on show
 */
export function createCompare(now) {
  let isHeld = false
  /** @type {Kept["ghost"] | null} */
  let before = null
  // State A, and state B while A is shown.
  /** @type {Kept | null} */
  let pinned = null
  /** @type {Kept | null} */
  let other = null

  const isPinnedShown = () => pinned !== null && now().query === pinned.query

  function refresh() {
    const ghost = before ?? (isPinnedShown() ? other?.ghost : pinned?.ghost) ?? null
    gallery.showGhost(ghost)
    tell("compared", pinned && comparison())
  }

  /** @returns {Compared} */
  function comparison() {
    const here = now()
    const title = here.scene.name === pinned.scene.name ? null : pinned.scene.title
    const second = isPinnedShown() && other !== null ? other : here
    /** @type {[string, string]} */
    const queries = [pinned.query, second.query]
    if (title !== null) return { title, isPinnedShown: false, rows: [], queries }
    const names = new Map(here.scene.controls.map(({ name, symbol, label }) => [name, symbol ?? label]))
    /** @type {(state: Shown) => [string, string][]} */
    const values = ({ query }) => [...new URLSearchParams(query)].filter(([key]) => !OTHER_KEYS.has(key))
    /** @type {(state: Shown) => [string, string][]} */
    const lines = ({ derived }) => derived.split("\n").filter(Boolean).map(parted)
    return {
      title, isPinnedShown: isPinnedShown(), queries,
      rows: [...differences(values(pinned), values(second), names), ...differences(lines(pinned), lines(second), names)],
    }
  }

  /** @returns {Kept} */
  const keep = () => ({ ...now(), ghost: gallery.takeGhost() })

  function flip() {
    if (pinned === null) return false
    if (!isPinnedShown()) {
      other = keep()
      tell("restore", pinned.query)
    } else if (other !== null) tell("restore", other.query)
    return true
  }

  // Copies the pictures before the first answer repaints them; the request is sent first.
  const begin = () => {
    if (!isHeld || before !== null || pinned !== null) return
    before = gallery.takeGhost()
    setTimeout(refresh)
  }
  const end = () => {
    isHeld = false
    if (before === null) return
    before = null
    refresh()
  }
  listen({
    change: begin,
    pick({ drag }) { if (drag) begin() },
    pin() {
      pinned = pinned === null ? keep() : null
      other = null
      refresh()
    },
    flip,
  })
  document.addEventListener("pointerdown", () => { isHeld = true }, { capture: true })
  for (const name of ["pointerup", "pointercancel"]) document.addEventListener(name, end, { capture: true })
  onKeys({ c: flip })
  // A new state updates the comparison.
  return { painted: () => { if (pinned !== null) refresh() } }
}
