// @ts-check
// The dialog Share: the link, its QR code, and HTML that embeds parts of the page in another page.

import { element } from "../base/elements.js"
import { listen, tell } from "../base/bus.js"
import { linkTo } from "../base/embedding.js"
import { qrCode } from "./qr.js"
import { gallery } from "../pictures/gallery.js"
import { isFolded, labelOf, nameOf } from "../pictures/picture.js"
import { choices, copyButton, dialogOf, section, snippet } from "./dialog.js"

// The frame of what is embedded: its width, the pictures and sliders side by side in it, and the heights of a row of each and of
// the player with the link.
const WIDTH = 960
const [PICTURES, SLIDERS] = [3, 4]
const [PICTURE, SLIDER, FOOT] = [372, 78, 84]

/** Return the height at which all parts are seen. @param {Record<"pictures" | "controls", string[]>} parts names */
const heightOf = ({ pictures, controls }) => (
  Math.ceil(pictures.length / PICTURES) * PICTURE + Math.ceil(controls.length / SLIDERS) * SLIDER + FOOT)

/** @param {string} text */
const escaped = (text) => text.replaceAll("&", "&amp;").replaceAll('"', "&quot;").replaceAll("<", "&lt;")

/** Return the dialog. */
export function shareDialog() {
  /** @type {SceneDescription | null} */
  let scene = null
  const link = element("input.address", {
    type: "text", readOnly: true, ariaLabel: "Link", onfocus: () => link.select(),
  })
  const { code, draw } = qrCode("QR code of the link")
  const why = element("p.why", { role: "status" })
  const html = snippet("HTML to embed", 4)
  const write = () => {
    const parts = { pictures: pictures.chosen(), controls: controls.chosen() }
    const src = escaped(linkTo(parts))
    html.value = `<iframe src="${src}" title="Hess Explorer: ${escaped(scene.title)}" width="${WIDTH}" height="${heightOf(parts)}"` +
      ` style="border: 0; max-width: 100%" allow="fullscreen"></iframe>`
  }
  const pictures = choices("embed-pictures", "Pictures", write)
  const controls = choices("embed-controls", "Controls", write)
  const copyLink = copyButton("link", "Copy link", () => {
    tell("address")
    return linkTo()
  })
  const copyHtml = copyButton("snippet", "Copy HTML", () => html.value)
  const dialog = dialogOf("Share", "menu-of-scenes.share", [], element("div.parts",
    section("Link", "This state of the page", link, copyLink, code, why),
    section("Embed", "Parts of this page in a page of yours", pictures.frame, controls.frame, html, copyHtml)))

  listen({
    enter(description) { scene = description },
    async share() {
      tell("address")
      link.value = linkTo()
      pictures.put(gallery.shown.cells.map((cell) => [nameOf(cell), labelOf(cell), !isFolded(cell)]))
      controls.put(scene.controls.map(({ name, label }) => [name, label, scene.essential.includes(name)]))
      write()
      why.textContent = ""
      dialog.showModal()
      why.textContent = await draw(link.value)
      code.hidden = why.textContent !== ""
    },
  })
  return dialog
}
