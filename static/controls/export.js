// @ts-check
// The dialog Export: data, figure or film of a picture, or the whole state in one file, made by the server; the command that
// makes the file, and the Python code that computes the same.

import { button, element } from "../page/elements.js"
import { tell } from "../page/bus.js"
import { linkTo } from "../page/embedding.js"
import { gallery } from "../pictures/gallery.js"
import { nameOf, titleOf } from "../pictures/picture.js"
import { dialogOf, optionsOf, saveFile, section, snippet } from "./dialog.js"
import { filmOf } from "./film.js"

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
  const frames = element("progress", { ariaLabel: "Frames of the film", hidden: true })
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
  const dialog = dialogOf("Export", "menu-of-scenes.share.export", [], element("div.parts",
    section("File", "A picture as a file", one, element("label", "Format ", format), figure, film,
      element("span", save, stop), frames, message),
    section("Command", "The same on the command line", command),
    section("Python", "The same numbers in Python", python, element("span", copy, book))))
  dialog.addEventListener("close", () => running?.abort())
  dialog.addEventListener("input", write)

  const isAll = () => format.value === "html"
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
    }
  }

  /** Return the query of the state. */
  const state = () => new URL(linkTo()).search.slice(1)

  function write() {
    figure.hidden = !isDrawn(format.value) || (isFilm(format.value) && loop.value !== "")
    one.hidden = isAll()
    film.hidden = !isFilm(format.value)
    const what = wanted()
    const options = Object.entries(what).filter(([, value]) => value !== "")
      .map(([name, value]) => (name === "black" ? " --black" : ` --${name} ${value}`)).join("")
    command.value = `hess-explorer export --state '${state().replaceAll("'", "%27")}'${options} --out ${fileName(what)}`
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
    const query = new URLSearchParams({ ...what, ...(isFilm(what.format) && { progress: "1" }) })
    try {
      const answer = await fetch(new URL(`export?${state()}&${query}`, document.baseURI), { signal })
      if (!answer.ok) return { why: await answer.text() }
      return isFilm(what.format) ? await filmOf(answer, count) : { file: await answer.blob() }
    } catch (error) {
      return { why: /** @type {Error} */ (error).name === "AbortError" ? "Stopped." : "The server does not answer: no file was made." }
    }
  }

  /** @param {number[]} frame */
  function count([done, of]) {
    Object.assign(frames, { hidden: false, max: of, value: done })
    message.textContent = `Frame ${done} of ${of}.`
  }

  /** @param {boolean} is */
  function busy(is) {
    save.disabled = is
    stop.hidden = !is
    frames.hidden = true
  }

  /** @param {Wanted} what */
  async function make(what) {
    const name = fileName(what)
    running = new AbortController()
    busy(true)
    message.textContent = "Working…"
    const { file, why } = await fetched(what, running.signal)
    busy(false)
    message.textContent = why ?? `${name}: ${Math.ceil(file.size / 1024)} kB.`
    if (why === undefined) saveFile(file, name)
  }

  return {
    box: dialog,
    /** @param {SceneDescription} description */
    show(description) { scene = description },
    open() {
      // The address bar may lag behind the screen.
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
