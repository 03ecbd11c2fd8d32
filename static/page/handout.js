// @ts-check
// The handout: when the page is printed, it is replaced by the pictures, numbers and text of the state, and its link with a
// QR code.

import { gallery } from "../pictures/gallery.js"
import { shadesOf } from "../pictures/looks.js"
import { listen, tell } from "./bus.js"
import { linkTo } from "./embedding.js"
import { element } from "./elements.js"
import { showSigns } from "./prose.js"
import { qrCode } from "./qr.js"

// Pixels of a picture that is printed 88 mm wide, at 340 dpi.
const SIDE = 1180
const PLAYED = "Time t"

const styles = new URL("handout.css", import.meta.url).href

/**
 * Return [label, value as text] of all enabled controls, and the time.
 * @param {SceneDescription} scene
 * @param {Record<string, ControlValue>} values
 * @param {number | null} t
 * @returns {[string, string][]}
 */
function numbersOf({ controls }, values, t) {
  /** @param {ControlValue} value */
  const text = (value) => (Array.isArray(value) ? String(Number(value[0].toPrecision(12))).replace("-", "−") : value)
  /** @type {[string, string][]} */
  const rows = controls.filter(({ name }) => values[name]?.[4] !== true).map(({ name, label }) => [label, text(values[name])])
  if (t !== null) rows.push([PLAYED, t.toFixed(3)])
  return rows
}

/** @param {ReturnType<typeof gallery.shoot>[number]} shot */
function figureOf([title, verdict, numbers, canvas]) {
  return element("figure", canvas,
    element("figcaption", element("strong", title), " ", element("span", verdict), " ", element("small", numbers)))
}

/** @param {SceneDescription} scene @param {string} signs */
function legendOf({ legend }, signs) {
  const box = element("div", { innerHTML: legend })
  showSigns(box, signs)
  return box
}

/**
 * Build the handout whenever the page is printed.
 * @param {() => {scene: SceneDescription, texts: Texts, controls: Record<string, ControlValue>}} now returns the state on show
 */
export function createHandout(now) {
  /** @type {HTMLElement | null} */
  let sheet = null
  let moment = 0

  const link = element("link", { rel: "stylesheet", media: "print", href: styles })
  document.head.append(link)

  /** @param {string} code */
  function put(code) {
    const { scene, texts, controls } = now()
    const url = linkTo()
    const t = gallery.source("data-orbit") === undefined ? null : moment
    const rows = numbersOf(scene, controls, t).map(([name, value]) => element("tr",
      element("th", { scope: "row" }, name), element("td", value)))
    sheet?.remove()
    sheet = element("article.handout", { hidden: true },
      element("header",
        element("div", element("h1", scene.title), element("a", { href: url }, url)),
        element("div.code", { innerHTML: code })),
      element("div.pictures", ...gallery.shoot(SIDE).map(figureOf)),
      legendOf(scene, texts.signs ?? ""),
      element("div.numbers", element("table", element("tbody", ...rows)),
        element("p", [texts.derived, texts.notes].filter(Boolean).join("\n\n"))),
      element("div.words", { innerHTML: scene.words }))
    // Legends and drawings name their colours.
    for (const [name, shade] of shadesOf(false)) sheet.style.setProperty(`--${name}`, shade)
    document.body.append(sheet)
  }

  listen({
    time({ t }) { moment = t },
    async print() {
      tell("address")
      put((await qrCode(linkTo())).svg)
      window.print()
    },
  })
  document.addEventListener("keydown", (event) => {
    if (event.defaultPrevented || !(event.ctrlKey || event.metaKey) || event.shiftKey || event.altKey || event.key !== "p") return
    event.preventDefault()
    tell("print")
  })
  // Printing from the browser's menu cannot wait for the QR code.
  window.addEventListener("beforeprint", () => { if (sheet === null && now().scene !== null) put("") })
  window.addEventListener("afterprint", () => {
    sheet?.remove()
    sheet = null
  })
}
