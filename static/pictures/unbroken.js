// @ts-check
// Expressions that a line break must not divide.

/**
 * Return the parts of a text in order: those at odd indices are expressions between bars, like |Θ⁴ − id|.
 * @param {string} text
 */
export const unbroken = (text) => text.split(/(\|[^|]{1,24}\|)/)
