// @ts-check
// PNG files with their resolution, and with texts as metadata.

const METRE = 39.37
// Number of bytes of the signature and the first chunk, after which other chunks may follow.
const HEAD = 33

/** Return the check sum of the PNG format. @param {Uint8Array} bytes */
function checkSum(bytes) {
  let sum = ~0
  for (const byte of bytes) {
    sum ^= byte
    for (let bit = 0; bit < 8; bit++) sum = (sum >>> 1) ^ (sum & 1 ? 0xEDB88320 : 0)
  }
  return ~sum >>> 0
}

/** @param {string} type @param {Uint8Array} data */
function chunk(type, data) {
  const whole = new Uint8Array(data.length + 12)
  const view = new DataView(whole.buffer)
  view.setUint32(0, data.length)
  whole.set(new TextEncoder().encode(type), 4)
  whole.set(data, 8)
  view.setUint32(data.length + 8, checkSum(whole.subarray(4, -4)))
  return whole
}

/**
 * Return a canvas as a PNG file.
 * @param {HTMLCanvasElement} canvas
 * @param {number} dots per inch
 * @param {Record<string, string>} facts texts by keyword
 */
export async function pngOf(canvas, dots, facts) {
  const blob = await new Promise((/** @type {(blob: Blob) => void} */ done) => { canvas.toBlob(done) })
  const size = new DataView(new ArrayBuffer(9))
  size.setUint32(0, Math.round(dots * METRE))
  size.setUint32(4, Math.round(dots * METRE))
  size.setUint8(8, 1)
  const texts = Object.entries(facts).map(([name, text]) => (
    chunk("iTXt", new TextEncoder().encode(`${name}\0\0\0\0\0${text}`))))
  return new Blob([blob.slice(0, HEAD), chunk("pHYs", new Uint8Array(size.buffer)), ...texts, blob.slice(HEAD)], { type: blob.type })
}
