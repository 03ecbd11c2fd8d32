// @ts-check
// The dialog Share: the link, its QR code, and HTML that embeds parts of the page in another page; and the dialog Invite: QR code
// and address for followers, and their number.

import { button, element } from "../base/elements.js"
import { listen, tell } from "../base/bus.js"
import { linkTo } from "../base/embedding.js"
import { gallery } from "../pictures/gallery.js"
import { isFolded, labelOf, nameOf } from "../pictures/picture.js"
import { choices, copyButton, dialogOf, section, snippet } from "./dialog.js"

// Frame of an embedded page: its width in pixels, the numbers of pictures and of sliders side by side, and the heights of a row
// of pictures, of a row of sliders, and of the player with the link.
const WIDTH = 960
const [PICTURES, SLIDERS] = [3, 4]
const [PICTURE, SLIDER, FOOT] = [372, 78, 84]

/** Return the height at which all parts are visible. @param {Record<"pictures" | "controls", string[]>} parts names */
const heightOf = ({ pictures, controls }) => (
  Math.ceil(pictures.length / PICTURES) * PICTURE + Math.ceil(controls.length / SLIDERS) * SLIDER + FOOT)

/** @param {string} text */
const escaped = (text) => text.replaceAll("&", "&amp;").replaceAll('"', "&quot;").replaceAll("<", "&lt;")

/**
 * Return an image of a QR code, and the function that draws the code of a link in it and returns why there is none, or "".
 * @param {string} ariaLabel
 */
function qrCode(ariaLabel) {
  const code = element("div.code", { role: "img", ariaLabel })
  /** @param {string} link "" for none */
  async function draw(link) {
    code.replaceChildren()
    if (link === "") return ""
    try {
      const response = await fetch(new URL(`qr.svg?text=${encodeURIComponent(link)}`, document.baseURI))
      const text = await response.text()
      if (!response.ok) return text
      code.innerHTML = text
      return ""
    } catch {
      return "The server does not answer: no QR code."
    }
  }
  return { code, draw }
}

/** Return the dialog Share. */
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

/** Return the dialog Invite, which opens with the room. */
export function inviteDialog() {
  const { code, draw } = qrCode("QR code of the address")
  const scan = element("p", { hidden: true }, "Scan the code, or open")
  const address = element("p.room-address")
  const count = element("p.room-count", { role: "status" })
  const unreachable = element("p.unreachable", { hidden: true }, "Phones cannot reach this address. Start the explorer with " +
    "--address 0.0.0.0, and open the page by the name of this computer in its network.")
  const end = button("button.param-end-room", () => tell("end-room"), "End the lecture")
  const dialog = dialogOf("Invite", "menu-of-scenes.invite", [], element("div.invitation",
    code, element("div", scan, address, unreachable, count,
      element("p.small", "Phones show your scene, state, picture and lesson step, and take guesses. No names are collected, and " +
        "nothing is kept when the lecture ends."), end)))
  let drawn = ""

  /** @param {string} link */
  async function show(link) {
    if (link === drawn) return
    drawn = link
    const [, host, path] = /^https?:\/\/(.*)(\/r\/.*)$/.exec(link) ?? ["", "", ""]
    unreachable.hidden = !/^(localhost|127\.|\[::1\])/.test(host)
    address.replaceChildren(host, element("wbr"), element("span", path))
    const why = await draw(link)
    if (why !== "") count.textContent = why
  }

  listen({
    room({ code: name, address: link, followers, said }) {
      scan.hidden = end.hidden = name === null
      count.textContent = name === null ? said : `${followers} follower${followers === 1 ? "" : "s"}`
      show(link)
    },
    invite() {
      tell("open-room")
      dialog.showModal()
    },
  })
  return dialog
}
