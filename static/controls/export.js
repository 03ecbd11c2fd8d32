// The dialog Export: the data or a figure of one picture, as a file made by the server, and the command that makes it.

import { tell } from "../page/bus.js"
import { linkTo } from "../page/embedding.js"
import { element } from "../page/mount.js"
import { gallery } from "../pictures/gallery.js"

const FORMATS = [
  ["csv", "CSV: data, every digit"], ["json", "JSON: data, every digit"],
  ["png", "PNG, 300 dots an inch"], ["svg", "SVG"], ["pdf", "PDF"],
]
const FIGURES = ["png", "svg", "pdf"]

const options = (pairs) => pairs.map(([value, textContent]) => element("option", { value, textContent }))

// {dialog, open(), show(description of the scene on show)}.
export function exportDialog() {
  let scene = null
  let running = null
  const picture = element("select", { className: "param-picture" })
  const format = element("select", { className: "param-format" }, ...options(FORMATS))
  const width = element("input", { type: "number", className: "param-width", min: 20, max: 400, step: 5, value: 85 })
  const black = element("input", { type: "checkbox", className: "param-black" })
  const command = element("textarea", { className: "snippet", readOnly: true, rows: 4, "aria-label": "Command" })
  const save = element("button", { type: "button", className: "button param-save", textContent: "Save file" })
  const stop = element("button", { type: "button", className: "button param-cancel", textContent: "Stop", hidden: true })
  const said = element("p", { className: "why", role: "status" })
  const close = element("button", { type: "button", className: "button", textContent: "Close" })
  const figure = element("div", { className: "figure" },
    element("label", {}, "Width, mm ", width), element("label", {}, black, " Black on white"))
  const dialog = element("dialog", { className: "menu-of-scenes share export", "aria-label": "Export" },
    element("div", { className: "head" }, element("h2", { textContent: "Export" }), close),
    element("div", { className: "parts" },
      element("section", { "aria-label": "File" }, element("h3", { textContent: "What a picture shows, as a file" }),
        element("label", {}, "Picture ", picture), element("label", {}, "Format ", format), figure,
        element("span", {}, save, stop), said),
      element("section", { "aria-label": "Command" }, element("h3", { textContent: "The same at the command line" }),
        command)))

  // What is asked for besides the state: the width and the look are those of a figure.
  function wanted() {
    const drawn = FIGURES.includes(format.value)
    return {
      picture: picture.value, format: format.value,
      ...(drawn ? { width: width.value } : {}), ...(drawn && black.checked ? { black: "1" } : {}),
    }
  }

  // The state as its link says it.
  const state = () => new URL(linkTo()).search.slice(1)

  function write() {
    figure.hidden = !FIGURES.includes(format.value)
    const { picture: name, format: kind, width: wide, black: isBlack } = wanted()
    command.value = `hess-explorer export --state '${state().replaceAll("'", "%27")}' --picture ${name} --format ${kind}` +
      `${wide ? ` --width ${wide}` : ""}${isBlack ? " --black" : ""} --out ${scene.name}-${name}.${kind}`
  }

  async function fetched() {
    const query = new URLSearchParams(wanted())
    try {
      const answer = await fetch(new URL(`export?${state()}&${query}`, document.baseURI), { signal: running.signal })
      if (!answer.ok) return { why: await answer.text() }
      return { file: await answer.blob() }
    } catch (error) {
      return { why: error.name === "AbortError" ? "Stopped." : "The server does not answer: there is no file." }
    }
  }

  function busy(is) {
    save.disabled = is
    stop.hidden = !is
  }

  async function make() {
    const { picture: name, format: kind } = wanted()
    const file = `${scene.name}-${name}.${kind}`
    running = new AbortController()
    busy(true)
    said.textContent = "Being made…"
    const { file: content, why } = await fetched()
    busy(false)
    said.textContent = why ?? `${file}: ${Math.ceil(content.size / 1024)} kB.`
    if (why !== undefined) return
    const address = URL.createObjectURL(content)
    element("a", { href: address, download: file }).click()
    URL.revokeObjectURL(address)
  }

  save.addEventListener("click", make)
  stop.addEventListener("click", () => running.abort())
  close.addEventListener("click", () => dialog.close())
  dialog.addEventListener("close", () => running?.abort())
  dialog.addEventListener("click", ({ target }) => { if (target === dialog) dialog.close() })
  dialog.addEventListener("input", write)
  // Nothing of it is for the page beneath.
  dialog.addEventListener("keydown", (event) => event.stopPropagation())
  command.addEventListener("focus", () => command.select())

  return {
    dialog,
    show(description) { scene = description },
    open() {
      // Of what is on the screen, not of what the address bar has come to.
      tell("address")
      const open = gallery.shown.cells.filter((cell) => !cell.classList.contains("folded"))
      const before = picture.value
      picture.replaceChildren(...options(
        open.map((cell) => [cell.dataset.name, cell.querySelector(".title").textContent])))
      if (open.some((cell) => cell.dataset.name === before)) picture.value = before
      said.textContent = ""
      write()
      dialog.showModal()
    },
  }
}
