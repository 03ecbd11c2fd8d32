import assert from "node:assert/strict"
import test from "node:test"

import { unbroken } from "../../static/pictures/unbroken.js"

test("expressions between bars are parts of their own", () => {
  assert.deepEqual(unbroken("ρ = 1/4: |Θ⁴ − id| ≤ 1e−14."), ["ρ = 1/4: ", "|Θ⁴ − id|", " ≤ 1e−14."])
  assert.deepEqual(unbroken("|F₂|/|s|"), ["", "|F₂|", "/", "|s|", ""])
})

test("a text without such an expression is one part", () => {
  assert.deepEqual(unbroken("Two limit cycles."), ["Two limit cycles."])
  assert.deepEqual(unbroken("E above −|b"), ["E above −|b"])
})
