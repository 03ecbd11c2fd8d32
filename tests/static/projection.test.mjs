import assert from "node:assert/strict"
import test from "node:test"

import { createSheet, RADIUS } from "../../static/pictures/projection.js"
import { circle, cross, dot, graticule, plus, scaled, unit } from "../../static/pictures/vectors.js"
import { assertClose } from "./close.mjs"

const EDGE = 200
const TURNS = [[0, 0], [0.6, 0.35], [-2.5, -1.2], [3, 1.5]]

// Seen from the direction (azimuth, elevation): unit vectors to the right, upwards and towards the eye.
function frameOf([azimuth, elevation]) {
  const eye = [Math.cos(elevation) * Math.cos(azimuth), Math.cos(elevation) * Math.sin(azimuth), Math.sin(elevation)]
  const right = unit(cross([0, 0, 1], eye))
  return [right, cross(eye, right), eye]
}

test("points are projected along the direction of the eye, with γ₃ upwards", () => {
  const point = [0.3, -0.5, 0.7]
  for (const turn of TURNS) {
    const { at, view, depth, isNear, half, scale } = createSheet({}, { edge: EDGE, ratio: 1, text: "", dark: false }, turn)
    assert.equal(scale, 0.5 * EDGE * RADIUS)
    const seen = frameOf(turn).map((axis) => dot(axis, point))
    assertClose(view(point), seen)
    assertClose(at(point), [half + scale * seen[0], half - scale * seen[1]], 1e-9)
    assertClose(depth(...point), seen[2])
    assert.equal(isNear(point), seen[2] >= 0)
    assertClose(at(frameOf(turn)[2]), [half, half], 1e-9)
  }
})

test("a curve is stroked where it lies on the wanted side", () => {
  const pieces = []
  const ctx = { beginPath() {}, moveTo: () => pieces.push(1), lineTo: () => { pieces[pieces.length - 1] += 1 }, stroke() {} }
  const { stroke } = createSheet(ctx, { edge: EDGE, ratio: 1, text: "", dark: false }, [0, 0])
  // The eye is at γ₁ = 1: a quarter turn from there, half of the equator is far.
  stroke(circle([0, 0, 1], 0, 8), true)
  stroke(circle([0, 0, 1], 0, 8), false)
  assert.equal(pieces.reduce((sum, points) => sum + points - 1, 0), 8)
})

test("labels stay in the picture and apart from each other", () => {
  const written = []
  const ctx = { measureText: (text) => ({ width: 8 * text.length }), fillText: (text, x, y) => written.push([x, y, 4 * text.length]) }
  const { write } = createSheet(ctx, { edge: EDGE, ratio: 1, text: "", dark: false }, [0, 0])
  for (const label of ["γ₁", "ξ", "e"]) write(label, 100, 100)
  write("pole", 199, -5)
  assert.deepEqual(written[0].slice(0, 2), [100, 100])
  for (const [x, y, half] of written) assert.ok(x >= half && x <= EDGE - half && y >= 8 && y <= EDGE - 8)
  written.forEach(([x, y, half], i) => written.slice(i + 1).forEach(([x1, y1, half1]) => {
    assert.ok(Math.abs(x - x1) >= half + half1 || Math.abs(y - y1) >= 16)
  }))
})

test("vectors add, scale and multiply", () => {
  const [u, v] = [[1, 2, -2], [0, 3, 4]]
  assert.deepEqual([dot(u, v), cross(u, v), scaled(u, -2), plus(u, v), plus(u, v, 2)],
    [-2, [14, -4, 3], [-2, -4, 4], [1, 5, 2], [1, 8, 6]])
  assertClose(unit(u), [1 / 3, 2 / 3, -2 / 3])
})

test("a circle lies on the sphere at its height, and so do parallels and meridians", () => {
  for (const axis of [[0, 0, 1], [1, 0, 0], unit([1, 2, -2])]) {
    const [xs, ys, zs] = circle(axis, 0.6, 12)
    assert.equal(xs.length, 13)
    xs.forEach((x, i) => assertClose([Math.hypot(x, ys[i], zs[i]), dot(axis, [x, ys[i], zs[i]])], [1, 0.6]))
  }
  const lines = graticule()
  assert.equal(lines.length, 9)
  lines.slice(0, 3).forEach(([, , zs], i) => assertClose(zs, zs.map(() => [-0.5, 0, 0.5][i])))
  for (const [, , zs] of lines.slice(3)) assertClose([Math.min(...zs), Math.max(...zs)], [-1, 1])
})
