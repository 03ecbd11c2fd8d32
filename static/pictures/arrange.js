// @ts-check
// Layout of square pictures: those in the lead in a grid, the others in a strip beside it or below it.

/**
 * The viewport.  `head` is the height of the caption over a leading picture, `title` that over a picture of the strip, and `least`
 * the smallest edge there; `names` is the height of a row of names in the strip.
 * @typedef {{width: number, height: number, gap: number, head: number, title: number, least: number, names: number}} Viewport
 * @typedef {{width: number, height: number}} Room
 * @typedef {{x: number, y: number, edge: number, caption: number, aside: boolean}} Box
 * @typedef {Room & {x: number, y: number}} Frame
 */

const STEP = 4
// A single leading picture takes this share of the height, if the width allows; several take this share of what they could.
const LEAST = 0.7
// Largest edge in the strip, in units of that of the lead.
const LARGEST = 0.9
// Width of a name in a row of names beside the lead, in units of the height of the row.
const NAME = 5
// Where the strip stands, beside the lead or below it, and its names, in a column beside its pictures or in rows below them.
const WAYS = [[true, false], [true, true], [false, false]]

/** @param {number} count @param {number} columns */
const rowsOf = (count, columns) => Math.ceil(count / columns)

/**
 * Return the edge of equal squares below captions, which fill a room.
 * @param {Room} room
 * @param {number} count
 * @param {number} columns
 * @param {number} caption
 * @param {number} gap
 */
function edgeOf({ width, height }, count, columns, caption, gap) {
  const rows = rowsOf(count, columns)
  return Math.floor(Math.min((width - gap * (columns - 1)) / columns, (height - gap * (rows - 1)) / rows - caption))
}

/**
 * Return the size of a grid of squares below captions.
 * @param {number} count
 * @param {number} columns
 * @param {number} edge
 * @param {number} caption
 * @param {number} gap
 * @returns {Room}
 */
const sizeOf = (count, columns, edge, caption, gap) => ({
  width: columns * (edge + gap) - gap, height: rowsOf(count, columns) * (edge + caption + gap) - gap,
})

/** @param {number} most */
const upTo = (most) => Array.from({ length: most }, (_, i) => i + 1)

/**
 * Return the best strip for a room: as many columns as give the largest pictures.
 * @param {Room} room
 * @param {number} count
 * @param {Viewport} viewport
 */
function stripIn(room, count, { title, gap }) {
  return upTo(count).map((columns) => ({ columns, edge: edgeOf(room, count, columns, title, gap) }))
    .reduce((best, one) => (one.edge > best.edge ? one : best), { columns: 1, edge: 0 })
}

/**
 * Return the room that names take from the strip: rows below its pictures, or a column beside them.
 * @param {number} width of the strip
 * @param {number} count
 * @param {boolean} isColumn
 * @param {Viewport} viewport
 * @returns {Room}
 */
function namesIn(width, count, isColumn, { names, gap }) {
  if (count === 0) return { width: 0, height: 0 }
  const inRow = isColumn ? 1 : Math.max(1, Math.floor(width / (NAME * names)))
  return { width: isColumn ? NAME * names + gap : 0, height: isColumn ? 0 : rowsOf(count, inRow) * names + gap }
}

/**
 * Return the best layout: of those in which the strip can be read, the one whose pictures cover most.
 * @param {Viewport} viewport
 * @param {number} leading
 * @param {number} rest
 * @param {number} names
 */
