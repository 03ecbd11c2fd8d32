// Two states in the same pictures: the one before, while something is dragged; the one that is pinned, and how it differs.

import { gallery } from "../pictures/gallery.js"
import { listen, tell } from "./bus.js"
import { onKeys } from "./keys.js"

const SAID_OF_THE_PAGE = new Set(["v", "scene"])

// "a = b = 1" → ["a = b", "1"].
function parted(line) {
  const at = line.lastIndexOf(" = ")
  return at < 0 ? [line, ""] : [line.slice(0, at), line.slice(at + 3)]
}

// [[name, of the first, of the second], …] of what differs.
function differences(first, second, names) {
  const one = new Map(first)
  const two = new Map(second)
  return [...new Set([...one.keys(), ...two.keys()])].filter((key) => one.get(key) !== two.get(key))
    .map((key) => [names.get(key) ?? key, one.get(key) ?? "–", two.get(key) ?? "–"])
}

// now() → {query, scene, derived}: of the state on show.
export function createCompare(now) {
  let isHeld = false
  let before = null
  // {query, scene, derived, ghost}: A, and B while A is on show.
  let pinned = null
  let other = null

  const isPinnedShown = () => pinned !== null && now().query === pinned.query

  function refresh() {
    const ghost = before ?? (isPinnedShown() ? other?.ghost : pinned?.ghost) ?? null
    gallery.showGhost(ghost)
    tell("compared", pinned && comparison())
  }

  function comparison() {
    const here = now()
    const title = here.scene.name === pinned.scene.name ? null : pinned.scene.title
    const second = isPinnedShown() && other !== null ? other : here
    const queries = [pinned.query, second.query]
    if (title !== null) return { title, isPinnedShown: false, rows: [], queries }
    const names = new Map(here.scene.controls.map(({ name, symbol, label }) => [name, symbol ?? label]))
    const values = ({ query }) => [...new URLSearchParams(query)].filter(([key]) => !SAID_OF_THE_PAGE.has(key))
    const lines = ({ derived }) => derived.split("\n").filter(Boolean).map(parted)
    return {
      title, isPinnedShown: isPinnedShown(), queries,
      rows: [...differences(values(pinned), values(second), names), ...differences(lines(pinned), lines(second), names)],
    }
  }

  const keep = () => ({ ...now(), ghost: gallery.takeGhost() })

  function flip() {
    if (pinned === null) return false
    if (!isPinnedShown()) {
      other = keep()
      tell("restore", pinned.query)
    } else if (other !== null) tell("restore", other.query)
    return true
  }

  // Before the first answer paints over it; the request goes first.
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
    animated(on) {
      if (on) isHeld = true
      else end()
    },
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
  // A state is painted.
  return { painted: () => { if (pinned !== null) refresh() } }
}
