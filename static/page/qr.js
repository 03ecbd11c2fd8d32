// The QR code of a link, drawn by the server.

const address = (link) => new URL(`qr.svg?text=${encodeURIComponent(link)}`, document.baseURI).href

// {svg, said}: the drawing, or a sentence why there is none.
const answer = (isThere, text) => (isThere ? { svg: text, said: "" } : { svg: "", said: text })

export async function qrCode(link) {
  try {
    const response = await fetch(address(link))
    return answer(response.ok, await response.text())
  } catch {
    return answer(false, "The server does not answer: there is no QR code.")
  }
}
