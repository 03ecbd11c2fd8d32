// @ts-check
// Expressions in captions, which no line break may part.

const EXPRESSION = /(\|[^|]{1,24}\||\([^()]{1,16}\)|[^\s|()]{1,12} [=≤≥<>±] [^\s|()]{1,12})/

/**
 * Return the parts of a text in order: those at odd indices are expressions like |Θ⁴ − id|, (h, f) and h = 1.5.
 * @param {string} text
 */
export const unbroken = (text) => text.split(EXPRESSION)
