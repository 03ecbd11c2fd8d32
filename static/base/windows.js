// @ts-check
// Media queries, the same as in the style sheets.  A page embedded in another one is a part, for which a smaller frame is enough.

/** Whether the page is embedded in another one (embed=1). */
export const isEmbedded = new URLSearchParams(location.search).get("embed") === "1"
// The width and the height below which a page looks as on a phone; in the style sheets those of a whole page.
const [WIDTH, HEIGHT] = isEmbedded ? ["480px", "320px"] : ["800px", "500px"]

export const PHONE = matchMedia(`(width < ${WIDTH}), (height < ${HEIGHT})`)
// Controls and text share a column as tabs.
export const NARROW = matchMedia("(width < 1500px)")
// The text has room beside the pictures.
export const ROOMY = matchMedia("(width >= 1800px)")
const HAND = matchMedia("(pointer: coarse)")
/** Return words for the hand at this screen: a finger taps where a mouse clicks. @param {string} words */
export const byHand = (words) => (HAND.matches ? words.replaceAll(/\b([Cc])lick\b/g, (_, letter) => (letter === "C" ? "Tap" : "tap")) : words)
export const CALM = matchMedia("(prefers-reduced-motion: reduce)")

/** Return a style sheet with the sizes of this page: the sheets have those of a whole one. @param {string} sheet */
export const sized = (sheet) => (
  sheet.replaceAll(/(?<=width (<|>=) )800px/g, WIDTH).replaceAll(/(?<=height (<|>=) )500px/g, HEIGHT))
