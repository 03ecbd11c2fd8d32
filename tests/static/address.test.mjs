import "./browser.mjs"

import assert from "node:assert/strict"
import test from "node:test"

import { createAddress } from "../../static/page/address.js"

const own = { t: "1.5", large: "", az: "0.6", theme: "" }
const written = []
globalThis.history = {
  replaceState: (_state, _title, url) => {
    location.search = url
    written.push(["replace", url])
  },
  pushState: (_state, _title, url) => written.push(["push", url]),
}
const address = createAddress({ query: () => "scene=a&h=1", own, mark: "?" })

test("the address holds the state, the browser's own keys that are set", () => {
  address.writeNow()
  own.theme = "dark"
  own.large = "omega,circle"
  address.writeNow()
  address.writeNow()
  assert.deepEqual(written.splice(0), [
    ["replace", "?scene=a&h=1&t=1.5&az=0.6"], ["replace", "?scene=a&h=1&t=1.5&large=omega%2Ccircle&az=0.6&theme=dark"],
  ])
})

test("a page in a file has its state after #", () => {
  location.hash = "#scene=a&h=2"
  const inFile = createAddress({ query: () => "scene=a&h=1", own: {}, mark: "#" })
  assert.equal(inFile.read(), "scene=a&h=2")
  inFile.writeNow()
  assert.deepEqual(written.splice(0), [["replace", "#scene=a&h=1"]])
})

test("a new entry leaves the state before in the old one", () => {
  Object.assign(own, { t: "", large: "", az: "", theme: "" })
  address.push("scene=b")
  assert.deepEqual(written.splice(0), [["replace", "?scene=b"], ["push", "?scene=a&h=1"]])
})

test("several writes in quick succession are one", (context) => {
  context.mock.timers.enable({ apis: ["setTimeout"] })
  for (let i = 0; i < 3; i++) address.write()
  assert.equal(written.length, 0)
  context.mock.timers.tick(400)
  assert.deepEqual(written, [["replace", "?scene=a&h=1"]])
})
