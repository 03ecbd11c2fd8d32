import "./browser.mjs"

import assert from "node:assert/strict"
import test from "node:test"

import { inWords, meanApart, nearest } from "../../static/pictures/guess.js"

const plot = (x, y) => ({ model: {
  x_scale: { type: x }, y_scale: { type: y }, below: [{ axis_label: "h" }], left: [{ axis_label: "λ" }],
} })

test("the nearest point of several curves may lie between two samples, or at an end", () => {
  const lines = [[[0, 0], [4, 0]], [[0, 3], [4, 3], [4, 9]]]
  assert.deepEqual(nearest(lines, [1, 1]), { distance: 1, at: [1, 0] })
  assert.deepEqual(nearest(lines, [-3, 7]), { distance: 5, at: [0, 3] })
  assert.deepEqual(nearest([[[2, 2]], [[9, 9]]], [2, 4]), { distance: 2, at: [2, 2] })
})

test("distances are means along each axis, on a logarithmic one means of ratios", () => {
  const pairs = [[[1, 10], [3, 1000]], [[5, 100], [4, 100]]]
  const linear = plot("LinearScale", "LinearScale")
  assert.deepEqual(meanApart(linear, pairs), [1.5, 495])
  assert.equal(inWords(linear, [1.5, 495]), "1.5 in h and 500 in λ")
  const logarithmic = plot("LinearScale", "LogScale")
  const [across, up] = meanApart(logarithmic, pairs)
  assert.equal(across, 1.5)
  assert.ok(Math.abs(up - Math.log(10)) < 1e-12)
  assert.equal(inWords(logarithmic, [1.5, Math.log(10)]), "1.5 in h and a factor of 10 in λ")
})
