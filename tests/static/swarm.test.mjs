import assert from "node:assert/strict"
import test from "node:test"

import { Swarm } from "../../static/pictures/swarm.js"

const SPACING = 0.5
const SAMPLES = 9
const STEP = 1e-4

// Two motions from their columns as functions of time, with values from −2 on.
function swarmOf(columns, kinds) {
  const values = columns.flatMap((column) => Array.from({ length: SAMPLES }, (_, m) => column.map((at) => (
    Math.round((at(m * SPACING) + 2) / STEP) - 32767))).flat())
  return new Swarm({
    count: 2, spacing: SPACING, names: columns.map((_, k) => `c${k}`), kinds, low: columns.map(() => -2), step: columns.map(() => STEP),
    until: Float32Array.of(SAMPLES - 1, 2.5), values: Int16Array.from(values), palette: ["#000000"],
  })
}

function assertNear(found, expected, by = 2 * STEP) {
  found.forEach((one, i) => assert.ok(Math.abs(one - expected[i]) <= by, `${[...found]} ≠ ${expected}`))
}

test("between samples parabolas are exact, and inside cubics too", () => {
  const [fall, rise, cubic] = [(t) => 1 - t * t / 8, (t) => t / 3, (t) => t * (t - 2) * (t - 4) / 4]
  const swarm = swarmOf([[fall, rise], [cubic, cubic]], ["", ""])
  for (const t of [0, 0.1, 0.25, 0.5, 1.3, 3.8, 4]) assertNear(swarm.at("c0", t), [fall(t), rise(t)])
  for (const t of [0.5, 0.77, 2.25, 3.4]) assertNear(swarm.at("c1", t), [cubic(t), cubic(t)])
  // After the last sample a motion stays there.
  assertNear(swarm.at("c0", 9), [fall(4), rise(4)])
})

test("an angle takes the shorter way round", () => {
  const turned = (t) => { const x = 1.5 + 0.9 * t; return x - 2 * Math.PI * Math.round(x / (2 * Math.PI)) }
  const swarm = new Swarm({ ...swarmOf([[(t) => turned(t) / 2, () => 0]], [""]).data, kinds: ["angle"], low: [-4], step: [2 * STEP] })
  for (const t of [0.2, 1.7, 1.8, 1.9, 3.3]) assertNear(swarm.at("c0", t), [turned(t), 0], 5 * STEP)
})

test("a step stays until the next sample", () => {
  const swarm = swarmOf([[(t) => Math.floor(t), () => 1]], ["step"])
  assertNear(swarm.at("c0", 0.99), [0, 1])
  assertNear(swarm.at("c0", 1), [1, 1])
})

test("a bead fades before its motion is not known any more, unless that is known to the end", () => {
  const swarm = swarmOf([[() => 0, () => 0]], [""])
  assert.deepEqual([0, 1.25, 1.26, 4].map((t) => swarm.opacity(0, t)), [1, 1, 1, 1])
  // Known up to t = 1.25, and all the time in its last four samples.
  const seen = [0, 0.5, 1.25, 1.26].map((t) => swarm.opacity(1, t))
  seen.forEach((one, k) => assert.ok(Math.abs(one - [0.625, 0.375, 0, 0][k]) < 1e-6))
})
