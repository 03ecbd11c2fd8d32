import "./browser.mjs"

import assert from "node:assert/strict"
import test from "node:test"

import { watch } from "../../static/page/websocket.js"

Object.assign(globalThis, { WebSocket: { OPEN: 1 } })
document.baseURI = "http://localhost/"

/** A watched websocket, and what is said of it. */
function watched(context) {
  context.mock.timers.enable({ apis: ["setInterval", "setTimeout"] })
  document.hidden = false
  const socket = Object.assign(new EventTarget(), { readyState: 1, sent: [], send(message) { this.sent.push(message) } })
  const said = []
  watch(socket, (on) => said.push(on), () => said.push("dead"))
  const pass = async (seconds) => {
    for (let i = 0; i < seconds; i++) {
      context.mock.timers.tick(1000)
      await new Promise(setImmediate)
    }
  }
  return { socket, said, pass, speak: () => socket.dispatchEvent(new Event("message")) }
}

test("a silent server is asked whether it is alive, and named after 8 s until it speaks", async (context) => {
  const { socket, said, pass, speak } = watched(context)
  globalThis.fetch = () => Promise.reject(new Error("no answer"))
  for (let i = 0; i < 5; i++) {
    await pass(4)
    assert.equal(socket.sent.length, i + 1)
    speak()
  }
  assert.deepEqual(said, [])
  await pass(8)
  assert.deepEqual(said, [true])
  // A frozen server answers no new connection either: the page waits.
  await pass(60)
  assert.deepEqual([said, socket.sent.length], [[true], 6])
  speak()
  assert.deepEqual(said, [true, false])
  socket.dispatchEvent(new Event("close"))
  await pass(60)
  assert.equal(said.length, 2)
})

test("a connection is dead when the server answers a new one only", async (context) => {
  const { said, pass } = watched(context)
  globalThis.fetch = () => Promise.resolve({ ok: true })
  await pass(19)
  assert.deepEqual(said, [true])
  await pass(2)
  assert.deepEqual(said, [true, "dead"])
})

test("a hidden page is not watched", async (context) => {
  const { socket, said, pass } = watched(context)
  document.hidden = true
  await pass(60)
  assert.deepEqual([socket.sent, said], [[], []])
})
