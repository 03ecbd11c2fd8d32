// @ts-check
// Undo and Redo, and the browser's Back and Forward.
//
// A step is the query of a state.  All changes while a pointer or a key is held down are one step.  Going back to a step
// takes one request, which the server reads like a link.  A step to another scene or to an example gets a history entry of
// the browser; any other step replaces the current entry.

import { listen, tell } from "../base/bus.js"
import { isTyped } from "../base/keys.js"

const MOST = 100
/** @type {(keyof PageEvents)[]} */
const CHANGES = ["change", "expression", "preset", "reset", "clear", "pick", "scene"]

/** @param {string} query */
const sceneOf = (query) => new URLSearchParams(query).get("scene")

/**
 * @typedef {object} Steps
 * @property {string[]} past
 * @property {string[]} future
 * @property {string | null} current the step on show
 * @property {string | null} goal the requested step
 * @property {boolean} isChanged whether there are changes that are not a step yet
 */

/**
 * Return the function that is called when a state was painted, and the steps, which another history can go on with.
 * @param {{query: () => string, isSettled: () => boolean, address: {push: (before: string) => void, read: () => string}}} page
 *   query() returns the query of the state on show, isSettled() whether that state answers the last request
 * @param {Steps} [steps]
 */
export function createHistory({ query, isSettled, address }, steps) {
  let { past, future, current, goal, isChanged } = steps ?? { past: [], future: [], current: null, goal: null, isChanged: false }
  // The step of the browser's history entry.
  /** @type {string | null} */
  let entered = null
  let isHeld = false
  let isExample = false
  let isPopped = false

  const announce = () => tell("steps", { undo: past.length, redo: future.length })

  /** @param {string} step */
  function goTo(step) {
    goal = step
    tell("restore", step)
    announce()
  }

  // Discards changes that do not form a step yet.
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

  // Called when a state was painted or a pointer or key released: the state may be a new step.
  function settle() {
    if (isHeld || !isSettled()) return
    const here = query()
    if (goal === null && current !== null && here !== current) {
      past = [...past, current].slice(-MOST)
      future = []
    }
    // After Back, the browser already shows its entry.
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
  listen({ undo, redo })
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
    tell("restore", address.read())
  })
  return {
    settle,
    /** @returns {Steps} */
    get steps() { return { past, future, current, goal, isChanged } },
  }
}
