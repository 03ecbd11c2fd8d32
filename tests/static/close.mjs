import assert from "node:assert/strict"

/** Assert that two numbers, or all numbers of two lists, differ by at most `tolerance`. */
export function assertClose(actual, expected, tolerance = 1e-12) {
  const [found, wanted] = [actual, expected].map((one) => (typeof one === "number" ? [one] : Array.from(one)))
  assert.equal(found.length, wanted.length)
  found.forEach((one, i) => {
    assert.ok(Math.abs(one - wanted[i]) <= tolerance, `${found} is not within ${tolerance} of ${wanted}`)
  })
}
