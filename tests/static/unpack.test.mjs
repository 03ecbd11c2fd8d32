import assert from "node:assert/strict"
import test from "node:test"

import { unpack } from "../../static/base/unpack.js"

test("arrays are views of the block, grids keep their shape, and plain values stay", () => {
  const block = Float32Array.from([0, 1, 2, 3, 4, 5, 6, 7, 8]).buffer
  const [[name, columns], [other, { label }]] = unpack({
    curve: {
      x: { at: 1, n: 2 }, xs: [{ at: 3, n: 1 }, { at: 4, n: 0 }], grid: [{ at: 3, n: 6, shape: [2, 3] }], axis: [0.1, 0, null],
    },
    words: { label: "γ₁" },
  }, block)
  assert.deepEqual([name, other, label], ["curve", "words", "γ₁"])
  assert.deepEqual(columns, {
    x: Float32Array.of(1, 2), xs: [Float32Array.of(3), Float32Array.of()],
    grid: [{ rows: 2, columns: 3, numbers: Float32Array.of(3, 4, 5, 6, 7, 8) }], axis: [0.1, 0, null],
  })
  assert.equal(columns.x.buffer, block)
})
