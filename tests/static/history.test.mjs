import "./browser.mjs"

import assert from "node:assert/strict"
import test from "node:test"

import { listen, tell } from "../../static/base/bus.js"
import { createHistory } from "../../static/page/history.js"
import { Element, point } from "./browser.mjs"

// A page whose states are painted at once, and its history.
let query = "scene=a&h=0"
let steps = null
const entries = []
const address = { push: (before) => entries.push(before), read: () => location.search.slice(1) }
const history = createHistory({ query: () => query, isSettled: () => true, address })

function paint(next) {
  query = next
  history.settle()
}
listen({ steps(counts) { steps = counts }, restore: paint })

function change(next, event = "change") {
  tell(event, {})
  paint(next)
}

test("undo and redo go through all states, and a change ends redo", () => {
  paint(query)
  assert.deepEqual(steps, { undo: 0, redo: 0 })
  for (const h of [1, 2, 3]) change(`scene=a&h=${h}`)
  assert.deepEqual(steps, { undo: 3, redo: 0 })
  const seen = ["undo", "undo", "redo", "undo", "undo"].map((event) => {
    tell(event)
    return query.at(-1)
  })
  assert.deepEqual(seen, ["2", "1", "2", "1", "0"])
  assert.deepEqual(steps, { undo: 0, redo: 3 })
  tell("undo")
  assert.equal(query, "scene=a&h=0")
  change("scene=a&h=9")
  assert.deepEqual(steps, { undo: 1, redo: 0 })
})

test("all changes while a pointer holds are one step", () => {
  const { undo } = steps
  const before = query
  point("pointerdown", new Element())
  for (const h of [4, 5, 6]) change(`scene=a&h=${h}${undo}`)
  assert.equal(steps.undo, undo)
  point("pointerup", new Element())
  assert.equal(steps.undo, undo + 1)
  tell("undo")
  assert.equal(query, before)
})

test("only a scene or an example gets an entry of the browser, with the state before it", () => {
  entries.length = 0
  const before = query
  change("scene=a&h=7")
  assert.deepEqual(entries, [])
  change("scene=a&h=8", "preset")
  change("scene=b&h=8", "scene")
  assert.deepEqual(entries, ["scene=a&h=7", "scene=a&h=8"])
  location.search = `?${before}`
  window.dispatchEvent(new Event("popstate"))
  assert.equal(query, before)
  assert.equal(entries.length, 2)
})

test("another history goes on with the steps of this one, and with a change that has no answer yet", () => {
  const before = { ...steps }
  const kept = JSON.parse(JSON.stringify(history.steps))
  assert.equal(kept.current, query)
  let shown = kept.current
  let isSettled = false
  let counts = null
  const restored = []
  const again = createHistory({ query: () => shown, isSettled: () => isSettled, address }, kept)
  // The state of the link is on show, the change is not.
  again.settle()
  shown = "scene=a&h=77"
  isSettled = true
  listen({ steps(told) { counts = told }, restore(step) { restored.push(step) } })
  again.settle()
  assert.deepEqual(counts, { undo: before.undo + 1, redo: 0 })
  assert.deepEqual(again.steps.past, [...kept.past, kept.current])
})
