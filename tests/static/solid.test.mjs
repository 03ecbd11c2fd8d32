import assert from "node:assert/strict"
import test from "node:test"

import { covers, leaves, outline } from "../../static/pictures/solid.js"
import { cross, dot, unit } from "../../static/pictures/vectors.js"
import { assertClose } from "./close.mjs"

const BODIES = [
  { first: [1, 0, 0], beside: [0, 1, 0], semi: [0.7, 0.5, 0.3], v: [0.2, -0.4, 0.9] },
  { first: [1, 2, -2], beside: [0, 1, 1], semi: [0.2, 0.8, 0.4], v: [-1, 0.3, -0.2] },
  { first: [-3, 1, 0.5], beside: [1, 1, 0], semi: [0.6, 0.11, 0.75], v: [0.5, 0.5, 0.1] },
].map(({ first, beside, semi, v }) => {
  const [a, c] = [unit(first), unit(cross(first, beside))]
  return { axes: [a, cross(c, a), c], semi, v }
})

// x·M y of the ellipsoid's inverse matrix M⁻¹ = Σ semi² axis axisᵀ: its shadow is the upper left block.
const inverse = ({ axes, semi }, i, j) => axes.reduce((sum, axis, k) => sum + semi[k] ** 2 * axis[i] * axis[j], 0)

test("the outline is the shadow of the ellipsoid: an eigenvector, the trace and the extents", () => {
  for (const body of BODIES) {
    const { halves: [long, short], angle, width, height } = outline(body.axes, body.semi)
    const [xx, xy, yy] = [inverse(body, 0, 0), inverse(body, 0, 1), inverse(body, 1, 1)]
    const [c, s] = [Math.cos(angle), Math.sin(angle)]
    assertClose([xx * c + xy * s, xy * c + yy * s], [long * long * c, long * long * s])
    assertClose([long * long + short * short, long * long * short * short], [xx + yy, xx * yy - xy * xy])
    assertClose([width, height], [Math.sqrt(xx), Math.sqrt(yy)])
    assert.ok(long >= short)
    const at = (r) => [r * (0.6 * long * c - 0.8 * short * s), r * (0.6 * long * s + 0.8 * short * c)]
    assert.ok(covers(body.axes, body.semi, ...at(0.999)))
    assert.ok(!covers(body.axes, body.semi, ...at(1.001)))
    assert.ok(covers(body.axes, body.semi, ...at(1.001), 0.05))
  }
})

test("a ray from the middle leaves at the surface, on the side to which the normal points", () => {
  for (const { axes, semi, v } of BODIES) for (const sign of [1, -1]) {
    const along = v.map((x) => sign * x)
    const { at, near } = leaves(axes, semi, along)
    assertClose(axes.reduce((sum, axis, k) => sum + (at * dot(along, axis) / semi[k]) ** 2, 0), 1)
    assert.equal(near, axes.reduce((sum, axis, k) => sum + axis[2] * dot(along, axis) / semi[k] ** 2, 0) >= 0)
  }
})

test("a ball is left towards the eye where the ray goes towards the eye", () => {
  const [ball, radius] = [[[1, 0, 0], [0, 1, 0], [0, 0, 1]], [0.5, 0.5, 0.5]]
  assert.deepEqual([leaves(ball, radius, [0, 0, 2]), leaves(ball, radius, [0, 0, -2])],
    [{ at: 0.25, near: true }, { at: 0.25, near: false }])
})
