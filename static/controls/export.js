// The dialog Export: the data, a figure or a film of one picture, or all of a state in one file, made by the server; the
// command that makes it, and the lines of Python that compute the same.

import { tell } from "../page/bus.js"
import { linkTo } from "../page/embedding.js"
import { element } from "../page/mount.js"
import { gallery } from "../pictures/gallery.js"
import { dialogOf } from "./dialog.js"

const options = (pairs) => pairs.map(([value, textContent]) => element("option", { value, textContent }))

// The film out of an answer that says in lines before it how far it is, see "server/export.py": {file} or {why}.
async function filmOf(answer, tell) {
  const reader = answer.body.getReader()
  const parts = []
  let [begun, length, line] = [false, 0, []]
  for (;;) {
    const { value, done } = await reader.read()
    if (done) break
    let from = 0
    while (!begun) {
      const at = value.indexOf(10, from)
      line.push(...value.subarray(from, at < 0 ? value.length : at))
      if (at < 0) break
      const [word, ...rest] = new TextDecoder().decode(Uint8Array.from(line)).split(" ")
      ;[from, line] = [at + 1, []]
      if (word === "why") return { why: rest.join(" ") }
      if (word === "file") [begun, length] = [true, Number(rest[0])]
      else if (word !== "queued") tell(word.split("/").map(Number))
    }
    if (begun) parts.push(value.subarray(from))
  }
  const file = new Blob(parts)
  return begun && file.size === length ? { file } : { why: "The film broke off: there is no file." }
}

