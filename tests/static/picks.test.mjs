import "./browser.mjs"

import assert from "node:assert/strict"
import test from "node:test"

import { toPixel } from "../../static/pictures/picks.js"

test("a coordinate has the digits that a pixel resolves", () => {
  assert.equal(toPixel(2.20000001234, { start: -1, end: 3 }, 400), 2.2)
  assert.equal(toPixel(0.1021169, { start: 0, end: 1 }, 300), 0.102)
  assert.equal(toPixel(-0.48217e-6, { start: 1e-6, end: -1e-6 }, 500), -0.482e-6)
})

test("the change is at most half a pixel, and large numbers stay", () => {
  for (let i = 0; i < 200; i++) {
    const range = { start: -Math.E * 1.07 ** i, end: Math.PI * 1.07 ** i }
    const pixel = (range.end - range.start) / 350
    const value = range.start + pixel * (i + 0.37)
    assert.ok(Math.abs(toPixel(value, range, 350) - value) <= 0.5001 * pixel)
  }
  assert.equal(toPixel(123456.7, { start: 0, end: 1e9 }, 300), 123456.7)
  assert.equal(toPixel(5, { start: 0, end: 1 }, Infinity), 5)
})
