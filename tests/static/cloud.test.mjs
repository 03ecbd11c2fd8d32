import test from "node:test"

import { cloudsOf } from "../../static/pictures/cloud.js"
import { assertClose } from "./close.mjs"

const STATE = [0.7, -0.4, 0.48, 0.6, 0.64]

// `eq29` in the field b3.
function rates([w1, w2, g1, g2, g3], [I11, I22, I13, I23, D, b3]) {
  const s = I13 * w1 + I23 * w2
  const [f1, f2] = [b3 * g2 - s * w2, s * w1 - b3 * g1]
  const [a, b, c] = [I11 + D * (g2 * g2 + g3 * g3), -D * g1 * g2, I22 + D * (g1 * g1 + g3 * g3)]
  const det = a * c - b * b
  return [(c * f1 - b * f2) / det, (a * f2 - b * f1) / det, -g3 * w2, g3 * w1, g1 * w2 - g2 * w1]
}

// The state at the time t, by the method of Runge and Kutta.
function moved(body, t, steps = 2000) {
  const h = t / steps
  const along = (y, k, share) => y.map((one, i) => one + share * h * k[i])
  let y = STATE
  for (let n = 0; n < steps; n++) {
    const a = rates(y, body)
    const b = rates(along(y, a, 0.5), body)
    const c = rates(along(y, b, 0.5), body)
    const d = rates(along(y, c, 1), body)
    y = y.map((one, i) => one + (h / 6) * (a[i] + 2 * b[i] + 2 * c[i] + d[i]))
  }
  return y
}

const BODIES = {
  "in a field": [2, 1, 0, 0, 1.5, -2],
  free: [2, 1, 0.3, 0.5, 1.5, 0],
}

for (const [name, body] of Object.entries(BODIES)) {
  for (const sense of [1, -1]) {
    test(`between two frames the point of a ball ${name} is on its motion, sense ${sense}`, () => {
      const [, , I13, I23] = body
      const J = Math.hypot(I13, I23)
      const times = [0, 0.1, 0.2, 0.3]
      // A free motion is sent as (ω, ξ), ln|s| and the sign of s.
      const sent = ([w1, w2, ...gamma]) => (
        J === 0 ? [w1, w2, ...gamma] : [(I23 * w1 - I13 * w2) / J, Math.log(Math.abs(I13 * w1 + I23 * w2)), ...gamma])
      const frames0 = Float32Array.from(times.flatMap((t) => sent(moved(body, sense * t))))
      const signs0 = J === 0 ? undefined : [Math.sign(I13 * STATE[0] + I23 * STATE[1])]
      const [cloud] = cloudsOf({ data: { frames0, signs0, body, times, sense } }).at(0.157)
      const found = [cloud.w1, cloud.w2, cloud.g1, cloud.g2, cloud.g3].map(([one]) => one)
      assertClose(found, moved(body, sense * 0.157), 5e-6)
    })
  }
}
