// @ts-check
// Strips of computed states, as "offline/strips.py" packs them: decompressed and decoded when they are needed.

/**
 * An array of a strip: its length, quantisation step (0: bits of single precision), least multiple of the step, and the number
 * of the array before it, or −1.
 * @typedef {[length: number, step: number, low: number, before: number]} Coding
 * @typedef {{trees: Tree[], arrays: Coding[], planes: number}} Head
 */

// Number of decoded strips to keep; most take 2.5 MB.
const MOST = 20

/**
 * Decode a strip: the trees of its states, and the block of numbers that all of them refer to.
 * @param {ReadableStream<Uint8Array<ArrayBuffer>>} packed
 */
export async function decodeStrip(packed) {
  const data = await new Response(packed.pipeThrough(new DecompressionStream("deflate"))).arrayBuffer()
  const length = new DataView(data).getUint32(0, true)
  /** @type {Head} */
  const { trees, arrays, planes } = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, length)))
  // The planes of the zigzag code, the lowest bytes first.
  const bytes = new Uint8Array(data, 4 + length)
  let count = 0
  const starts = arrays.map(([n]) => (count += n) - n)
  const whole = new Int32Array(count)
  const exact = new Float32Array(whole.buffer)
  const numbers = new Float32Array(count)
  for (let plane = 0; plane < planes; plane++) {
    for (let i = 0; i < count; i++) whole[i] |= bytes[plane * count + i] << (8 * plane)
  }
  arrays.forEach(([n, step, low, before], k) => {
    // Sums are modulo 2³².
    let sum = 0
    for (let i = starts[k], j = starts[before]; i < starts[k] + n; i++, j++) {
      sum = (sum + ((whole[i] >>> 1) ^ -(whole[i] & 1))) | 0
      whole[i] = sum + (before < 0 ? 0 : whole[j])
      numbers[i] = step === 0 ? exact[i] : whole[i] === 0 ? NaN : step * (low + (whole[i] >>> 0) - 1)
    }
  })
  return { trees, block: numbers.buffer }
}

/** @typedef {Awaited<ReturnType<typeof decodeStrip>>} Strip */

/**
 * Return the function that gets a strip, and keeps those that were used last.
 * @param {(number: number) => Promise<Parameters<typeof decodeStrip>[0]>} packed reads a strip
 */
export function createShelf(packed) {
  /** @type {Map<number, Promise<Strip>>} */
  const strips = new Map()
  /** @param {number} number */
  return (number) => {
    const strip = strips.get(number) ?? packed(number).then(decodeStrip)
    strips.delete(number)
    strips.set(number, strip)
    if (strips.size > MOST) strips.delete(strips.keys().next().value)
    return strip
  }
}