// files: {formats: [[kind, words, what it holds], …], width and seconds: [least, most, usual]}.
// {dialog, open(), show(description of the scene on show)}.
export function exportDialog(files) {
  const holds = Object.fromEntries(files.formats.map(([kind, , what]) => [kind, what]))
  const isFilm = (kind) => holds[kind] === "film"
  const isDrawn = (kind) => isFilm(kind) || holds[kind] === "figure"
  let scene = null
  let running = null
  const picture = element("select", { className: "param-picture" })
  const format = element("select", { className: "param-format" }, ...options(files.formats))
  const number = (name, step, [min, max, value]) => (
    element("input", { type: "number", className: `param-${name}`, min, max, step, value }))
  const width = number("width", 5, files.width)
  const seconds = number("seconds", 1, files.seconds)
  const frames = element("progress", { "aria-label": "Frames of the film", hidden: true })
  const black = element("input", { type: "checkbox", className: "param-black" })
  const command = element("textarea", { className: "snippet", readOnly: true, rows: 4, "aria-label": "Command" })
  const python = element("textarea", { className: "snippet", readOnly: true, rows: 6, "aria-label": "Python" })
  const copy = element("button", { type: "button", className: "button param-copy-python", textContent: "Copy Python" })
  const book = element("button", { type: "button", className: "button param-notebook", textContent: "Open as notebook" })
  const save = element("button", { type: "button", className: "button param-save", textContent: "Save file" })
  const stop = element("button", { type: "button", className: "button param-cancel", textContent: "Stop", hidden: true })
  const said = element("p", { className: "why", role: "status" })
  const figure = element("div", { className: "figure" },
    element("label", {}, "Width, mm ", width), element("label", {}, black, " Black on white"))
  const one = element("label", {}, "Picture ", picture)
  const film = element("div", { className: "figure" }, element("label", {}, "Seconds for all of the motion ", seconds))
  const dialog = dialogOf("Export", "menu-of-scenes share export", [],
    element("div", { className: "parts" },
      element("section", { "aria-label": "File" }, element("h3", { textContent: "What a picture shows, as a file" }),
        one, element("label", {}, "Format ", format), figure, film,
        element("span", {}, save, stop), frames, said),
      element("section", { "aria-label": "Command" }, element("h3", { textContent: "The same at the command line" }),
        command),
      element("section", { "aria-label": "Python" }, element("h3", { textContent: "The same numbers in Python" }),
        python, element("span", {}, copy, book))))

  const openOnes = () => gallery.shown.cells.filter((cell) => !cell.classList.contains("folded"))
  const nameOf = (cell) => cell.dataset.name
  const isAll = () => format.value === "html"
  const fileName = ({ picture: name, format: kind }) => `${scene.name}${kind === "html" ? "" : `-${name}`}.${kind}`

  // What is asked for besides the state: the width and the look are those of a figure.
  function wanted() {
    const drawn = isDrawn(format.value)
    return {
      picture: isAll() ? openOnes().map(nameOf).join(",") : picture.value, format: format.value,
      ...(drawn ? { width: width.value } : {}), ...(drawn && black.checked ? { black: "1" } : {}),
      ...(isFilm(format.value) ? { seconds: seconds.value } : {}),
    }
  }

  // The state as its link says it.
  const state = () => new URL(linkTo()).search.slice(1)

  function write() {
    figure.hidden = !isDrawn(format.value)
    one.hidden = isAll()
    film.hidden = !isFilm(format.value)
    const { picture: name, format: kind, width: wide, black: isBlack, seconds: long } = wanted()
    command.value = `hess-explorer export --state '${state().replaceAll("'", "%27")}' --picture ${name} --format ${kind}` +
      `${wide ? ` --width ${wide}` : ""}${isBlack ? " --black" : ""}${long ? ` --seconds ${long}` : ""} --out ${fileName(wanted())}`
  }

  // The lines of Python, one picture after the other: the newest is the one that stays.
  async function writePython() {
    const name = picture.value
    const { file, why } = await fetched({ picture: name, format: "py" })
    const text = why ?? await file.text()
    if (name === picture.value) python.value = text
  }

  async function fetched(what, signal) {
    const query = new URLSearchParams({ ...what, ...(isFilm(what.format) ? { progress: "1" } : {}) })
    try {
      const answer = await fetch(new URL(`export?${state()}&${query}`, document.baseURI), { signal })
      if (!answer.ok) return { why: await answer.text() }
      return isFilm(what.format) ? await filmOf(answer, count) : { file: await answer.blob() }
    } catch (error) {
      return { why: error.name === "AbortError" ? "Stopped." : "The server does not answer: there is no file." }
    }
  }

  function count([done, of]) {
    ;[frames.hidden, frames.max, frames.value] = [false, of, done]
    said.textContent = `Frame ${done} of ${of}.`
  }

  function busy(is) {
    save.disabled = is
    stop.hidden = !is
    frames.hidden = true
  }

  async function make(what) {
    const file = fileName(what)
    running = new AbortController()
    busy(true)
    said.textContent = "Being made…"
    const { file: content, why } = await fetched(what, running.signal)
    busy(false)
    said.textContent = why ?? `${file}: ${Math.ceil(content.size / 1024)} kB.`
    if (why !== undefined) return
    const address = URL.createObjectURL(content)
    element("a", { href: address, download: file }).click()
    URL.revokeObjectURL(address)
  }

  save.addEventListener("click", () => make(wanted()))
  book.addEventListener("click", () => make({ picture: picture.value, format: "ipynb" }))
  copy.addEventListener("click", async () => {
    python.select()
    try {
      await navigator.clipboard.writeText(python.value)
      said.textContent = "The lines of Python are copied."
    } catch {
      said.textContent = "The browser does not allow it: copy the lines that are selected."
    }
  })
  picture.addEventListener("change", writePython)
  stop.addEventListener("click", () => running.abort())
  dialog.addEventListener("close", () => running?.abort())
  dialog.addEventListener("input", write)
  command.addEventListener("focus", () => command.select())

  return {
    dialog,
    show(description) { scene = description },
    open() {
      // Of what is on the screen, not of what the address bar has come to.
      tell("address")
      const open = openOnes()
      const before = picture.value
      picture.replaceChildren(...options(
        open.map((cell) => [nameOf(cell), cell.querySelector(".title").textContent])))
      if (open.some((cell) => cell.dataset.name === before)) picture.value = before
      said.textContent = ""
      write()
      writePython()
      dialog.showModal()
    },
  }
}
