import test from "node:test"

import { turnsOf, WHEEL } from "../../static/pictures/body_parts.js"
import { assertClose } from "./close.mjs"

test("the marked spoke touches once in a turn of the wheel, forwards and backwards, and not while it rests", () => {
  const turn = 2 * Math.PI * WHEEL
  assertClose(turnsOf([0.5, 0.75, 1.25, 1.25, 1.5, 0.75].map((way) => way * turn)), [1.5, 4 + 2 / 3])
})
