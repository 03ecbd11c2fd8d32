// @ts-check
// Records the actions of the user as the Markdown of a lesson, to be edited: each settled state becomes a step.

import { saveFile } from "../controls/dialog.js"
import { listen, tell } from "../base/bus.js"
import { button, element } from "../base/elements.js"

const MOST = 100
const MOST_CONTROLS = 6
const FILE = "lesson.md"

/** @typedef {{query: URLSearchParams, look: string, controls: string[]}} Recorded */

/** Return the query of the state on show, without the keys that the browser keeps. */
function queryHere() {
  // The address bar may lag behind the screen.
  tell("address")
  const query = new URLSearchParams(location.search)
  tell("ask-client", (own) => { for (const key of Object.keys(own)) query.delete(key) })
  return query
}

/** @param {Recorded} step @param {number} i */
const markdownOf = ({ query, look, controls }, i) => [
  `## Step ${i + 1}`, "", "```step", `state: "?${query}"`,
  ...(look === "" ? [] : [`look: ${look}`]),
  ...(controls.length === 0 ? [] : [`controls: [${controls.join(", ")}]`]),
  "```", "", "Describe this step here.", "",
].join("\n")

/** Return the button that begins a recording, and the box that is shown while it runs. */
export function recording() {
  /** @type {Recorded[] | null} */
  let steps = null
  /** @type {string[]} */
  let names = []
  let large = ""
  const count = element("span", { role: "status" })
  const box = element("div.row.recording", { hidden: true }, count,
    button("button.param-save-recording", save, "Save as a lesson"),
    button("button.param-drop-recording", end, "Discard"))
  const begin = button("button.param-record", start, {
    title: "Each change that you make becomes a step of a lesson in Markdown",
  }, "Record a lesson")

  function start() {
    // Recording needs a first state.
    if (document.documentElement.dataset.state === "0") return
    steps = []
    take()
    box.hidden = false
    begin.hidden = true
  }

  function end() {
    steps = null
    box.hidden = true
    begin.hidden = false
  }

  function save() {
    const text = `---\ntitle: Recorded lesson\nminutes: ${steps.length}\n---\n\n${steps.map(markdownOf).join("\n")}`
    saveFile(new Blob([text], { type: "text/markdown" }), FILE)
    end()
  }

  // The current state is a new step, unless it equals the last step.
  function take() {
    if (steps === null || steps.length >= MOST) return
    const query = queryHere()
    const last = steps.at(-1)
    if (last !== undefined && String(query) === String(last.query)) return
    const isSameScene = query.get("scene") === last?.query.get("scene")
    const controls = isSameScene ? names.filter((name) => query.get(name) !== last.query.get(name)) : []
    put({ query, look: large, controls: controls.slice(0, MOST_CONTROLS) })
  }

  /** @param {Recorded} step */
  function put(step) {
    steps.push(step)
    const most = steps.length === MOST ? ", the maximum: save or discard them" : ""
    count.textContent = `Recorded: ${steps.length} step${steps.length === 1 ? "" : "s"}${most}`
  }

  /** A picture was enlarged or opened: it belongs to the last step, or a new one shows it. @param {string} name */
  function look(name) {
    large = name
    if (steps === null || name === "") return
    take()
    const last = steps.at(-1)
    if (last.look === "") last.look = name
    else if (last.look !== name && steps.length < MOST) put({ query: last.query, look: name, controls: [] })
  }

  listen({
    enter(scene) { names = scene.controls.map(({ name }) => name) },
    // The undo history knows when a change is complete.
    steps: take,
    url(keys) { if (keys.large !== undefined) look(keys.large.split(",")[0]) },
    folded({ name, folded }) { if (!folded) look(name) },
  })
  return { begin, box }
}
