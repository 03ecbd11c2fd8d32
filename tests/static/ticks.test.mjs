import assert from "node:assert/strict"
import test from "node:test"

import { tickLabels } from "../../static/pictures/ticks.js"

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