function layout(viewport, leading, rest, names) {
  const { width, height, gap, head, least } = viewport
  // If most pictures lead, the others may be equally large.
  const largest = leading > rest ? 1 : LARGEST
  /** @param {number} columns of the lead @param {number} edge @param {boolean[]} way see `WAYS` */
  const option = (columns, edge, [isBeside, isColumn]) => {
    const lead = sizeOf(leading, columns, edge, head, gap)
    const room = isBeside ? { width: width - lead.width - gap, height } : { width, height: height - lead.height - gap }
    const taken = namesIn(room.width, names, isColumn, viewport)
    const left = { width: room.width - taken.width, height: room.height - taken.height }
    const found = stripIn(left, rest, viewport)
    const strip = { ...found, edge: Math.min(found.edge, Math.floor(largest * edge)) }
    const isSeen = rest === 0 ? left.height >= 0 && left.width >= 0 : strip.edge >= least
    const worth = isSeen ? leading * edge * edge + rest * strip.edge * strip.edge : strip.edge - least
    return { columns, edge, isBeside, isColumn, lead, room, taken, strip, isSeen, worth }
  }
  let best = { ...option(1, 0, [false, false]), worth: -Infinity }
  for (const columns of upTo(leading)) {
    const most = edgeOf(viewport, leading, columns, head, gap)
    const fewest = leading > 1 ? LEAST * most : Math.min(most, LEAST * height)
    for (let edge = most; edge >= fewest; edge -= STEP) {
      for (const way of WAYS) {
        const one = option(columns, edge, way)
        if (one.worth > best.worth && (one.isSeen || best.worth < 0)) best = one
      }
    }
  }
  return best
}

/**
 * Return the box of each picture, the leading ones first, and the frame of the names in the strip.
 * @param {Viewport} viewport
 * @param {number} leading how many pictures lead
 * @param {number} rest how many stand in the strip
 * @param {number} names how many names stand there
 * @returns {{boxes: Box[], names: Frame}}
 */
export function arrange(viewport, leading, rest, names = 0) {
  const { width, height, gap, head, title } = viewport
  const { columns, edge, isBeside, isColumn, lead: first, room, taken, strip } = layout(viewport, leading, rest, names)
  const aside = rest === 0 ? { width: 0, height: -gap } : sizeOf(rest, strip.columns, strip.edge, title, gap)
  // Names alone fill a row beside the lead; without any the lead stands in the middle.
  const beside = rest > 0 || isColumn ? aside.width : names > 0 ? room.width : -gap
  const across = isBeside ? first.width + gap + beside + taken.width : Math.max(first.width, aside.width)
  const down = isBeside ? Math.max(first.height, aside.height + taken.height) : first.height + gap + aside.height + taken.height
  const [left, top] = [(width - across) / 2, Math.max(0, (height - down) / 2)]
  const [x, y] = isBeside ? [left + first.width + gap, top] : [(width - aside.width) / 2, top + first.height + gap]
  return {
    boxes: [
      ...grid(leading, { columns, edge }, head, gap, isBeside ? left : (width - first.width) / 2, top, false),
      ...grid(rest, strip, title, gap, x, y, true),
    ],
    names: isColumn
      ? { x: x + aside.width + gap, y, width: taken.width - gap, height: down }
      : { x: isBeside ? x : 0, y: y + aside.height + gap, width: isBeside ? across - first.width - gap : width, height: taken.height - gap },
  }
}

/**
 * Return the boxes of a grid.
 * @param {number} count
 * @param {{columns: number, edge: number}} size
 * @param {number} caption
 * @param {number} gap
 * @param {number} x
 * @param {number} y
 * @param {boolean} aside
 * @returns {Box[]}
 */
const grid = (count, { columns, edge }, caption, gap, x, y, aside) => Array.from({ length: count }, (_, i) => ({
  x: x + (i % columns) * (edge + gap), y: y + Math.floor(i / columns) * (edge + caption + gap), edge, caption, aside,
}))

/**
 * Return the boxes on a phone: one picture, as wide as the viewport allows, and perhaps a small one below it, beside the names.
 * @param {Viewport} viewport
 * @param {number} count of small pictures, 0 or 1
 * @param {number} names
 * @returns {{boxes: Box[], names: Frame}}
 */
export function onPhone({ width, height, gap, head, title, least }, count, names) {
  const small = least - title
  const edge = Math.min(width, height - head - (count + names > 0 ? least + gap : 0))
  const y = head + edge + gap
  return {
    boxes: [
      { x: (width - edge) / 2, y: 0, edge, caption: head, aside: false },
      ...Array.from({ length: count }, () => ({ x: gap, y, edge: small, caption: title, aside: true })),
    ],
    names: { x: count * (small + gap) + gap, y, width: width - count * (small + gap) - 2 * gap, height: least },
  }
}
