import test from "node:test"

import { drawWheel, turnsOf, WHEEL } from "../../static/pictures/body_parts.js"
import { assertClose } from "./close.mjs"

test("the marked spoke touches once in a turn of the wheel, forwards and backwards, and not while it rests", () => {
  const turn = 2 * Math.PI * WHEEL
  assertClose(turnsOf([0.5, 0.75, 1.25, 1.25, 1.5, 0.75].map((way) => way * turn)), [1.5, 4 + 2 / 3])
})

test("the point of a wheel that touches the sphere rests: in the body it goes as far as the contact, backwards", () => {
  const ctx = new Proxy({}, { get: (_, name) => (name === "lineTo" ? (...place) => { drawn = place } : () => {}), set: () => true })
  let [drawn, colour] = [null, null]
  /** Return the end of the coloured spoke. */
  const markedAt = (way) => {
    let end = null
    const sheet = {
      ctx: new Proxy(ctx, { get: (_, name) => (name === "stroke" ? () => { if (colour === "red") end = drawn } : ctx[name]) }),
      text: "black", dark: false, depth: (x, y, z) => z, at: (place) => place, use: (look) => { colour = look.colour },
    }
    drawWheel(sheet, [1, 0, 0], [0, 1, 0], way, { colour: "red", weight: 1 })
    return end
  }
  const small = 1e-4
  const [before, after] = [markedAt(-small), markedAt(small)]
  assertClose(after.map((x, k) => (x - before[k]) / (2 * small)), [0, -0.92, 0], 1e-3)
})
