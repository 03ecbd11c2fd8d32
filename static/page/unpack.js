// The tree of a state and its block of single-precision numbers → columns; `wire.py` describes both.

export function unpack(sources, block) {
  const place = (item) => {
    if (Array.isArray(item)) return item.map(place)
    if (typeof item !== "object" || item === null) return item
    const numbers = new Float32Array(block, 4 * item.at, item.n)
    if (item.shape === undefined) return numbers
    const [rows, columns] = item.shape
    return { rows, columns, numbers }
  }
  return Object.entries(sources).map(([name, columns]) => (
    [name, Object.fromEntries(Object.entries(columns).map(([key, column]) => [key, place(column)]))]))
}
