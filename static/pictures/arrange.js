// @ts-check
// Layout of square pictures in a viewport, side by side and as large as the room allows.

/**
 * The viewport.  `share` of its height belongs to an enlarged picture, if the width allows.  caption(width) is the height of
 * the caption over a picture in a cell of that width, `caption.title(width)` that of a title alone, and `caption.wide` the
 * largest width of a cell that is wider than its picture.
 * @typedef {{width: number, height: number, count: number, gap: number, share: number,
 *   caption: ((width: number) => number) & {title: (width: number) => number, wide: number}}} Place
 * @typedef {{x: number, y: number, width: number, edge: number, caption: number, small: boolean}} Box
 * Many arrangements are compared, by their smallest edge and the area of all pictures; boxes are made for one.
 * @typedef {{smallest: number, area: number, boxes: () => Box[]}} Arrangement
 */

const STEP = 2
// Square pixels that count as more.
const LARGER = 1000
// Edge of a picture beside enlarged ones, as a share of the height.
const SMALLEST = 0.09
// Error of the width that the text may take.
const COARSE = 12

/**
 * Return the height of a caption in a column of this width, whose cells are no wider than their captions and pictures need.
 * @param {Place["caption"]} caption
 * @param {number} wide
 * @param {number} high room for caption and picture
 */
function captionIn(caption, wide, high) {
  return caption(Math.min(wide, Math.max(high - caption(caption.wide), caption.wide)))
}

/**
 * Return the arrangement of equal pictures in a grid.
 * @param {Place} place
 * @param {number} columns
 * @returns {Arrangement}
 */
function grid({ width, height, count, gap, caption }, columns) {
  const rows = Math.ceil(count / columns)
  const wide = (width - gap * (columns - 1)) / columns
  const high = (height - gap * (rows - 1)) / rows
  const above = captionIn(caption, wide, high)
  const edge = Math.floor(Math.min(wide, high - above))
  const boxes = () => {
    const cell = Math.min(wide, Math.max(edge, caption.wide))
    const left = (width - columns * cell - gap * (columns - 1)) / 2
    const row = edge + above + gap
    const top = (height - rows * row + gap) / 2
    // A last row that is not full is centred.
    /** @param {number} i */
    const aside = (i) => (i < columns * (rows - 1) ? 0 : (rows * columns - count) / 2)
    return Array.from({ length: count }, (_, i) => ({
      x: left + ((i % columns) + aside(i)) * (cell + gap), y: top + Math.floor(i / columns) * row,
      width: cell, edge, caption: above, small: false,
    }))
  }
  return { smallest: edge, area: count * edge * edge, boxes }
}

/** @param {Place} place */
const grids = (place) => Array.from({ length: place.count }, (_, i) => grid(place, i + 1))

/**
 * Return the arrangement with `leading` pictures of edge `lead` in a row, and the others in a grid beside or below it.
 * @param {Place} place
 * @param {number} leading
 * @param {number} lead
 * @param {boolean} isBeside
 * @param {boolean} titlesOnly whether the captions of the others are cut to their titles
 * @returns {Arrangement}
 */
function leadAndRest({ width, height, count, gap, share, caption }, leading, lead, isBeside, titlesOnly) {
  const over = caption(lead)
  const row = leading * lead + gap * (leading - 1)
  const across = isBeside ? row + gap : 0
  const down = isBeside ? 0 : lead + over + gap
  const left = isBeside ? 0 : (width - row) / 2
  const top = isBeside ? (height - lead - over) / 2 : 0
  const { title, wide } = caption
  const rest = best(grids({
    width: width - across, height: height - down, count: count - leading, gap, share,
    caption: titlesOnly ? Object.assign(title.bind(null), { title, wide }) : caption,
  }))
  const edge = Math.min(rest.smallest, lead)
  const boxes = () => {
    const leads = Array.from({ length: leading }, (_, i) => ({
      x: left + i * (lead + gap), y: top, width: lead, edge: lead, caption: over, small: false,
    }))
    const others = rest.boxes().map((box) => ({ ...box, x: box.x + across, y: box.y + down, edge, small: titlesOnly }))
    return [...leads, ...others]
  }
  return { smallest: edge, area: leading * lead * lead + (count - leading) * edge * edge, boxes }
}

/**
 * Return the largest edge of `leading` pictures in a row.
 * @param {Place} place
 * @param {number} leading
 */
function largest({ width, height, gap, caption }, leading) {
  const wide = (width - gap * (leading - 1)) / leading
  let edge = Math.floor(Math.min(wide, height - caption(Math.min(wide, height))))
  // A smaller picture may have a higher caption.
  while (edge > 0 && edge + caption(edge) > height) edge -= 1
  return edge
}

/**
 * Return the arrangement with the largest smallest picture; among equals, the one that fills most of the viewport.
 * @param {Arrangement[]} arrangements
 */
function best(arrangements) {
  return arrangements.reduce((found, one) => {
    const larger = one.smallest - found.smallest
    return larger >= 1 || (larger > -1 && one.area - found.area >= LARGER) ? one : found
  })
}

/**
 * Return the arrangements with leading pictures from the largest possible edge down to `least`.
 * @param {Place} place
 * @param {number} leading
 * @param {number} least
 * @param {boolean} titlesOnly
 */
function ledBy(place, leading, least, titlesOnly) {
  const found = []
  for (let lead = largest(place, leading); lead >= least; lead -= STEP) {
    for (const isBeside of [true, false]) found.push(leadAndRest(place, leading, lead, isBeside, titlesOnly))
  }
  return found
}

/**
 * Return the best arrangement without an enlarged picture.
 * @param {Place} place
 */
function even(place) {
  return best([...grids(place), ...place.count > 2 ? ledBy(place, 1, Math.floor(0.4 * largest(place, 1)) + 1, false) : []])
}

/**
 * Return the best arrangement with the first `leading` pictures enlarged.
 * @param {Place} place
 * @param {number} leading
 */
function enlarged(place, leading) {
  if (leading === place.count) return grid(place, leading)
  const [most, high] = [largest(place, leading), place.height]
  const large = best(ledBy(place, leading, Math.min(place.share * high, 0.94 * most), true))
  if (large.smallest >= SMALLEST * high) return large
  // Leave the others some room.
  return ledBy(place, leading, 0.6 * most, true).find(({ smallest }) => smallest >= SMALLEST * high) ?? large
}

/**
 * Return how much narrower, up to `most`, the viewport may be without any picture getting smaller.
 * @param {Place} place
 * @param {number} most
 */
export function spareWidth(place, most) {
  if (place.count === 0) return 0
  const full = even(place)
  let [spare, beyond] = [0, Math.min(most, place.width)]
  while (beyond - spare > COARSE) {
    const middle = (spare + beyond) / 2
    const { area, smallest } = even({ ...place, width: place.width - middle })
    if (smallest >= full.smallest && area >= full.area) spare = middle
    else beyond = middle
  }
  return Math.floor(spare)
}

/**
 * Return the box of each picture, in their order.
 * @param {Place} place
 * @param {number[]} large indices of the enlarged pictures
 * @returns {Box[]}
 */
export function arrange(place, large = []) {
  if (place.count === 0) return []
  const order = [...large, ...Array.from({ length: place.count }, (_, i) => i).filter((i) => !large.includes(i))]
  const boxes = (large.length > 0 ? enlarged(place, large.length) : even(place)).boxes()
  /** @type {Box[]} */
  const placed = []
  order.forEach((picture, i) => { placed[picture] = boxes[i] })
  return placed
}
