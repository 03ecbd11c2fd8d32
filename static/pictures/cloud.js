// Clouds of phase points, moved between the frames that the server has sent.
//
// The source holds, for each of its clouds i, `frames<i>`: numbers [frame][column][point] at the even `times`, columns
// (x, y, γ1, γ2, γ3).  Without `signs<i>` x, y are ω1, ω2, of a motion with I13 = I23 = 0 in the field b3; with them
// they are (ω, ξ) and ln|s|, s = I13ω1 + I23ω2, without a field, and `signs<i>` the signs of s.
// `body` = [I11, I22, I13, I23, 𝒟, b3]; `sense`: 1, or −1 where the motion is seen backward in time.

class Cloud {
  constructor(frames, signs, body, times, sense) {
    Object.assign(this, { frames, signs, body, times, sense })
    this.count = frames.length / (5 * times.length)
    this.size = 5 * this.count
    this.step = times[1] - times[0]
    const column = () => new Float32Array(this.count)
    for (const name of ["w1", "w2", "g1", "g2", "g3", "x", "y"]) this[name] = column()
    // Both ends of an interval: slopes of x and y, and ω.
    this.ends = [0, 1].map(() => ({ x: column(), y: column(), w1: column(), w2: column() }))
    this.left = -1
    this.t = null
  }

  get axes() {
    const J = Math.hypot(this.body[2], this.body[3])
    return [J, this.body[2] / J, this.body[3] / J]
  }

  velocities(x, y, w1, w2) {
    if (this.signs === undefined) return void (w1.set(x), w2.set(y))
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
    this.velocities(frames.subarray(at, at + count), frames.subarray(at + count, at + 2 * count), end.w1, end.w2)
    for (let i = 0; i < count; i++) {
      const [g1, g2, g3] = [frames[at + 2 * count + i], frames[at + 3 * count + i], frames[at + 4 * count + i]]
      const [a11, a12, a22] = [I11 + D * (g2 * g2 + g3 * g3), -D * g1 * g2, I22 + D * (g1 * g1 + g3 * g3)]
      const det = a11 * a22 - a12 * a12
      const free = signs !== undefined
      const [f1, f2] = free ? [-end.w2[i], end.w1[i]] : [b3 * g2, -b3 * g1]
      const [h1, h2] = [(a22 * f1 - a12 * f2) / det, (a11 * f2 - a12 * f1) / det]
      const s = free ? signs[i] * Math.exp(frames[at + count + i]) : 1
      end.x[i] = free ? s * (n2 * h1 - n1 * h2) : h1
      end.y[i] = free ? I13 * h1 + I23 * h2 : h2
    }
  }

  // Cubic curves between two frames, where all slopes are known: γ̇ = γ × ω.
  moveTo(t) {
    if (t === this.t) return
    this.t = t
    const { frames, count, size, times, step } = this
    const left = Math.max(0, Math.min(times.length - 2, Math.floor((t - times[0]) / step)))
    if (left !== this.left) {
      this.left = left
      this.prepare(left, this.ends[0])
      this.prepare(left + 1, this.ends[1])
    }
    const u = Math.max(0, Math.min(1, (t - times[left]) / step))
    const b = u * u * (3 - 2 * u)
    const a = 1 - b
    const [e, f] = [u * (1 - u) * (1 - u) * step * this.sense, u * u * (u - 1) * step * this.sense]
    const [from, to] = this.ends
    const at = left * size
    for (let i = 0; i < count; i++) {
      const p = at + i
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

// The clouds of a source, for all pictures that draw them; `at(t)` gives them at that time, each moved once.
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
