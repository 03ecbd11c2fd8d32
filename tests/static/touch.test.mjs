import "./browser.mjs"

import assert from "node:assert/strict"
import test from "node:test"

import { onDrag } from "../../static/base/drag.js"
import { isNear } from "../../static/pictures/touch.js"
import { Element } from "./browser.mjs"

test("a finger is near a handle that it covers", () => {
  assert.ok(isNear([10, 10], [[300, 0], [28, 34]]))
  assert.ok(!isNear([10, 10], [[34, 34]]))
  assert.ok(!isNear([10, 10], []))
})

test("the first pointer drags; a second one and a cancelled pointer end the drag without an event", () => {
  const handle = Object.assign(new Element(), { setPointerCapture() {} })
  const said = []
  onDrag(handle, ({ pointerId }) => [pointerId], ([id], { x }) => said.push([id, x]), ([id], event) => said.push([id, event]))
  const send = (type, pointerId, x) => handle.dispatchEvent(Object.assign(new Event(type), { pointerId, x }))
  send("pointerdown", 1)
  send("pointermove", 1, 5)
  send("pointermove", 2, 9)
  send("pointerdown", 2)
  send("pointermove", 1, 6)
  send("pointerup", 2)
  send("pointerdown", 3)
  send("pointermove", 3, 7)
  send("pointercancel", 3)
  send("pointermove", 3, 8)
  assert.deepEqual(said, [[1, 5], [1, null], [3, 7], [3, null]])
})
