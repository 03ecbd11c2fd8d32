// @ts-check
// The time of the player, samples of an orbit around a time, and the state between them.

import { listen } from "../base/bus.js"

/** The time of the player and the state then, null without a motion. @type {PageEvents["time"]} */
export const moment = { t: 0, state: null }
listen({ time(now) { Object.assign(moment, now) } })

/**
 * Return [i, s]: the time t lies between the samples i and i + 1, at the share s of the interval.
 *
 * Beyond the ends s is clamped to 0 or 1.  Samples are closer where the curve bends.
 * @param {ArrayLike<number>} times increasing, at least two samples
 * @param {number} t
 * @returns {[number, number]}
 */
export function between(times, t) {
  let i = 0
  let above = times.length - 1
  while (above - i > 1) {
    const middle = (i + above) >> 1
    if (times[middle] <= t) i = middle
    else above = middle
  }
  return [i, Math.max(0, Math.min(1, (t - times[i]) / (times[i + 1] - times[i])))]
}

/**
 * Return the value of each column at a time, interpolated linearly.
 * @param {Record<string, ArrayLike<number>>} data the samples; column `t` holds their times
 * @param {string[]} angles columns that may jump by a full turn: there the nearer sample is taken
 * @param {number} time
 * @returns {Record<string, number>}
 */
export function stateAt(data, angles, time) {
  const [i, s] = between(data.t, time)
  /** @type {Record<string, number>} */
  const state = {}
  for (const [name, column] of Object.entries(data)) {
    const [a, b] = [column[i], column[i + 1]]
    const jump = angles.includes(name) && Math.abs(b - a) > 1
    state[name] = jump ? (s < 0.5 ? a : b) : a + s * (b - a)
  }
  return state
}
