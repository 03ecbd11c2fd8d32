import assert from "node:assert/strict"
import test from "node:test"

import { listen, tell } from "../../static/base/bus.js"

test("every listener of an event hears its detail, in order, and no other event", () => {
  const heard = []
  listen({ first: (detail) => heard.push(["a", detail]), second: () => heard.push("never") })
  listen({ first: (detail) => heard.push(["b", detail]) })
  const detail = { t: 1 }
  tell("first", detail)
  assert.deepEqual(heard, [["a", detail], ["b", detail]])
  assert.equal(heard[0][1], detail)
})
