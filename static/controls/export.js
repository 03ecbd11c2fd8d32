// @ts-check
// The dialog Export: data, figure or film of a picture, or the whole state in one file; the command that makes the file, and the
// Python code that computes the same.  The server makes the file, except a PNG of a picture that is not a plot: the page draws it.

import { button, element } from "../base/elements.js"
import { listen, tell } from "../base/bus.js"
import { linkTo } from "../base/embedding.js"
import { pictureFile } from "../pictures/files.js"
import { gallery } from "../pictures/gallery.js"
import { captionOf, nameOf, titleOf } from "../pictures/picture.js"
import { choices, copyButton, dialogOf, optionsOf, saveFile, section, snippet } from "./dialog.js"
import { slowFileOf } from "./slow_file.js"

// [minimum, maximum, default] number of values of a slider.
/** @type {[number, number, number]} */
const VALUES = [2, 400, 40]
const FLAGS = new Set(["black", "grid"])

/** @typedef {Record<string, string> & {picture: string, format: string}} Wanted */
/** @typedef {{file?: Blob, why?: string}} Fetched a file, or the reason that there is none */

/**
 * Return the dialog.
 * @param {ExportFiles} files
 */
export function exportDialog(files) {
  const holds = Object.fromEntries(files.formats.map(([kind, , what]) => [kind, what]))
  const content = () => holds[format.value]
  const isAll = () => content() === "state"
  /** Return whether a browser draws the file: this one a PNG, the browser of the server any other. @param {Wanted} what */
  const isOfBrowser = ({ picture: name, format: kind }) => (holds[kind] === "film"
    || (holds[kind] === "figure" && scene.pictures.some((one) => one.name === name && one.kind !== "plot")))
  /** @type {SceneDescription | null} */
  let scene = null
  /** @type {AbortController | null} */
  let running = null
  /** @param {string} name @param {(readonly [string, string, ...unknown[]])[]} options */
  const menu = (name, options) => element(`select.param-${name}`, { name }, ...optionsOf(options))
  /** @param {string} name @param {[number, number, number]} limits */
  const number = (name, [min, max, value]) => element(`input.param-${name}`, { name, type: "number", required: true, min, max, value })
  /** @param {string} name */
  const box = (name) => element(`input.param-${name}`, { name, type: "checkbox", value: "1" })
  const picture = menu("picture", [])
  const format = menu("format", files.formats)
  const loop = menu("loop", [["", "the whole motion, once"],
    ["light", "a loop of 1080 pixels, light"], ["dark", "a loop of 1080 pixels, dark"]])
  const grid = box("grid")
  const values = number("values", VALUES)
  const moving = choices("moving", "Sliders that move in the file")
  const states = element("p.states")
  const one = element("label", "Picture ", picture)
  // A loop has its own size and colours.
  const figure = element("fieldset.figure", element("label", "Width, mm ", number("width", files.width)),
    element("label", box("black"), " Black on white"))
  const film = element("fieldset.figure", element("label", "Film ", loop),
    element("label", "Seconds ", number("seconds", files.seconds)))
  const page = element("fieldset.figure", moving.frame, element("label", "Values each ", values),
    element("label", grid, " All combinations"), states)
  const made = element("progress", { ariaLabel: "Frames or states", hidden: true })
  const save = element("button.button", "Save file")
  const stop = button("button.param-cancel", () => running.abort(), { hidden: true }, "Stop")
  const message = element("p.why", { role: "status" })
  const command = snippet("Command", 4)
  const python = snippet("Python", 6)
  const form = element("form", {
    onsubmit: (/** @type {Event} */ event) => {
      event.preventDefault()
      make(wanted())
    },
  }, section("File", "A picture as a file", one, element("label", "Format ", format), figure, film, page,
    element("span", save, stop), made, message))
  const dialog = dialogOf("Export", "menu-of-scenes.share.export", [], element("div.parts", form,
    section("Command", "The same on the command line", command),
    section("Python", "The same numbers in Python", python, element("span",
      copyButton("copy-python", "Copy Python", () => python.value),
      button("button.param-notebook", () => make({ picture: picture.value, format: "ipynb" }), "Open as notebook")))))
  // Sliders that move in a page.
  /** @type {Record<string, ControlValue>} */
  let controls = {}
  // The status line goes into the metadata of a PNG file.
  let status = ""
  dialog.addEventListener("close", () => running?.abort())
  form.addEventListener("input", write)
  picture.addEventListener("input", writePython)

  /** Return the sliders that are chosen to move, each over its whole range. */
  const sliders = () => moving.chosen().map((name) => `${name}=${controls[name][1]}:${controls[name][2]}:${values.value}`)
  /** @param {Wanted} what */
  const fileName = ({ picture: name, format: kind }) => `${scene.name}${kind === "html" ? "" : `-${name}`}.${kind}`

  /** Return the parameters besides the state: the fields that are there. @returns {Wanted} */
  function wanted() {
    const given = new FormData(form)
    given.delete("values")
    if (isAll()) given.set("picture", gallery.openCells().map(nameOf).join(","))
    if (isAll()) given.set("vary", sliders().join(","))
    return /** @type {Wanted} */ (Object.fromEntries([...given].filter(([, value]) => value !== "")))
  }

  /** Return the query of the state. */
  const state = () => new URL(linkTo()).search.slice(1)

  function write() {
    one.hidden = isAll()
    film.hidden = film.disabled = content() !== "film"
    page.hidden = page.disabled = !isAll()
    figure.hidden = figure.disabled = content() !== "figure" && (film.hidden || loop.value !== "")
    const count = sliders().length
    grid.disabled = count === 0
    const what = wanted()
    const most = count === 0 ? 1 : grid.checked ? values.valueAsNumber ** count : count * values.valueAsNumber
    states.textContent = most === 1 ? "One state." : `About ${most} states.`
    const options = Object.entries(what).flatMap(([name, value]) => {
      if (FLAGS.has(name)) return ` --${name}`
      return (name === "vary" ? value.split(",") : [value]).map((each) => ` --${name} ${each}`)
    }).join("")
    command.value = `hess-explorer export --state '${state().replaceAll("'", "%27")}'${options} --out ${fileName(what)}`
  }

  // Answers may arrive in any order, so keep only the answer for the chosen picture.
  async function writePython() {
    const name = picture.value
    const { file, why } = await fetched({ picture: name, format: "py" })
    const text = why ?? await file.text()
    if (name === picture.value) python.value = text
  }

  /** @param {Wanted} what @param {AbortSignal} [signal] @returns {Promise<Fetched>} */
  async function fetched(what, signal) {
    if (what.format === "png" && isOfBrowser(what)) return drawn(what)
    const isSlow = isOfBrowser(what) || "vary" in what
    const query = new URLSearchParams(what)
    try {
      const answer = await fetch(new URL(`export?${state()}&${query}`, document.baseURI), { signal })
      if (!answer.ok) return { why: await answer.text() }
      return isSlow ? await slowFileOf(answer, count) : { file: await answer.blob() }
    } catch (error) {
      return { why: /** @type {Error} */ (error).name === "AbortError" ? "Stopped." : "The server does not answer: nothing was saved." }
    }
  }

  /** @param {Wanted} what @returns {Promise<Fetched>} */
  async function drawn({ picture: name, width, black }) {
    const [title, ...words] = captionOf(gallery.cell(name))
    const parameters = Object.entries(controls).map(([key, [value]]) => `${key} = ${value}`).join(", ")
    try {
      return { file: await pictureFile(name, Number(width), black !== undefined, {
        Title: title, Description: `${files.program}, ?${state()} | ${parameters} | ${status}`, Comment: words.join(" "),
        Software: files.program,
      }) }
    } catch {
      return { why: "This browser cannot draw such a large picture: choose a smaller width." }
    }
  }

  /** @param {number[]} progress */
  function count([done, of]) {
    Object.assign(made, { hidden: false, max: of, value: done })
    message.textContent = `${isAll() ? "State" : "Frame"} ${done} of ${of}.`
  }

  /** @param {boolean} is */
  function busy(is) {
    save.disabled = is
    stop.hidden = !is
    made.hidden = true
  }

  /** @param {Wanted} what */
  async function make(what) {
    const name = fileName(what)
    running = new AbortController()
    busy(true)
    message.textContent = "Working…"
    const { file, why } = await fetched(what, running.signal)
    running = null
    busy(false)
    message.textContent = why ?? `${name}: ${Math.ceil(file.size / 1024)} kB.`
    if (why === undefined) saveFile(file, name)
  }

  listen({
    enter(description) {
      scene = description
      const numbers = scene.controls.filter(({ kind }) => kind === "number")
      moving.put(numbers.map(({ name, label }) => [name, label, false]))
      controls = {}
    },
    controls(changed) { Object.assign(controls, changed) },
    texts(changed) { status = changed.status ?? status },
    export() {
      // The file shows the moment on the screen, and the address bar may lag behind it.
      tell("run", null)
      tell("address")
      const open = gallery.openCells()
      const before = picture.value
      picture.replaceChildren(...optionsOf(open.map((cell) => [nameOf(cell), titleOf(cell)])))
      if (open.some((cell) => nameOf(cell) === before)) picture.value = before
      message.textContent = ""
      write()
      writePython()
      dialog.showModal()
    },
  })
  return dialog
}
