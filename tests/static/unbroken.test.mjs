import assert from "node:assert/strict"
import test from "node:test"

import { unbroken } from "../../static/pictures/unbroken.js"

test("expressions are parts of their own", () => {
  assert.deepEqual(unbroken("ρ = 1/4: |Θ⁴ − id| ≤ 1e−14."), ["", "ρ = 1/4:", " ", "|Θ⁴ − id|", " ≤ 1e−14."])
  assert.deepEqual(unbroken("|F₂|/|s|"), ["", "|F₂|", "/", "|s|", ""])
  assert.deepEqual(unbroken("ρ over (h, f)"), ["ρ over ", "(h, f)", ""])
  assert.deepEqual(unbroken("At a = 0.5, h = 2"), ["At ", "a = 0.5,", " ", "h = 2", ""])
})

test("a text without expressions is one part", () => {
  assert.deepEqual(unbroken("Two limit cycles."), ["Two limit cycles."])
  assert.deepEqual(unbroken("Section (all upward crossings of it)"), ["Section (all upward crossings of it)"])
  assert.deepEqual(unbroken("E above −|b"), ["E above −|b"])
})
