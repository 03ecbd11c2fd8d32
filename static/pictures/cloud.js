// Clouds of phase points, moved between the frames that the server has sent.
//
// The source holds, for each of its clouds i, `frames<i>`: numbers [frame][column][point] at the even `times`, columns
// (x, y, γ1, γ2, γ3).  Without `signs<i>` x, y are ω1, ω2, of a motion with I13 = I23 = 0 in the field b3; with them
// they are (ω, ξ) and ln|s|, s = I13ω1 + I23ω2, without a field, and `signs<i>` the signs of s.
// `body` = [I11, I22, I13, I23, 𝒟, b3]; `sense`: 1, or −1 where the motion is seen backward in time.

class Cloud {
  constructor(frames, signs, body, times, sense) {
    this.frames = frames
    this.signs = signs
    this.body = body
    this.times = times
    this.sense = sense
    this.count = frames.length / (5 * times.length)
    this.size = 5 * this.count
    this.step = times[1] - times[0]
    const column = () => new Float32Array(this.count)
    this.x = column()
    this.y = column()
    this.w1 = column()
    this.w2 = column()
    this.g1 = column()
    this.g2 = column()
    this.g3 = column()
    // Both ends of an interval: slopes of x and y, and ω.
    this.ends = [0, 1].map(() => ({ x: column(), y: column(), w1: column(), w2: column() }))
    this.left = -1
    this.t = null
    // Of s, as [its largest slope, its direction].
    const J = Math.hypot(body[2], body[3])
    this.axes = [J, body[2] / J, body[3] / J]
  }

  velocities(x, y, w1, w2) {
    if (this.signs === undefined) {
      w1.set(x)
      w2.set(y)
      return
    }
    const [J, n1, n2] = this.axes
    for (let i = 0; i < this.count; i++) {
      const across = (this.signs[i] * Math.exp(y[i])) / J
      w1[i] = n2 * x[i] + n1 * across
      w2[i] = n2 * across - n1 * x[i]
    }
  }

  // ω and the slopes of x and y at a frame, by `eq29`: ω̇ = s h with h = Î⁻¹(−ω2, ω1), so that d ln|s|/dt = (I13, I23)·h;
  // or Îω̇ = (b3γ2, −b3γ1).
  prepare(frame, end) {
    const { frames, count, size, signs, body } = this
    const [I11, I22, I13, I23, D, b3] = body
    const [, n1, n2] = this.axes
    const at = frame * size
    const isFree = signs !== undefined
    this.velocities(frames.subarray(at, at + count), frames.subarray(at + count, at + 2 * count), end.w1, end.w2)
    for (let i = 0; i < count; i++) {
      const [g1, g2, g3] = [frames[at + 2 * count + i], frames[at + 3 * count + i], frames[at + 4 * count + i]]
      const [a11, a12, a22] = [I11 + D * (g2 * g2 + g3 * g3), -D * g1 * g2, I22 + D * (g1 * g1 + g3 * g3)]
      const det = a11 * a22 - a12 * a12
      const [f1, f2] = isFree ? [-end.w2[i], end.w1[i]] : [b3 * g2, -b3 * g1]
      const [h1, h2] = [(a22 * f1 - a12 * f2) / det, (a11 * f2 - a12 * f1) / det]
      const s = isFree ? signs[i] * Math.exp(frames[at + count + i]) : 1
      end.x[i] = isFree ? s * (n2 * h1 - n1 * h2) : h1
      end.y[i] = isFree ? I13 * h1 + I23 * h2 : h2
    }
  }

  // Cubic curves between two frames, where all slopes are known: γ̇ = γ × ω.
  moveTo(t) {
    if (t === this.t) return
    this.t = t
    const { frames, count, size, times, step, sense } = this
    const left = Math.max(0, Math.min(times.length - 2, Math.floor((t - times[0]) / step)))
    const [from, to] = this.ends
    if (left !== this.left) {
      this.left = left
      this.prepare(left, from)
      this.prepare(left + 1, to)
    }
    const u = Math.max(0, Math.min(1, (t - times[left]) / step))
    const b = u * u * (3 - 2 * u)
    const a = 1 - b
    const [e, f] = [u * (1 - u) * (1 - u) * step * sense, u * u * (u - 1) * step * sense]
    for (let i = 0, p = left * size; i < count; i++, p++) {
      const q = p + size
      this.x[i] = a * frames[p] + b * frames[q] + e * from.x[i] + f * to.x[i]
      this.y[i] = a * frames[p + count] + b * frames[q + count] + e * from.y[i] + f * to.y[i]
      const [p1, p2, p3] = [frames[p + 2 * count], frames[p + 3 * count], frames[p + 4 * count]]
      const [q1, q2, q3] = [frames[q + 2 * count], frames[q + 3 * count], frames[q + 4 * count]]
      const [v1, v2, w1, w2] = [from.w1[i], from.w2[i], to.w1[i], to.w2[i]]
      const g1 = a * p1 + b * q1 - e * p3 * v2 - f * q3 * w2
      const g2 = a * p2 + b * q2 + e * p3 * v1 + f * q3 * w1
      const g3 = a * p3 + b * q3 + e * (p1 * v2 - p2 * v1) + f * (q1 * w2 - q2 * w1)
      const inverse = 1 / Math.sqrt(g1 * g1 + g2 * g2 + g3 * g3)
      this.g1[i] = g1 * inverse
      this.g2[i] = g2 * inverse
      this.g3[i] = g3 * inverse
    }
    this.velocities(this.x, this.y, this.w1, this.w2)
  }
}

const allClouds = new WeakMap()

/** Return the clouds of a source, for all pictures that draw them; `at(t)` gives them at that time, each moved once. */
export function cloudsOf(source) {
  if (allClouds.has(source)) return allClouds.get(source)
  let [data, clouds] = [null, []]
  const at = (t) => {
    if (data !== source.data) {
      data = source.data
      clouds = [0, 1].filter((i) => data[`frames${i}`]?.length > 0).map((i) => (
        new Cloud(data[`frames${i}`], data[`signs${i}`], data.body, data.times, data.sense)))
    }
    for (const cloud of clouds) cloud.moveTo(t)
    return clouds
  }
  allClouds.set(source, { at })
  return allClouds.get(source)
}
