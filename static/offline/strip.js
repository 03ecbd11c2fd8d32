// @ts-check
// Strips of computed states, as "offline/strips.py" packs them: decompressed and decoded when they are needed.

/**
 * An array of a strip: its length, quantisation step (0: bits of single precision), least multiple of the step, and the number
 * of the array before it, or −1.
 * @typedef {[length: number, step: number, low: number, before: number]} Coding
 * @typedef {{trees: StoredTree[], arrays: Coding[], planes: number}} Head
 * @typedef {Omit<Tree, "sources"> & {sources: Record<string, Record<string, any>>}} StoredTree a tree whose arrays are {of, shape}
 */

/**
 * Return the whole numbers of all arrays, one after the other.
 * @param {Coding[]} arrays
 * @param {Uint8Array} bytes the planes of the zigzag code, the lowest bytes first
 * @param {number} planes
 */
export function wholeNumbers(arrays, bytes, planes) {
  const starts = [0]
  for (const [length] of arrays) starts.push(starts.at(-1) + length)
  const count = starts.at(-1)
  const whole = new Int32Array(count)
  for (let plane = 0; plane < planes; plane++) {
    const from = plane * count
    for (let i = 0; i < count; i++) whole[i] |= bytes[from + i] << (8 * plane)
  }
  for (let i = 0; i < count; i++) whole[i] = (whole[i] >>> 1) ^ -(whole[i] & 1)
  arrays.forEach(([length, , , before], k) => {
    const part = whole.subarray(starts[k], starts[k] + length)
    // Sums are taken modulo 2³².
    for (let i = 1; i < length; i++) part[i] += part[i - 1]
    if (before >= 0) {
      const other = starts[before]
      for (let i = 0; i < length; i++) part[i] += whole[other + i]
    }
  })
  return { whole, starts }
}

/**
 * Write an array in single precision.
 * @param {Float32Array} target
 * @param {Int32Array} whole
 * @param {Coding} coding
 */
function restore(target, whole, [length, step, low]) {
  if (step === 0) target.set(new Float32Array(whole.slice().buffer))
  else for (let i = 0; i < length; i++) target[i] = whole[i] === 0 ? NaN : step * (low + (whole[i] >>> 0) - 1)
}

/**
 * Decode a strip.
 * @param {ReadableStream<Uint8Array<ArrayBuffer>>} packed
 */
export async function decodeStrip(packed) {
  const data = await new Response(packed.pipeThrough(new DecompressionStream("deflate"))).arrayBuffer()
  const length = new DataView(data).getUint32(0, true)
  /** @type {Head} */
  const { trees, arrays, planes } = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, length)))
  const { whole, starts } = wholeNumbers(arrays, new Uint8Array(data, 4 + length), planes)
  return {
    size: whole.length,
    trees,
    /**
     * Return the columns of sources and their block, as `unpack` reads them.
     * @param {StoredTree["sources"]} sources
     * @returns {[Tree["sources"], ArrayBuffer]}
     */
    block(sources) {
      /** @type {Map<number, number>} */
      const places = new Map()
      let size = 0
      /** @param {any} item @returns {any} */
      const placed = (item) => {
        if (Array.isArray(item)) return item.map(placed)
        if (typeof item !== "object" || item === null) return item
        const { of, shape } = item
        const n = arrays[of][0]
        if (!places.has(of)) {
          places.set(of, size)
          size += n
        }
        return { at: places.get(of), n, ...(shape && { shape }) }
      }
      const found = Object.fromEntries(Object.entries(sources).map(([source, columns]) => (
        [source, Object.fromEntries(Object.entries(columns).map(([name, column]) => [name, placed(column)]))])))
      const block = new Float32Array(size)
      for (const [of, at] of places) {
        const n = arrays[of][0]
        restore(block.subarray(at, at + n), whole.subarray(starts[of], starts[of] + n), arrays[of])
      }
      return [found, block.buffer]
    },
  }
}

/** @typedef {Awaited<ReturnType<typeof decodeStrip>>} Strip */

/**
 * Return the function that gets a strip: decoded once, and dropped when others took the room of `most` numbers.
 * @param {(number: number) => Promise<Parameters<typeof decodeStrip>[0]>} packed reads a strip
 * @param {number} most
 */
export function createShelf(packed, most) {
  /** @type {Map<number, Promise<Strip>>} */
  const strips = new Map()
  /** @type {Map<number, number>} */
  const sizes = new Map()
  const drop = () => {
    let total = [...sizes.values()].reduce((sum, size) => sum + size, 0)
    // The oldest first, but never the last one.
    for (const number of strips.keys()) {
      if (total <= most || strips.size === 1) return
      total -= sizes.get(number) ?? 0
      strips.delete(number)
      sizes.delete(number)
    }
  }
  /** @param {number} number */
  return (number) => {
    const known = strips.get(number) ?? packed(number).then(decodeStrip).then((strip) => {
      sizes.set(number, strip.size)
      drop()
      return strip
    })
    strips.delete(number)
    strips.set(number, known)
    return known
  }
}
