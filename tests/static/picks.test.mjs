import "./browser.mjs"

import assert from "node:assert/strict"
import test from "node:test"

import { toPixel } from "../../static/pictures/picks.js"

const LINEAR = { type: "LinearScale" }

test("a coordinate has the digits that a pixel resolves", () => {
  assert.equal(toPixel(2.20000001234, { start: -1, end: 3 }, 400, LINEAR), 2.2)
  assert.equal(toPixel(0.1021169, { start: 0, end: 1 }, 300, LINEAR), 0.102)
  assert.equal(toPixel(-0.48217e-6, { start: 1e-6, end: -1e-6 }, 500, LINEAR), -0.482e-6)
})

test("the change is at most half a pixel, and large numbers stay", () => {
  for (let i = 0; i < 200; i++) {
    const range = { start: -Math.E * 1.07 ** i, end: Math.PI * 1.07 ** i }
    const pixel = (range.end - range.start) / 350
    const value = range.start + pixel * (i + 0.37)
    assert.ok(Math.abs(toPixel(value, range, 350, LINEAR) - value) <= 0.5001 * pixel)
  }
  assert.equal(toPixel(123456.7, { start: 0, end: 1e9 }, 300, LINEAR), 123456.7)
  assert.equal(toPixel(5, { start: 0, end: 1 }, Infinity, LINEAR), 5)
})

test("on a logarithmic axis a pixel is a factor", () => {
  const range = { start: 1e-15, end: 1 }
  const factor = 1e15 ** (1 / 300)
  for (const value of [1.2345678e-14, 7.7777777e-3, 0.54321]) {
    const rounded = toPixel(value, range, 300, { type: "LogScale" })
    assert.ok(rounded !== value && rounded / value < factor && value / rounded < factor)
  }
})
