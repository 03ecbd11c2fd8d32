// Finds the samples of an orbit around a time.

/**
 * Return [i, s]: t lies between the samples i and i + 1, the share s of the way; at an end where it lies beyond.  Samples are
 * closer where the curve bends.
 * @param {ArrayLike<number>} times two samples at least
 * @param {number} t
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
