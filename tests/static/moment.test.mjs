import assert from "node:assert/strict"
import test from "node:test"

import { between, stateAt } from "../../static/pictures/moment.js"
import { assertClose } from "./close.mjs"

const TIMES = [0, 0.5, 0.75, 2]

test("a time lies between the samples before and after it", () => {
  assert.deepEqual([0, 0.25, 0.5, 0.625, 1.375].map((t) => between(TIMES, t)), [[0, 0], [0, 0.5], [1, 0], [1, 0.5], [2, 0.5]])
})

test("a time beyond the samples is the first or the last one", () => {
  assert.deepEqual([between(TIMES, -1), between(TIMES, 2), between(TIMES, 9)], [[0, 0], [2, 1], [2, 1]])
})

test("columns are interpolated linearly, here exactly", () => {
  const data = { t: TIMES, x: TIMES.map((t) => 3 - 2 * t) }
  for (const t of [0, 0.1, 0.6, 1.9, 2]) {
    const state = stateAt(data, [], t)
    assertClose([state.t, state.x], [t, 3 - 2 * t])
  }
})

test("an angle that crosses ±π takes the nearer sample; other columns are interpolated", () => {
  const data = { t: [0, 1], angle: [3, -3], x: [3, -3] }
  assert.deepEqual(stateAt(data, ["angle"], 0.25), { t: 0.25, angle: 3, x: 1.5 })
  assert.deepEqual(stateAt(data, ["angle"], 0.75), { t: 0.75, angle: -3, x: -1.5 })
  assert.equal(stateAt({ t: [0, 1], angle: [0.5, 1] }, ["angle"], 0.5).angle, 0.75)
})
