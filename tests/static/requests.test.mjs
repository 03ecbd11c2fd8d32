import "./browser.mjs"

import assert from "node:assert/strict"
import test from "node:test"

import { listen, tell } from "../../static/base/bus.js"
import { createRequests } from "../../static/page/requests.js"
import { Element, point } from "./browser.mjs"

const sent = []
const requests = createRequests({
  send: (message) => sent.push(message), changed() {}, hidden: () => ["circle"], known: (scene) => scene === "a",
})
const microtasks = () => new Promise(setImmediate)

// The answer to the last request is painted; return the request that follows, if any.
async function settled() {
  requests.settled()
  requests.ask()
  await microtasks()
  return sent.pop()
}

async function told(...events) {
  sent.length = 0
  for (const [name, detail] of events) tell(name, detail)
  await microtasks()
  return sent
}

/** A queue of its own, which hears the same events. */
function queue() {
  const messages = []
  const one = createRequests({ send: (message) => messages.push(message), changed() {}, hidden: () => [], known: () => true })
  return { one, messages }
}
const plain = (value) => JSON.parse(JSON.stringify(value))

test("nothing is asked before a scene is on show", async () => {
  assert.deepEqual(await told(["change", { h: 1 }]), [])
  requests.entered("a")
  const [first] = await told(["change", { f: 2 }])
  assert.deepEqual([first.values, first.scene, first.hidden, first.held], [{ h: 1, f: 2 }, null, ["circle"], false])
  requests.settled()
})

test("one request at a time, and the newest values win", async () => {
  const [first] = await told(["change", { h: 1 }])
  assert.deepEqual(first.values, { h: 1 })
  const later = [2, 3, 4].map((h) => ["change", { h }])
  assert.deepEqual(await told(...later, ["expression", { f: "pi/3" }], ["change", { f: 5 }]), [])
  assert.ok(requests.isBehind(first.requested))
  assert.ok(requests.hasMoved("h", first.requested))
  const next = await settled()
  assert.deepEqual([next.values, next.expressions], [{ h: 4, f: 5 }, {}])
  assert.ok(!requests.isBehind(next.requested))
  assert.ok(!requests.hasMoved("h", next.requested))
  requests.settled()
})

test("a lesson that is chosen during a request is asked for after it", async () => {
  const [first] = await told(["change", { h: 1 }])
  assert.deepEqual(await told(["lesson", "cycles"]), [])
  assert.ok(requests.isBehind(first.requested))
  assert.equal((await settled()).lesson, "cycles")
  requests.settled()
})

test("an example discards the changes before it and keeps those after it", async () => {
  const [message] = await told(["change", { h: 1 }], ["preset", "No cycle"], ["change", { f: 2 }])
  assert.deepEqual([message.preset, message.values], ["No cycle", { f: 2 }])
  requests.settled()
})

test("a slider is held until it is let go, which is a request of its own", async () => {
  point("pointerdown", new Element(".hand"))
  assert.equal((await told(["change", { h: 1 }]))[0].held, true)
  requests.settled()
  sent.length = 0
  point("pointerup", new Element(".hand"))
  await microtasks()
  assert.equal(sent.length, 1)
  assert.equal(sent[0].held, false)
  requests.settled()
})

test("the scene that was chosen last is entered, with no picture hidden", async () => {
  const [message] = await told(["scene", "b"], ["scene", "c"])
  assert.deepEqual([message.scene, message.hidden], ["c", null])
  requests.settled()
  assert.deepEqual(await told(["scene", "c"]), [])
  requests.entered("c")
  assert.deepEqual((await told(["near", "a"], ["near", "d"])).map(({ near }) => near), ["d"])
  requests.settled()
})

test("a place that is no number chooses nothing, and a finger does not hover", async () => {
  assert.deepEqual(await told(["pick", { pick: ["omega", NaN, 1], drag: false }]), [])
  point("pointerdown", new Element(), "touch")
  assert.deepEqual(await told(["hover", ["omega", 0, 1]]), [])
  assert.deepEqual((await told(["pick", { pick: ["omega", 0, 1], drag: false }]))[0].picked, ["omega", 0, 1])
  requests.settled()
})

test("changes without an answer are those of the last request and those since", async () => {
  const { one, messages } = queue()
  one.begin(null)
  one.entered("a")
  assert.deepEqual(plain(one.unanswered), { values: {}, expressions: {}, scene: null })
  await told(["change", { h: 1, f: 2 }], ["expression", { k: "pi" }], ["hover", ["omega", 0, 1]])
  assert.equal(messages.length, 1)
  await told(["change", { h: 3, k: 4 }], ["scene", "b"])
  assert.deepEqual(plain(one.unanswered), { values: { h: 3, f: 2, k: 4 }, expressions: {}, scene: "b" })
  await told(["expression", { h: "1/2" }])
  assert.deepEqual(plain(one.unanswered).expressions, { h: "1/2" })
  // An example replaces what was set before, but not the scene.
  await told(["preset", "No cycle"], ["change", { f: 5 }])
  assert.deepEqual(plain(one.unanswered), { values: { f: 5 }, expressions: {}, preset: "No cycle", scene: "b" })
  // Also when the connection is lost, and then for changes that nobody is asked for.
  one.lose()
  await told(["change", { f: 6 }])
  assert.deepEqual(plain(one.unanswered).values, { f: 6 })
  requests.settled()
  requests.entered("b")
})

test("a page that is loaded again asks for them once, after its first state", async () => {
  const { one, messages } = queue()
  one.begin({ values: { h: 3 }, expressions: {}, scene: "c" })
  await microtasks()
  assert.deepEqual(messages, [])
  assert.ok(one.isBehind(0))
  assert.deepEqual(plain(one.unanswered), { values: { h: 3 }, expressions: {}, scene: "c" })
  one.entered("b")
  one.settled()
  one.ask()
  await microtasks()
  const [{ requested, values, scene }] = messages
  assert.deepEqual([requested, values, scene], [1, { h: 3 }, "c"])
  assert.deepEqual(plain(one.unanswered), { values: {}, expressions: {}, scene: null })
  await told(["change", { h: 4 }])
  assert.deepEqual(plain(one.unanswered).values, { h: 4 })
  one.lose()
  requests.settled()
})

test("a server that does not respond is not said to compute", async (context) => {
  context.mock.timers.enable({ apis: ["setTimeout"] })
  // It would say that it computes.
  requests.lose()
  const { one } = queue()
  const said = []
  listen({ texts: ({ busy }) => said.push(busy) })
  one.entered("b")
  one.silence(true)
  assert.match(said.at(-1), /^The server does not respond\./)
  tell("change", { h: 5 })
  await Promise.resolve()
  context.mock.timers.tick(10_000)
  assert.equal(said.length, 1)
  one.silence(false)
  assert.equal(said.at(-1), "")
  context.mock.timers.tick(400)
  assert.equal(said.at(-1), "Computing…")
  one.lose()
})
