import assert from "node:assert/strict"
import test from "node:test"

import { around, isWithoutNumber, numberIn, placeOf, reading, stateOf } from "../../static/controls/chart_cells.js"
import { categoriesOf, categoryColours, coloursOf, filled } from "../../static/pictures/chart_colours.js"
import { assertClose } from "./close.mjs"

// Three columns of h and two rows of the last start's γ₁; the first cell has no number, the last is not computed.
const CHART = {
  x: { name: "h", symbol: "h", low: -1, high: 1, count: 3 }, y: { name: "starts:1", symbol: "γ₁", low: 0, high: 0.25, count: 2 },
  symbol: "λ", units: "1/T", names: [], state: "scene=a&h=7&starts=0.5,0.5;1,1", turn: 0,
  values: Float64Array.of(NaN, 0.5, 1.25, -2, 3, NaN), status: Uint8Array.of(12, 1, 1, 2, 1, 0),
}

test("a cell stands for the state at its place, ends included", () => {
  assert.deepEqual([placeOf(CHART, [0, 0]), placeOf(CHART, [1, 1]), placeOf(CHART, [2, 1])], [[-1, 0], [0, 0.25], [1, 0.25]])
  const query = new URLSearchParams(stateOf(CHART, [2, 1]))
  assert.deepEqual([query.get("scene"), query.get("h"), query.get("starts")], ["a", "1", "1,0.25"])
  assert.deepEqual([numberIn(query, "h"), numberIn(query, "starts:1")], [1, 0.25])
})

test("a cell is read with its place and its number, or why it has none", () => {
  assert.equal(reading(CHART, [0, 1]), "h = −1, γ₁ = 0.25: λ = −2 1/T")
  assert.equal(reading(CHART, [0, 0], "no crossing"), "h = −1, γ₁ = 0: no crossing")
  assert.equal(reading(CHART, [2, 1]), "h = 1, γ₁ = 0.25: not computed yet")
  assert.deepEqual([[0, 0], [1, 0], [2, 1]].map((cell) => isWithoutNumber(CHART, cell)), [true, false, false])
})

test("a value that stands for a category is read by its name", () => {
  const named = { ...CHART, names: [[-2, "shrinks"], [3, "grows"]] }
  assert.equal(reading(named, [0, 1]), "h = −1, γ₁ = 0.25: shrinks")
  assert.equal(reading(named, [1, 1]), "h = 0, γ₁ = 0.25: grows")
  assert.equal(reading(named, [0, 0], "no crossing"), "h = −1, γ₁ = 0: no crossing")
})

test("categories have colours and marks of their own, and each value takes those of its name", () => {
  const names = [[0, "none"], [1, "fixed"], [4, "chaotic"], [-1, "less"]]
  const categories = categoriesOf({ names })
  for (const key of ["colour", "mark"]) assert.equal(new Set(categories.map((one) => one[key])).size, names.length)
  const { low, high, palette } = categoryColours(categories)
  for (const { value, colour } of categories) {
    assert.equal(palette[Math.floor((value - low) * palette.length / (high - low))], colour)
  }
  // Whole numbers without a name take none of their colours.
  for (const value of [2, 3]) assert.ok(!categories.some(({ colour }) => colour === palette[value + 1]))
})

test("zooming in keeps the share of both sides around a cell, within the chart", () => {
  assert.deepEqual(around(CHART, [1, 0], 0.5), { x: [-0.5, 0.5], y: [0, 0.0625] })
})

test("colours span the numbers, or one turn", () => {
  assert.deepEqual(coloursOf(CHART), { low: -2, high: 3, isBelow: false, isAbove: false })
  assert.deepEqual(coloursOf({ ...CHART, turn: 1 }), { low: -0.5, high: 0.5, isBelow: false, isAbove: false })
  assert.deepEqual(coloursOf({ values: Float64Array.of(NaN), turn: 0 }), { low: 0, high: 1, isBelow: false, isAbove: false })
  const values = Float64Array.from({ length: 1001 }, (_, i) => i)
  assert.deepEqual(coloursOf({ values, turn: 0 }), { low: 10, high: 990, isBelow: true, isAbove: true })
  const { low, high } = coloursOf({ values: Float64Array.of(2, 2), turn: 0 })
  assertClose([low, high], [2 - 2e-6, 2 + 2e-6])
})

test("a cell that is not computed looks like a computed neighbour", () => {
  const side = { count: 25 }
  const [values, status] = [new Float64Array(625).fill(NaN), new Uint8Array(625)]
  assert.ok(filled({ values, status, x: side, y: side }).every(Number.isNaN))
  for (let row = 0; row < 25; row += 2) for (let column = 0; column < 25; column += 2) {
    values[25 * row + column] = row + column
    status[25 * row + column] = 1
  }
  filled({ values, status, x: side, y: side }).forEach((value, i) => {
    assert.ok(Math.abs(value - (Math.floor(i / 25) + i % 25)) <= 2)
  })
})
