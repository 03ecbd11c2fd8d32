// @ts-check
// Medians of numbers, points and curves.

// Number of pieces of a median curve.
const MOST_PIECES = 8

/** Return the median. @param {number[]} values */
export function median(values) {
  const sorted = [...values].sort((a, b) => a - b)
  const middle = sorted.length >> 1
  return sorted.length % 2 === 1 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2
}

/** Return the point whose coordinates are the medians of theirs. @param {number[][]} points */
export const middleOf = (points) => [0, 1].map((i) => median(points.map((point) => point[i])))

/** Return the median curve: the middles of equally many points, from left to right. @param {number[][]} points */
export function medianCurve(points) {
  const sorted = [...points].sort(([x], [other]) => x - other)
  const pieces = Math.min(MOST_PIECES, sorted.length)
  return Array.from({ length: pieces }, (_, i) => (
    middleOf(sorted.slice(Math.floor(i * sorted.length / pieces), Math.floor((i + 1) * sorted.length / pieces)))))
}
