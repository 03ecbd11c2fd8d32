// @ts-check
// Numbers within limits and as text.

/**
 * Return the nearest value from low to high.
 * @param {number} value
 * @param {number} low
 * @param {number} high
 */
export const within = (value, low, high) => Math.max(low, Math.min(high, value))

/**
 * Return a number as text, with at most `digits` significant digits and a minus sign (−).
 * @param {number} value
 * @param {number} digits
 */
export const written = (value, digits) => String(Number(value.toPrecision(digits))).replace("-", "−")
