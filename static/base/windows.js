// @ts-check
// Media queries, the same as in the style sheets.  A page embedded in another one is a part, for which a smaller frame is enough.

const isPart = new URLSearchParams(location.search).get("embed") === "1"
// The width and the height below which a page looks as on a phone.
const PAGE = [800, 500]
const [width, height] = isPart ? [480, 320] : PAGE

export const PHONE = matchMedia(`(max-width: ${width - 1}px), (max-height: ${height - 1}px)`)
// Controls and text share a column as tabs.
export const NARROW = matchMedia("(max-width: 1499px)")
// The text has room beside the pictures.
export const ROOMY = matchMedia("(min-width: 1800px)")
const HAND = matchMedia("(pointer: coarse)")
/** Return words for the hand at this screen: a finger taps where a mouse clicks. @param {string} words */
export const byHand = (words) => (HAND.matches ? words.replaceAll(/\b([Cc])lick\b/g, (_, letter) => (letter === "C" ? "Tap" : "tap")) : words)
export const CALM = matchMedia("(prefers-reduced-motion: reduce)")

/** Return a style sheet with the sizes of this page: the sheets have those of a whole one. @param {string} sheet */
export const sized = (sheet) => (!isPart ? sheet : sheet.replaceAll(/\((max|min)-(width|height): (\d+)px\)/g, (whole, end, side, size) => {
  const i = side === "width" ? 0 : 1
  const below = Number(end === "max")
  return Number(size) === PAGE[i] - below ? `(${end}-${side}: ${[width, height][i] - below}px)` : whole
}))
