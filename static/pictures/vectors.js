// Vectors in space, as arrays of three numbers.

export const dot = (u, v) => u[0] * v[0] + u[1] * v[1] + u[2] * v[2]
export const cross = (u, v) => [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
export const scaled = (v, factor) => v.map((x) => factor * x)
export const unit = (v) => scaled(v, 1 / Math.hypot(...v))
/** u + factor v */
export const plus = (u, v, factor = 1) => u.map((x, k) => x + factor * v[k])
