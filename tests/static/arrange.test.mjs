import assert from "node:assert/strict"
import test from "node:test"

import { arrange, spareWidth } from "../../static/pictures/arrange.js"

const GAP = 8
const CAPTION = 38
const PLACES = [[964, 620], [936, 850], [2500, 2010], [1900, 500], [500, 1400], [700, 700]]

const placeOf = (width, height, count) => (
  { width, height, count, gap: GAP, share: 0.82, caption: CAPTION, title: 20, wide: 400 })
const arranged = (width, height, count, large = []) => arrange(placeOf(width, height, count), large)

function assertInsideAndApart(boxes, width, height) {
  const cells = boxes.map(({ x, y, width: wide, caption, edge }) => [x, y, x + wide, y + caption + edge])
  for (const [left, top, right, bottom] of cells) {
    assert.ok(left >= -0.5 && left < right && right <= width + 0.5)
    assert.ok(top >= -0.5 && top < bottom && bottom <= height + 0.5)
  }
  cells.forEach((one, i) => cells.slice(i + 1).forEach((other) => {
    assert.ok([0, 1].some((k) => one[k + 2] <= other[k] + 0.5 || other[k + 2] <= one[k] + 0.5))
  }))
}

// The largest edge of equal squares with captions, over all numbers of columns.
function largestEdge(width, height, count) {
  return Math.max(...Array.from({ length: count }, (_, i) => i + 1).map((columns) => {
    const rows = Math.ceil(count / columns)
    return Math.min((width - GAP * (columns - 1)) / columns, (height - GAP * (rows - 1)) / rows - CAPTION)
  }))
}

test("the smallest picture is as large as a grid allows, and all pictures fit", () => {
  for (const [width, height] of PLACES) for (const count of [1, 2, 3, 4, 5]) {
    const boxes = arranged(width, height, count)
    assert.equal(boxes.length, count)
    assertInsideAndApart(boxes, width, height)
    assert.ok(Math.min(...boxes.map(({ edge }) => edge)) >= largestEdge(width, height, count) - 1)
    assert.ok(boxes.every(({ aside }) => !aside))
  }
})

test("an enlarged picture takes its share of the height, and the others share the rest", () => {
  for (const [width, height] of PLACES.slice(0, 4)) for (const count of [2, 3, 4, 5]) for (const large of [[0], [1], [1, 0]]) {
    const boxes = arranged(width, height, count, large)
    assertInsideAndApart(boxes, width, height)
    const chosen = large.map((i) => boxes[i].edge)
    const others = boxes.filter((_, i) => !large.includes(i))
    const edges = others.map(({ edge }) => edge)
    assert.ok(Math.min(...chosen) >= Math.max(0, ...edges))
    assert.ok(Math.min(height, ...edges) > 0.05 * height)
    if (large.length > 1) continue
    assert.ok(chosen[0] >= 0.8 * Math.min(height, width / 1.3))
    assert.ok(others.every(({ aside }) => aside))
  }
})

test("the first of three pictures is larger where that costs the others nothing", () => {
  const [first, second, third] = arranged(936, 850, 3)
  assert.ok(first.edge > second.edge)
  assert.equal(second.edge, third.edge)
  assert.ok(second.edge >= largestEdge(936, 850, 3) - 1)
})

test("the text takes all width that no picture needs, and no more than allowed", () => {
  for (const [width, height] of PLACES) for (const count of [0, 1, 2, 3, 4, 5]) {
    const edges = (given) => arranged(given, height, count).map(({ edge }) => edge)
    const spare = spareWidth(placeOf(width, height, count), 300)
    assert.ok(spare >= 0 && spare <= 300)
    assert.ok(Math.min(...edges(width - spare)) >= Math.min(...edges(width)))
    if (count > 0 && spare < 288) assert.notDeepEqual(edges(width - spare - 14), edges(width))
  }
  // Two rows of two squares below captions are 930 high, hence 930 - 2 * 38 wide.
  const spare = 1100 - (930 - 2 * CAPTION)
  assert.ok(Math.abs(spareWidth(placeOf(1100, 930, 4), 300) - spare) <= 14)
})

test("no pictures, no boxes", () => assert.deepEqual(arranged(900, 600, 0), []))

test("small pictures beside large ones are no smaller than a thumbnail", () => {
  for (const [width, height] of PLACES.slice(0, 4)) for (const count of [3, 4, 5, 6]) for (const large of [[0], [0, 1], [0, 1, 2]]) {
    if (large.length === count) continue
    const edges = arranged(width, height, count, large).map(({ edge }) => edge)
    assert.ok(Math.min(...edges) >= 0.085 * height, `${width} ${height} ${count} ${edges}`)
  }
})
