// What the user has done, step by step: Undo and Redo, and the browser's Back and Forward.
//
// A step is the query of a state.  Whatever is done while a pointer or a key is held down is one step.  A step is gone
// back to by one request, which is read as a link is.  Where a step leads to another scene or to an example, the browser
// gets an entry of its own for Back; else its entry is written anew.

import { listen, tell } from "./bus.js"
import { isTyped } from "./keys.js"

const MOST = 100
const CHANGES = ["change", "expression", "preset", "reset", "clear", "pick", "scene"]

const sceneOf = (query) => new URLSearchParams(query).get("scene")

// query() is that of the state on show, isSettled() whether it answers the last request; address: see "address.js".
export function createHistory({ query, isSettled, address }) {
  let past = []
  let future = []
  // The step on show; the one on its way; that of the browser's entry.
  let current = null
  let goal = null
  let entered = null
  let isHeld = false
  let isAnimated = false
  let isChanged = false
  let isExample = false
  let isPopped = false

  const announce = () => tell("steps", { undo: past.length, redo: future.length })

  function goTo(step) {
    goal = step
    tell("restore", step)
    announce()
  }

  // Of what is changed and is no step yet nothing stays.
  function undo() {
    const here = goal ?? current
    if (isSettled() ? query() !== here : isChanged) {
      isChanged = false
      return goTo(here)
    }
    if (past.length === 0) return
    future.push(here)
    goTo(past.pop())
  }

  function redo() {
    if (isChanged || future.length === 0) return
    past.push(goal ?? current)
    goTo(future.pop())
  }

  // A state has been painted, or nothing is held any more: it may be a step.
  function settle() {
    if (isHeld || isAnimated || !isSettled()) return
    const here = query()
    if (goal === null && current !== null && here !== current) {
      past = [...past, current].slice(-MOST)
      future = []
    }
    // By Back its entry is on show already.
    if (entered !== null && here !== entered && !isPopped && (isExample || sceneOf(here) !== sceneOf(entered))) {
      address.push(entered)
    }
    current = entered = here
    goal = null
    isChanged = isExample = isPopped = false
    announce()
  }

  for (const name of CHANGES) {
    listen({ [name]() {
      if (goal !== null) current = goal
      goal = null
      isChanged = true
      isExample = name === "preset"
      isPopped = false
    } })
  }
  listen({
    animated(on) { isAnimated = on },
    undo,
    redo,
  })
  for (const name of ["pointerdown", "keydown"]) {
    document.addEventListener(name, () => { isHeld = true }, { capture: true })
  }
  const release = () => {
    isHeld = false
    settle()
  }
  for (const name of ["pointerup", "pointercancel", "keyup"]) document.addEventListener(name, release, { capture: true })
  window.addEventListener("blur", release)
  document.addEventListener("keydown", (event) => {
    if (event.defaultPrevented || event.altKey || !(event.ctrlKey || event.metaKey) || isTyped(event)) return
    const key = event.key.toLowerCase()
    const isRedo = key === "y" || (key === "z" && event.shiftKey)
    if (!isRedo && key !== "z") return
    event.preventDefault()
    if (isRedo) redo()
    else undo()
  })
  window.addEventListener("popstate", () => {
    isPopped = true
    tell("restore", location.search.slice(1))
  })
  return { settle }
}
