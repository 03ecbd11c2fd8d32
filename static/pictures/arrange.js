// @ts-check
// Layout of square pictures in a viewport, side by side and as large as the room allows.

/**
 * The viewport.  `share` of its height belongs to an enlarged picture, if the width allows.  `caption` is the height of the
 * caption over a picture, `title` that of the title over a picture beside enlarged ones, and `wide` the largest width of a cell
 * that is wider than its picture.
 * @typedef {{width: number, height: number, count: number, gap: number, share: number, caption: number, title: number,
 *   wide: number}} Place
 * @typedef {{x: number, y: number, width: number, edge: number, caption: number, aside: boolean}} Box
 * Many arrangements are compared, by their smallest edge and the area of all pictures; boxes are made for one.
 * @typedef {{smallest: number, area: number, boxes: () => Box[]}} Arrangement
 */

const STEP = 2
// Factor of the area of all pictures for which an arrangement may be less regular.
const LARGER = 1.1
// Edge of a picture beside enlarged ones, as a share of the height.
const SMALLEST = 0.09
// Error of the width that the text may take.
const COARSE = 12

/**
 * Return the arrangement of equal pictures in a grid.
 * @param {Place} place
 * @param {number} columns
 * @returns {Arrangement}
 */
function grid({ width, height, count, gap, caption, wide: widest }, columns) {
  const rows = Math.ceil(count / columns)
  const wide = (width - gap * (columns - 1)) / columns
  const high = (height - gap * (rows - 1)) / rows
  const edge = Math.floor(Math.min(wide, high - caption))
  const boxes = () => {
    const cell = Math.min(wide, Math.max(edge, widest))
    const left = (width - columns * cell - gap * (columns - 1)) / 2
    const row = edge + caption + gap
    const top = (height - rows * row + gap) / 2
    // A last row that is not full is centred.
    /** @param {number} i */
    const indent = (i) => (i < columns * (rows - 1) ? 0 : (rows * columns - count) / 2)
    return Array.from({ length: count }, (_, i) => ({
      x: left + ((i % columns) + indent(i)) * (cell + gap), y: top + Math.floor(i / columns) * row,
      width: cell, edge, caption, aside: false,
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
 * @param {boolean} aside whether the captions of the others are cut to their titles
 * @returns {Arrangement}
 */
function leadAndRest(place, leading, lead, isBeside, aside) {
  const { width, height, count, gap, caption, title } = place
  const row = leading * lead + gap * (leading - 1)
  const across = isBeside ? row + gap : 0
  const down = isBeside ? 0 : lead + caption + gap
  const left = isBeside ? 0 : (width - row) / 2
  const top = isBeside ? (height - lead - caption) / 2 : 0
  const rest = best(grids({
    ...place, width: width - across, height: height - down, count: count - leading, caption: aside ? title : caption,
  }))
  const edge = Math.min(rest.smallest, lead)
  const boxes = () => {
    const leads = Array.from({ length: leading }, (_, i) => ({
      x: left + i * (lead + gap), y: top, width: lead, edge: lead, caption, aside: false,
    }))
    const others = rest.boxes().map((box) => ({ ...box, x: box.x + across, y: box.y + down, edge, aside }))
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
  return Math.floor(Math.min((width - gap * (leading - 1)) / leading, height - caption))
}

/**
 * Return the arrangement with the largest smallest picture; among equals, one whose pictures fill clearly more of the viewport.
 * @param {Arrangement[]} arrangements
 */
function best(arrangements) {
  return arrangements.reduce((found, one) => {
    const larger = one.smallest - found.smallest
    return larger >= 1 || (larger > -1 && one.area >= LARGER * found.area) ? one : found
  })
}

/**
 * Return the arrangements with leading pictures from the largest possible edge down to `least`.
 * @param {Place} place
 * @param {number} leading
 * @param {number} least
 * @param {boolean} aside
 */
function ledBy(place, leading, least, aside) {
  const found = []
  for (let lead = largest(place, leading); lead >= least; lead -= STEP) {
    for (const isBeside of [true, false]) found.push(leadAndRest(place, leading, lead, isBeside, aside))
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
