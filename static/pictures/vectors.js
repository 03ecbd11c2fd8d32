// @ts-check
// Vectors in space as arrays of three numbers, and circles on the unit sphere as columns [xs, ys, zs].

/**
 * Return the scalar product.
 * @param {Vector} u
 * @param {Vector} v
 */
export const dot = (u, v) => u[0] * v[0] + u[1] * v[1] + u[2] * v[2]
/**
 * Return the vector product.
 * @param {Vector} u
 * @param {Vector} v
 */
export const cross = (u, v) => [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
/**
 * Return factor v.
 * @param {Vector} v
 * @param {number} factor
 */
export const scaled = (v, factor) => v.map((x) => factor * x)
/**
 * Return the unit vector along v.
 * @param {Vector} v
 */
export const unit = (v) => scaled(v, 1 / Math.hypot(...v))
/**
 * Return u + factor v.
 * @param {Vector} u
 * @param {Vector} v
 */
export const plus = (u, v, factor = 1) => u.map((x, k) => x + factor * v[k])

/** Return points as columns [xs, ys, zs]. @param {Vector[]} points */
export const columnsOf = (points) => [0, 1, 2].map((k) => points.map((point) => point[k]))

/**
 * Return the circle (γ, axis) = height on the unit sphere, as columns.
 * @param {Vector} axis a unit vector
 * @param {number} height
 * @param {number} count number of segments
 * @returns {number[][]}
 */
export function circle(axis, height, count = 96) {
  const [a, b, c] = axis
  const e = unit(Math.abs(a) < 0.9 ? [0, c, -b] : [-c, 0, a])
  const g = cross(axis, e)
  const radius = Math.sqrt(Math.max(0, 1 - height * height))
  return columnsOf(Array.from({ length: count + 1 }, (_, i) => {
    const s = (2 * Math.PI * i) / count
    return axis.map((x, k) => height * x + radius * (Math.cos(s) * e[k] + Math.sin(s) * g[k]))
  }))
}

/** Return three parallels and six meridians, each as columns. */
export function graticule() {
  const meridians = Array.from({ length: 6 }, (_, i) => Math.PI * i / 6).map((s) => circle([Math.cos(s), Math.sin(s), 0], 0))
  return [...[-0.5, 0, 0.5].map((height) => circle([0, 0, 1], height)), ...meridians]
}
