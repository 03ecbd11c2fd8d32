import assert from "node:assert/strict"
import test from "node:test"

import "./browser.mjs"
import { assertClose } from "./close.mjs"

/** The pixels that were painted last. */
let painted = null
document.createElement = () => ({
  classList: { add() {} }, style: {}, dataset: {}, append() {},
  getContext: () => ({
    createImageData: (width, height) => ({ data: new Uint8ClampedArray(4 * width * height) }),
    putImageData(image) { painted = image.data },
  }),
})
const { createRevolved, outline } = await import("../../static/pictures/revolved.js")

// A torus with round cross-sections.
const [FAR, THICK, N] = [0.6, 0.25, 64]
const angles = Array.from({ length: N + 1 }, (_, i) => 2 * Math.PI * (i % N) / N)
const radius = angles.map((one) => FAR - THICK * Math.cos(one))
const height = angles.map((one) => THICK * Math.sin(one))
const SHEET = { edge: 200, ratio: 1, scale: 84, dark: false }

/** Return a point of the torus in the view, see "projection.js". */
function seen([x, y, z], [azimuth, elevation]) {
  const [ca, sa, ce, se] = [Math.cos(azimuth), Math.sin(azimuth), Math.cos(elevation), Math.sin(elevation)]
  return [100 + 84 * (ca * y - sa * x), 100 - 84 * (ce * z - se * (ca * x + sa * y)), ce * (ca * x + sa * y) + se * z]
}

test("along the outline the line of sight touches the surface", () => {
  for (const [azimuth, elevation] of [[0.6, 0.35], [-2, -1.1], [1, 0.9]]) {
    const towards = [Math.cos(elevation) * Math.cos(azimuth), Math.cos(elevation) * Math.sin(azimuth), Math.sin(elevation)]
    const segments = outline(radius, height, azimuth, elevation)
    assert.ok(segments.length >= 180)
    for (const [X, Y, Z] of segments) {
      assert.ok(Math.hypot(X[1] - X[0], Y[1] - Y[0], Z[1] - Z[0]) < 0.2)
      const across = 1 - FAR / Math.hypot(X[1], Y[1])
      const normal = [X[1] * across, Y[1] * across, Z[1]]
      assertClose([Math.hypot(...normal), normal.reduce((sum, x, k) => sum + x * towards[k], 0) / THICK], [THICK, 0], 0.01)
    }
  }
})

test("no line of sight is painted twice, or not, where facets meet", () => {
  createRevolved().shade(SHEET, radius, height, [0.3, Math.PI / 2], null)
  // Along each row opacity changes smoothly, but at the edges.
  let inside = 0
  for (let at = 1; at < 200 * 200 - 1; at++) {
    const distance = Math.hypot(at % 200 - 99.5, Math.floor(at / 200) - 99.5) / 84
    const [before, alpha, after] = [-1, 0, 1].map((step) => painted[4 * (at + step) + 3])
    if (Math.abs(distance - FAR) > THICK + 0.02) assert.equal(alpha, 0)
    if (Math.abs(distance - FAR) > THICK - 0.06) continue
    inside++
    assert.ok(alpha > 100 && Math.abs(before - 2 * alpha + after) < 12)
  }
  assert.ok(inside > 5000)
})

test("it hides its own back, and shows what is before it", () => {
  const surface = createRevolved()
  for (const turn of [[0.6, 0.35], [-2, -1.1]]) {
    surface.shade(SHEET, radius, height, turn, null)
    const [azimuth, elevation] = turn
    // The points of the tube nearest to the eye and farthest from it, on the side of the eye.
    for (const [sign, shown] of [[1, true], [-1, false]]) {
      const r = FAR + sign * THICK * Math.cos(elevation)
      const point = [r * Math.cos(azimuth), r * Math.sin(azimuth), sign * THICK * Math.sin(elevation)]
      assert.equal(surface.shows(...seen(point, turn), 0.05), shown)
    }
    assert.equal(surface.shows(2, 2, -1, 0.05), true)
  }
})
