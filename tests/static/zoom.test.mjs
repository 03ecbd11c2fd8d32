import "./browser.mjs"

import assert from "node:assert/strict"
import test from "node:test"

import { Source } from "../../static/pictures/sources.js"
import { partOf, zoomed } from "../../static/pictures/zoom.js"

const FRAME = { x0: 100, x1: 300, y0: 0, y1: 200 }

test("a wheel keeps the place under the pointer", () => {
  assert.deepEqual(partOf(FRAME, [[150, 200]], [[150, 200]], 0.5), { x0: 125, x1: 225, y0: 100, y1: 200 })
})

test("two fingers zoom and move, one moves", () => {
  // From 50 pixels apart to 100, and down by 10: what was in the middle stays in the middle of the fingers.
  assert.deepEqual(partOf(FRAME, [[175, 90], [225, 90]], [[150, 100], [250, 100]]), { x0: 150, x1: 250, y0: 40, y1: 140 })
  assert.deepEqual(partOf(FRAME, [[0, 0]], [[20, -10]]), { x0: 80, x1: 280, y0: 10, y1: 210 })
})

test("a zoom of the browser ends with axes that change, that of a computed window does not", () => {
  for (const isComputed of [false, true]) {
    const zoom = new Source()
    assert.deepEqual(zoomed(zoom, [0, 1, 0, 1]), [0, 1, 0, 1])
    zoom.put({ axes: [0, 0.5, 0, 0.5], whole: [0, 1, 0, 1], isComputed })
    assert.deepEqual(zoomed(zoom, [0, 1, 0, 1]), [0, 0.5, 0, 0.5])
    assert.deepEqual(zoomed(zoom, [0, 2, 0, 1]), isComputed ? [0, 0.5, 0, 0.5] : [0, 2, 0, 1])
    assert.deepEqual(zoom.data.axes, isComputed ? [0, 0.5, 0, 0.5] : undefined)
    if (isComputed) assert.deepEqual(zoom.data.whole, [0, 2, 0, 1])
  }
})
