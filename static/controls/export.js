// @ts-check
// The dialog Export: data, figure or film of a picture, or the whole state in one file; the command that makes the file, and the
// Python code that computes the same.  The server makes the file, but for a PNG of what is no plot, which the page draws again.

import { button, element } from "../base/elements.js"
import { listen, tell } from "../base/bus.js"
import { linkTo } from "../base/embedding.js"
import { pictureFile } from "../pictures/files.js"
import { gallery } from "../pictures/gallery.js"
import { captionOf, nameOf, titleOf } from "../pictures/picture.js"
import { choices, dialogOf, optionsOf, saveFile, section, snippet } from "./dialog.js"
import { slowFileOf } from "./slow_file.js"

// [least, most, first] number of values of a slider.
/** @type {[number, number, number]} */
const VALUES = [2, 400, 40]
const FLAGS = new Set(["black", "grid"])

/** @typedef {Record<string, string> & {picture: string, format: string}} Wanted */
/** @typedef {{file?: Blob, why?: string}} Fetched a file, or the reason that there is none */

/**
 * Return the dialog and the functions that open it and set its scene.
 * @param {ExportFiles} files
 */
export function exportDialog(files) {
  const holds = Object.fromEntries(files.formats.map(([kind, , what]) => [kind, what]))
  /** @param {string} kind */
  const isFilm = (kind) => holds[kind] === "film"
  /** @param {string} kind */
  const isDrawn = (kind) => isFilm(kind) || holds[kind] === "figure"
  /** Whether a browser draws the file: this one a PNG, that of the server everything else. @param {Wanted} what */
  const isOfBrowser = ({ picture: name, format: kind }) => (
    isFilm(kind) || (isDrawn(kind) && scene.pictures.some((one) => one.name === name && one.kind !== "plot")))
  /** @type {SceneDescription | null} */
  let scene = null
  /** @type {AbortController | null} */
  let running = null
  const picture = element("select.param-picture", { onchange: writePython })
  const format = element("select.param-format", ...optionsOf(files.formats))
  /** @param {string} name @param {number} step @param {[number, number, number]} limits */
  const number = (name, step, [min, max, value]) => (
    element(`input.param-${name}`, { type: "number", min, max, step, value }))
  const width = number("width", 5, files.width)
  const seconds = number("seconds", 1, files.seconds)
  const loop = element("select.param-loop", ...optionsOf([["", "the whole motion, once"],
    ["light", "a loop of 1080 pixels, light"], ["dark", "a loop of 1080 pixels, dark"]]))
  const made = element("progress", { ariaLabel: "Frames or states", hidden: true })
  const black = element("input.param-black", { type: "checkbox" })
  const command = snippet("Command", 4)
  const python = element("textarea.snippet", { readOnly: true, rows: 6, ariaLabel: "Python" })
  const copy = button("button.param-copy-python", copyPython, "Copy Python")
  const book = button("button.param-notebook", () => make({ picture: picture.value, format: "ipynb" }), "Open as notebook")
  const save = button("button.param-save", () => make(wanted()), "Save file")
  const stop = button("button.param-cancel", () => running.abort(), { hidden: true }, "Stop")
  const message = element("p.why", { role: "status" })
  const figure = element("div.figure",
    element("label", "Width, mm ", width), element("label", black, " Black on white"))
  const one = element("label", "Picture ", picture)
  const film = element("div.figure", element("label", "Film ", loop), element("label", "Seconds ", seconds))
  // Sliders that move in a page.
  /** @type {Record<string, ControlValue>} */
  let controls = {}
  // The status line, for the metadata of a PNG.
  let status = ""
  const moving = choices("moving", "Sliders that move in the file")
  const values = number("values", 1, VALUES)
  const grid = element("input.param-grid", { type: "checkbox" })
  const states = element("p.states")
  const page = element("div.page", moving.frame,
    element("div.figure", element("label", "Values each ", values), element("label", grid, " All combinations")), states)
  const dialog = dialogOf("Export", "menu-of-scenes.share.export", [], element("div.parts",
    section("File", "A picture as a file", one, element("label", "Format ", format), figure, film, page,
      element("span", save, stop), made, message),
    section("Command", "The same on the command line", command),
    section("Python", "The same numbers in Python", python, element("span", copy, book))))
  listen({
    controls(changed) { Object.assign(controls, changed) },
    texts(changed) { status = changed.status ?? status },
  })
  dialog.addEventListener("close", () => running?.abort())
  dialog.addEventListener("input", write)

  const isAll = () => format.value === "html"
  /** Return the sliders that are chosen to move, each over its whole range. */
  const sliders = () => moving.chosen().map((name) => `${name}=${controls[name][1]}:${controls[name][2]}:${values.value}`)
  /** @param {Wanted} what */
  const fileName = ({ picture: name, format: kind }) => `${scene.name}${kind === "html" ? "" : `-${name}`}.${kind}`

  /** Return the parameters besides the state; only figures and films have a width and a look. @returns {Wanted} */
  function wanted() {
    const isLoop = isFilm(format.value) && loop.value !== ""
    // A loop has its own width and colours.
    const drawn = isDrawn(format.value) && !isLoop
    return {
      picture: isAll() ? gallery.openCells().map(nameOf).join(",") : picture.value, format: format.value,
      ...(drawn && { width: width.value }), ...(drawn && black.checked && { black: "1" }),
      ...(isFilm(format.value) && { seconds: seconds.value }), ...(isLoop && { loop: loop.value }),
      ...(isAll() && sliders().length > 0 && { vary: sliders().join(","), ...(grid.checked && { grid: "1" }) }),
    }
  }

  /** Return the query of the state. */
  const state = () => new URL(linkTo()).search.slice(1)

  function write() {
    figure.hidden = !isDrawn(format.value) || (isFilm(format.value) && loop.value !== "")
    one.hidden = isAll()
    film.hidden = !isFilm(format.value)
    page.hidden = !isAll()
    const what = wanted()
    states.textContent = countOfStates() === 1 ? "One state." : `About ${countOfStates()} states.`
    const options = Object.entries(what).filter(([, value]) => value !== "").flatMap(([name, value]) => {
      if (FLAGS.has(name)) return ` --${name}`
      return (name === "vary" ? value.split(",") : [value]).map((one) => ` --${name} ${one}`)
    }).join("")
    command.value = `hess-explorer export --state '${state().replaceAll("'", "%27")}'${options} --out ${fileName(what)}`
  }

  /** Return how many states a page will have. */
  function countOfStates() {
    const count = sliders().length
    return count === 0 ? 1 : grid.checked ? values.valueAsNumber ** count : count * values.valueAsNumber
  }

  // Answers may come in any order: keep the one for the picture that is chosen.
  async function writePython() {
    const name = picture.value
    const { file, why } = await fetched({ picture: name, format: "py" })
    const text = why ?? await file.text()
    if (name === picture.value) python.value = text
  }

  async function copyPython() {
    python.select()
    try {
      await navigator.clipboard.writeText(python.value)
      message.textContent = "Python code copied."
    } catch {
      message.textContent = "The browser does not allow copying: copy the selected lines."
    }
  }

  /** @param {Wanted} what @param {AbortSignal} [signal] @returns {Promise<Fetched>} */
  async function fetched(what, signal) {
    if (what.format === "png" && isOfBrowser(what)) return drawn(what)
    const isSlow = isOfBrowser(what) || "vary" in what
    const query = new URLSearchParams({ ...what })
    try {
      const answer = await fetch(new URL(`export?${state()}&${query}`, document.baseURI), { signal })
      if (!answer.ok) return { why: await answer.text() }
      return isSlow ? await slowFileOf(answer, count) : { file: await answer.blob() }
    } catch (error) {
      return { why: /** @type {Error} */ (error).name === "AbortError" ? "Stopped." : "The server does not answer: no file was made." }
    }
  }

  /** @param {Wanted} what @returns {Promise<Fetched>} */
  async function drawn({ picture: name, black: isBlack }) {
    const [least, most] = files.width
    const millimetres = width.valueAsNumber
    if (!(millimetres >= least && millimetres <= most)) return { why: `A figure must be ${least} to ${most} mm wide.` }
    const [title, ...words] = captionOf(gallery.cell(name))
    const parameters = Object.entries(controls).map(([key, [value]]) => `${key} = ${value}`).join(", ")
    try {
      return { file: await pictureFile(name, millimetres, isBlack !== undefined, {
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

  return {
    box: dialog,
    /** @param {SceneDescription} description */
    show(description) {
      scene = description
      const numbers = scene.controls.filter(({ kind }) => kind === "number")
      moving.put(numbers.map(({ name, label }) => [name, label, false]))
      controls = {}
    },
    open() {
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
  }
}
