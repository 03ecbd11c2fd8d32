// @ts-check
// The QR code of a link, drawn by the server.

/**
 * Return the QR code of a link as SVG, or the message that explains why there is none.
 * @param {string} link
 * @returns {Promise<{svg: string, said: string}>}
 */
export async function qrCode(link) {
  try {
    const response = await fetch(new URL(`qr.svg?text=${encodeURIComponent(link)}`, document.baseURI))
    const text = await response.text()
    return response.ok ? { svg: text, said: "" } : { svg: "", said: text }
  } catch {
    return { svg: "", said: "The server does not answer: no QR code." }
  }
}
