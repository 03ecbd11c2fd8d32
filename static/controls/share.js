// The dialog Share: the link of all that is on the screen, its QR code, and what embeds parts of the page in another one.

import { listen, tell } from "../page/bus.js"
import { linkTo } from "../page/embedding.js"
import { element } from "../page/mount.js"
import { qrCode } from "../page/qr.js"
import { gallery } from "../pictures/gallery.js"
import { dialogOf } from "./dialog.js"

const SAID_FOR = 2000
const HEIGHT = 600

const escaped = (text) => text.replaceAll("&", "&amp;").replaceAll('"', "&quot;").replaceAll("<", "&lt;")

// A button that says when what it copies is copied; so do screen readers.
function copyButton(name, label, copy) {
  const said = element("span", { className: "unseen", role: "status" })
  const button = element("button", { type: "button", className: `button param-${name}`, textContent: label })
  let timer = null
  button.addEventListener("click", copy)
  const say = (text) => {
    clearTimeout(timer)
    button.textContent = said.textContent = text
    timer = setTimeout(() => {
      button.textContent = label
      said.textContent = ""
    }, SAID_FOR)
  }
  return [element("span", {}, button, said), say]
}

// A group of check boxes: {frame, put([name, words, whether it is chosen] …), chosen()}.
function choices(name, label, changed) {
  const list = element("div", { className: "choices" })
  list.addEventListener("change", changed)
  const boxes = () => [...list.querySelectorAll("input")]
  return {
    frame: element("fieldset", { className: `embed-${name}` }, element("legend", { textContent: label }), list),
    put(items) {
      list.replaceChildren(...items.map(([value, words, checked]) => element("label", {},
        element("input", { type: "checkbox", value, checked }), words)))
    },
    chosen: () => boxes().filter((box) => box.checked).map((box) => box.value),
  }
}

// {dialog, open(), show(description of the scene on show)}.
export function shareDialog(signal) {
  let scene = null
  const link = element("input", { type: "text", className: "address", readOnly: true, "aria-label": "Link" })
  const code = element("div", { className: "code", role: "img", "aria-label": "QR code of the link" })
  const why = element("p", { className: "why", role: "status" })
  const snippet = element("textarea", { className: "snippet", readOnly: true, rows: 4, "aria-label": "HTML to embed" })
  const write = () => {
    const src = escaped(linkTo({ pictures: pictures.chosen(), controls: controls.chosen() }))
    snippet.value = `<iframe src="${src}" title="Hess Explorer: ${escaped(scene.title)}" width="100%" height="${HEIGHT}"` +
      ` style="border: 0" allow="fullscreen"></iframe>`
  }
  const pictures = choices("pictures", "Pictures", write)
  const controls = choices("controls", "Controls", write)
  const [copyLink, sayLink] = copyButton("link", "Copy link", () => tell("link"))
  const [copySnippet, saySnippet] = copyButton("snippet", "Copy HTML", () => tell("copy", snippet.value))
  listen("copied", ({ text, said }) => (text === null ? sayLink : saySnippet)(said), signal)
  const dialog = dialogOf("Share", "menu-of-scenes share", [],
    element("div", { className: "parts" },
      element("section", { "aria-label": "Link" }, element("h3", { textContent: "All that is on the screen" }),
        link, copyLink, code, why),
      element("section", { "aria-label": "Embed" }, element("h3", { textContent: "Parts of it in a page of yours" }),
        pictures.frame, controls.frame, snippet, copySnippet)))

  for (const text of [link, snippet]) text.addEventListener("focus", () => text.select())

  return {
    dialog,
    show(description) { scene = description },
    open() {
      // Of what is on the screen, not of what the address bar has come to.
      tell("address")
      link.value = linkTo()
      pictures.put(gallery.shown.cells.map((cell, i) => [
        cell.dataset.name, scene.pictures[i].folded?.replace(/^Show (the )?/, "") ?? cell.querySelector(".title").textContent,
        !cell.classList.contains("folded")]))
      controls.put(scene.controls.map(({ name, label }) => [name, label, scene.essential.includes(name)]))
      write()
      code.replaceChildren()
      why.textContent = ""
      dialog.showModal()
      qrCode(link.value).then(({ svg, said }) => {
        code.innerHTML = svg
        code.hidden = svg === ""
        why.textContent = said
      })
    },
  }
}
