import assert from "node:assert/strict"
import test from "node:test"

import { createRecorded, nearestPoint } from "../../static/offline/recorded.js"

const LINES = { names: ["h", "f"], points: [[1, 0.5], [0, 0.5], [2, 0.5], [1, 0], [1, 1]] }

test("a slider takes the nearest computed value, and the others stay where that is possible", () => {
  assert.equal(nearestPoint(LINES, 0, { h: 1.8 }), 2)
  assert.equal(nearestPoint(LINES, 0, { h: 1.4 }), 0)
  // From the line of f to that of h: f goes back.
  assert.equal(nearestPoint(LINES, 4, { h: 0.2 }), 1)
  // Its own value again: nothing moves.
  assert.equal(nearestPoint(LINES, 4, { h: 1.1 }), 4)
  const grid = { names: ["h", "f"], points: [0, 1, 2].flatMap((h) => [0, 1].map((f) => [h, f])) }
  assert.deepEqual(grid.points[nearestPoint(grid, 5, { h: 0.2 })], [0, 1])
})

test("a place in a picture takes the computed state that is nearest in the picture", () => {
  // The range of h in the picture is ten times that of f.
  assert.equal(nearestPoint(LINES, 0, { h: 2, f: 0.1 }, { h: 10, f: 1 }), 3)
  assert.equal(nearestPoint(LINES, 0, { h: 2, f: 0.1 }, { h: 1, f: 10 }), 2)
})

const query = (h, f) => `v=1&scene=hess&h=${h}&f=${f}`
const tree = (h) => ({
  sources: { curve: { x: { at: h, n: 1 } }, ...(h === 2 ? { label: { x: [2] } } : {}) }, ranges: { plane: [0, 10, 0, 1] },
  texts: { notes: "" }, captions: { plane: { title: `h = ${h}` } }, controls: { f: [0.4, -1, 1, 0.01, true] },
})
const recording = {
  families: [
    { ...LINES, scene: "hess", fixed: "b = 1", queries: LINES.points.map(([h, f]) => query(h, f)),
      states: LINES.points.map((_, at) => [0, at]) },
    { scene: "hess", names: [], points: [[]], fixed: "", queries: [query(7, 7)], states: [[1, 0]] },
    // A state of the first line, with a slider of its own.
    { ...LINES, scene: "hess", names: ["b"], points: [[1], [2]], fixed: "", queries: [query(2, 0.5), query(8, 8)],
      states: [[0, 2], [1, 0]] },
  ],
  picks: { hess: { plane: ["h", "f"] } }, sources: { hess: { curve: ["x"], label: ["x"] } },
  steps: { "first/0/false": 0, "first/0/true": 1 },
  scenes: { hess: { name: "hess", controls: [{ name: "f", symbol: "f₀" }] } }, lessons: { first: { name: "first" } },
}
const strip = (number) => Promise.resolve({
  trees: number === 0 ? LINES.points.map(([h]) => tree(h)) : [tree(7)], block: new ArrayBuffer(0),
})
const answers = (first = "") => {
  const answer = createRecorded(recording, strip, first)
  let requested = 0
  return async (what) => (await answer(what && { requested: (requested += 1), held: false, values: {}, scene: null, hidden: null, ...what })).head
}

test("answers are those of a server: state, description once, controls, only the sources that change", async () => {
  const ask = answers()
  const first = await ask(null)
  assert.equal(first.scene.name, "hess")
  const { h, f } = first.state.tree.controls
  assert.deepEqual([h, f].map(([value, low, high, step, idle]) => [value, low, high, Math.round(100 * step), idle]),
    // The state has its own values, and controls without effect.
    [[1, 0, 2, 100, false], [0.4, 0, 1, 50, true]])
  assert.deepEqual(first.state.tree.sources, { curve: { x: { at: 1, n: 1 } }, label: { x: [] } })
  const second = await ask({ values: { h: 1.9 } })
  assert.equal("scene" in second, false)
  assert.equal(second.state.query, query(2, 0.5))
  assert.equal(second.state.answers, 1)
  assert.deepEqual(second.state.tree.ranges, { plane: [0, 10, 0, 1] })
  // What a state does not fill is emptied.
  assert.deepEqual(second.state.tree.sources, { curve: { x: { at: 2, n: 1 } }, label: { x: [2] } })
  assert.deepEqual((await ask({ values: { h: 0 }, held: true })).state.tree.sources.label, { x: [] })
  // Axes stay while a slider is held.
  assert.deepEqual((await ask({ values: { h: 2 }, held: true })).state.tree.ranges, {})
  assert.deepEqual((await ask({})).state.tree.sources, {})
})

test("notes say what the file cannot do", async () => {
  const ask = answers(query(0, 0.5))
  assert.equal((await ask(null)).state.query, query(0, 0.5))
  assert.match((await ask({ values: { f: 1 } })).state.tree.texts.notes, /^h is 1 again: this file moves one slider/)
  assert.match((await ask({ values: { h: 2 } })).state.tree.texts.notes, /^f₀ is 0\.5 again/)
  assert.equal((await ask({ values: { x: 2 } })).state.tree.texts.notes, "")
  const picked = await ask({ picked: ["plane", 2, 0.9] })
  assert.equal(picked.state.query, query(1, 1))
  assert.match(picked.state.tree.texts.notes, /nearest/)
  assert.equal((await ask({ picked: ["sphere", 0, 0] })).state.query, query(1, 1))
  assert.match((await ask({ expressions: { h: "pi/3" } })).state.tree.texts["error-h"], /plain number/)
  assert.equal("error-h" in (await ask({})).state.tree.texts, false)
  assert.match((await ask({ restore: "v=1&scene=hess&h=5&f=5" })).state.tree.texts.notes, /does not contain/)
  // Undo, a link with further keys, steps, reset.
  assert.equal((await ask({ restore: query(0, 0.5) })).state.query, query(0, 0.5))
  assert.equal((await ask({ restore: `${query(1, 0)}&t=3&theme=dark` })).state.query, query(1, 0))
  assert.equal((await ask({ step: ["first", 0, false] })).state.query, query(1, 0.5))
  assert.equal((await ask({ step: ["first", 0, true] })).state.query, query(7, 7))
  // A state of two families: from elsewhere the one that begins with it, otherwise the one on show.
  assert.deepEqual(Object.keys((await ask({ restore: query(2, 0.5) })).state.tree.controls), ["b"])
  await ask({ step: ["first", 0, false] })
  assert.deepEqual(Object.keys((await ask({ restore: query(2, 0.5) })).state.tree.controls), ["h", "f"])
  assert.match((await ask({ step: ["first", 1, true] })).state.tree.texts.notes, /does not contain/)
  assert.equal((await ask({ lesson: "first" })).lesson.name, "first")
  assert.equal((await ask({ reset: true })).state.query, query(1, 0.5))
})
