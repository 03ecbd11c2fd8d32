import assert from "node:assert/strict"
import test from "node:test"

import { medianCurve, middleOf } from "../../static/pictures/median.js"

test("the median of a cloud of points is that of each coordinate, and one wild guess does not move it", () => {
  assert.deepEqual(middleOf([[3, -1], [1e6, 0], [2, 5]]), [3, 0])
  assert.deepEqual(middleOf([[3, -1], [1e6, 0], [2, 5], [4, 1]]), [3.5, 0.5])
})

test("of five shifted curves the median is the middle one, from left to right", () => {
  const truth = Array.from({ length: 8 }, (_, x) => [x, x ** 2 - 3 * x])
  // Drawn in any direction; the last one is far off.
  const guesses = [0, -0.4, 0.3, -0.1, 1000].map((shift, i) => {
    const curve = truth.map(([x, y]) => [x, y + shift])
    return i % 2 === 0 ? curve : curve.reverse()
  })
  assert.deepEqual(medianCurve(guesses.flat()), truth)
  assert.deepEqual(medianCurve([[2, 5], [0, 1]]), [[0, 1], [2, 5]])
})
