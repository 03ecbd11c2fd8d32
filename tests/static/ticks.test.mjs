import assert from "node:assert/strict"
import test from "node:test"

import { roundNumbers, tickLabels } from "../../static/pictures/ticks.js"
import { assertClose } from "./close.mjs"

// The labels of ticks where there is room for 26 letters.
const LABELS = [
  [[-4, -2, 0, 2, 4], ["−4", "−2", "0", "2", "4"]],
  [[0.1, 0.2, 0.1 + 0.2], ["0.1", "0.2", "0.3"]],
  // Sums of steps that should be zero.
  [[-2e-4, 1.3e-20, 2e-4], ["−2e−4", "0", "2e−4"]],
  [[0, 2.5e5, 5e5], ["0", "2.5e5", "5e5"]],
  // Seven letters each: there is room for every second label.
  [[0.50001, 0.50002, 0.50003, 0.50004, 0.50005], ["0.50001", "", "0.50003", "", "0.50005"]],
  [[-3, -2, -1, 0, 1, 2, 3].map((n) => 1.5e-7 * n), ["−4.5e−7", "", "−1.5e−7", "", "1.5e−7", "", "4.5e−7"]],
]

test("labels are short and fit the room", () => {
  for (const [ticks, labels] of LABELS) assert.deepEqual(tickLabels(ticks, 26), labels)
})

test("round numbers are multiples of 1, 2 or 5 times a power of ten, within the ends", () => {
  assertClose(roundNumbers(0, 1, 5), [0, 0.2, 0.4, 0.6, 0.8, 1])
  assertClose(roundNumbers(-0.3, 0.3, 6), [-0.3, -0.2, -0.1, 0, 0.1, 0.2, 0.3])
  assertClose(roundNumbers(120, 980, 2), [500])
  assertClose(roundNumbers(1e-9, 9e-9, 4), [2e-9, 4e-9, 6e-9, 8e-9], 1e-20)
})
