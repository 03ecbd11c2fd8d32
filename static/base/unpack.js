// @ts-check
// Columns of a state from its tree and its block of single-precision numbers, see "protocol/wire.py".

/** @typedef {{at: number, n: number, shape?: [number, number], shorts?: number}} Packed */

/**
 * Return [name, columns] of each source.
 * @param {Tree["sources"]} sources
 * @param {ArrayBuffer} block
 * @returns {[string, Data][]}
 */
export function unpack(sources, block) {
  /** @param {any} item a list, a plain value, or a `Packed` array @returns {unknown} */
  const place = (item) => {
    if (Array.isArray(item)) return item.map(place)
    if (typeof item !== "object" || item === null) return item
    if (item.shorts !== undefined) return new Int16Array(block, 4 * item.at, item.shorts)
    const numbers = new Float32Array(block, 4 * item.at, item.n)
    if (item.shape === undefined) return numbers
    const [rows, columns] = item.shape
    return { rows, columns, numbers }
  }
  return Object.entries(sources).map(([name, columns]) => (
    [name, Object.fromEntries(Object.entries(columns).map(([key, column]) => [key, place(column)]))]))
}
