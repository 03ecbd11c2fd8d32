// @ts-check
// The QR code of a link, drawn by the server.

import { element } from "../base/elements.js"

/**
 * Return an image of a QR code, and the function that draws the code of a link in it and returns why there is none, or "".
 * @param {string} ariaLabel
 */
export function qrCode(ariaLabel) {
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
