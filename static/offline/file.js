// @ts-check
// The page in a file that works without a server ("offline/html.py" writes it): the same page, answered from the states that
// the file holds.

import { render as renderBar } from "../controls/bar.js"
import { element } from "../base/elements.js"
import { createMount, FRAME, stylesOf } from "../page/mount.js"
import { buildPage, opener } from "../page/shell.js"
import { frameUrl, imageAndTexts, pictureUrl } from "../pictures/files.js"
import { createRecorded } from "./recorded.js"
import { createShelf } from "./strip.js"

/** @typedef {{client: ClientKeys, lesson: string, sheets: Record<string, string>,
 *   recording: import("./recorded.js").Recording}} FileModel
 */

/** @param {string} id */
const read = (id) => document.getElementById(id).textContent

/** Answer from the file, one request after the other. @param {ReturnType<typeof createRecorded>} answer @returns {Host["connect"]} */
const connectTo = (answer) => (receive) => {
  let last = Promise.resolve()
  /** @param {StateRequest | null} request */
  const ask = (request) => {
    last = last.then(async () => {
      const { head, block } = await answer(request)
      receive(head, block)
    }).catch(console.error)
  }
  ask(null)
  return ask
}

function start() {
  /** @type {FileModel} */
  const model = JSON.parse(read("model"))
  const { client, sheets, recording } = model
  const given = new URLSearchParams(location.hash.slice(1))
  for (const key of Object.keys(client)) if (given.has(key)) client[key] = given.get(key)
  // Open the lesson of the file at the start.
  const { lesson, step } = client
  const query = lesson === "" ? location.hash.slice(1) : recording.families[recording.steps[`${lesson}/${Number(step) - 1}/false`] ?? 0].queries[0]
  const stripAt = createShelf(async (number) => (await fetch(`data:;base64,${read(`strip-${number}`)}`)).body)
  const root = document.getElementById("page").attachShadow({ mode: "open" })
  const el = element("div")
  root.append(el)
  const mount = createMount(sheets)
  buildPage(model, { mark: "#", connect: connectTo(createRecorded(recording, stripAt, query)), answering: () => new Promise(() => {}) }, {
    mount, bar: [mount("bar", renderBar, { first: [opener("a.tool.home", "Explorer")], dialogs: [] })],
    lessons: { index: Object.values(recording.lessons).map(({ name, title, minutes }) => ({ name, title, minutes })) },
    styles: stylesOf(sheets, FRAME),
  }, el)
}

start()

/** The functions by which "headless/drawing.py" draws the pictures of the page. */
export const drawing = { frameUrl, imageAndTexts, pictureUrl }
