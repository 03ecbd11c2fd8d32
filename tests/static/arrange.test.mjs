import assert from "node:assert/strict"
import test from "node:test"

import { arrange, onPhone } from "../../static/pictures/arrange.js"

const [GAP, HEAD, TITLE, LEAST, NAMES] = [8, 20, 20, 150, 32]
const viewport = (width, height) => ({ width, height, gap: GAP, head: HEAD, title: TITLE, least: LEAST, names: NAMES })
const PLACES = [[1331, 820], [1025, 606], [2500, 2010], [1900, 600], [600, 1400], [1060, 820]]
const COUNTS = [[1, 0], [1, 1], [1, 3], [1, 5], [2, 2], [3, 3], [4, 2], [4, 0]]

// Pictures with their captions, and the names, as [left, top, right, bottom].
const framesOf = ({ boxes, names }, hasNames) => [
  ...boxes.map(({ x, y, edge, caption }) => [x, y, x + edge, y + caption + edge]),
  ...hasNames ? [[names.x, names.y, names.x + names.width, names.y + names.height]] : [],
]

function assertInsideAndApart(frames, width, height) {
  for (const [left, top, right, bottom] of frames) {
    assert.ok(left >= -0.5 && left < right && right <= width + 0.5)
    assert.ok(top >= -0.5 && top < bottom && bottom <= height + 0.5)
  }
  frames.forEach((one, i) => frames.slice(i + 1).forEach((other) => {
    assert.ok([0, 1].some((k) => one[k + 2] <= other[k] + 0.5 || other[k + 2] <= one[k] + 0.5), `${one} / ${other}`)
  }))
}

test("all pictures and names fit, the leading ones are equal and no smaller than those of the strip", () => {
  for (const [width, height] of PLACES) for (const [leading, rest] of COUNTS) for (const names of [0, 2, 4]) {
    const found = arrange(viewport(width, height), leading, rest, names)
    assert.equal(found.boxes.length, leading + rest)
    assertInsideAndApart(framesOf(found, names > 0), width, height)
    const [leads, strip] = [found.boxes.slice(0, leading), found.boxes.slice(leading)]
    assert.ok(leads.every(({ edge, aside }) => edge === leads[0].edge && !aside))
    assert.ok(strip.every(({ edge, aside }) => edge <= leads[0].edge && aside))
  }
})

test("a single lead takes 70 % of the height, and the pictures beside it can be read", () => {
  for (const [width, height] of PLACES.slice(0, 4)) for (const rest of [1, 3, 5]) {
    const { boxes: [lead, ...strip] } = arrange(viewport(width, height), 1, rest, 2)
    assert.ok(lead.edge >= 0.7 * height, `${width} ${height} ${rest}`)
    assert.ok(strip.every(({ edge }) => edge >= LEAST), `${width} ${height} ${rest}`)
  }
})

test("what leads alone stands in the middle", () => {
  for (const [width, height] of PLACES) for (const leading of [1, 3]) {
    const lefts = arrange(viewport(width, height), leading, 0).boxes.map(({ x }) => x)
    const rights = arrange(viewport(width, height), leading, 0).boxes.map(({ x, edge }) => width - x - edge)
    assert.ok(Math.abs(Math.min(...lefts) - Math.min(...rights)) <= 1)
  }
})

test("in a viewport that is too small for that, the pictures of the strip are as large as they can be", () => {
  const { boxes: [, ...strip] } = arrange(viewport(500, 330), 1, 3, 0)
  assert.ok(strip.every(({ edge }) => edge > 70 && edge < LEAST))
})

test("on a phone one picture is as wide as the screen, beside the names is a small one", () => {
  for (const count of [0, 1]) {
    const found = onPhone({ ...viewport(390, 523), least: 118 }, count, 4)
    assertInsideAndApart(framesOf(found, true), 390, 523)
    assert.ok(found.boxes[0].edge > 0.9 * 390)
    assert.equal(found.boxes.length, 1 + count)
  }
  // Without either it has all of the height.
  assert.equal(onPhone({ ...viewport(390, 323), least: 118 }, 0, 0).boxes[0].edge, 323 - viewport(0, 0).head)
})
