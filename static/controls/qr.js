// @ts-check
// The QR code of a link, drawn by the server.

import { isFile } from "../base/embedding.js"

/** @param {string} link */
const address = (link) => new URL(`qr.svg?text=${encodeURIComponent(link)}`, document.baseURI).href

/** @param {boolean} isThere @param {string} text */
const answer = (isThere, text) => (isThere ? { svg: text, said: "" } : { svg: "", said: text })

/**
 * Return the QR code of a link as SVG, or the message that explains why there is none.
 * @param {string} link
 * @returns {Promise<{svg: string, said: string}>}
 */
export async function qrCode(link) {
  if (isFile()) return answer(false, "")
  try {
    const response = await fetch(address(link))
    return answer(response.ok, await response.text())
  } catch {
    return answer(false, "The server does not answer: no QR code.")
  }
}
