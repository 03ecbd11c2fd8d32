// Layout of square pictures in a viewport: side by side, as large as the room allows.  Pure: numbers in, numbers out.

// Of the height: so large is a picture that is enlarged, if the width allows.
const LARGE = 0.82
const STEP = 2

// `count` pictures of equal right in columns.
function grid({ width, height, count, gap, caption }, columns) {
  const rows = Math.ceil(count / columns)
  const wide = (width - gap * (columns - 1)) / columns
  const high = (height - gap * (rows - 1)) / rows
  const edge = Math.floor(Math.min(wide, high - caption(wide)))
  const cell = Math.min(wide, Math.max(edge, caption.wide))
  const left = (width - columns * cell - gap * (columns - 1)) / 2
  const row = edge + caption(wide) + gap
  const top = (height - rows * row + gap) / 2
  // A last row of fewer stands in the middle.
  const aside = (i) => (i < columns * (rows - 1) ? 0 : (rows * columns - count) / 2)
  const boxes = Array.from({ length: count }, (_, i) => ({
    x: left + ((i % columns) + aside(i)) * (cell + gap), y: top + Math.floor(i / columns) * row,
    width: cell, edge, caption: caption(wide), small: false,
  }))
  return { boxes, smallest: edge }
}

// The first `leading` pictures with edge `lead` in a row, the rest in a strip beside them or below.
function strip({ width, height, count, gap, caption }, leading, lead, isBeside, titlesOnly) {
  const rest = count - leading
  const over = caption(lead)
  const row = leading * lead + gap * (leading - 1)
  const [wide, high] = isBeside
    ? [width - row - gap, (height - gap * (rest - 1)) / rest]
    : [(width - gap * (rest - 1)) / rest, height - lead - over - gap]
  const above = titlesOnly ? caption.title : caption(wide)
  const edge = Math.floor(Math.min(wide, high - above, lead))
  const cell = isBeside || titlesOnly ? wide : Math.min(wide, Math.max(edge, caption.wide))
  const left = isBeside ? 0 : (width - rest * cell - gap * (rest - 1)) / 2
  const boxes = Array.from({ length: count }, (_, i) => {
    if (i < leading) {
      const x = isBeside ? 0 : (width - row) / 2
      return { x: x + i * (lead + gap), y: 0, width: lead, edge: lead, caption: over, small: false }
    }
    const k = i - leading
    return {
      x: isBeside ? row + gap : left + k * (cell + gap), y: isBeside ? k * (high + gap) : lead + over + gap,
      width: cell, edge, caption: above, small: titlesOnly,
    }
  })
  return { boxes, smallest: Math.min(edge, lead), lead }
}

// The largest edge that `leading` pictures in a row can have.
function largest({ width, height, gap, caption }, leading) {
  const wide = (width - gap * (leading - 1)) / leading
  return Math.floor(Math.min(wide, height - caption(Math.min(wide, height))))
}

const area = ({ boxes }) => boxes.reduce((sum, { edge }) => sum + edge * edge, 0) / 1000

// The arrangement whose smallest picture is largest; of those, the one that fills most.
function best(arrangements) {
  return arrangements.reduce((found, one) => {
    const larger = one.smallest - found.smallest
    return larger >= 1 || (larger > -1 && area(one) - area(found) >= 1) ? one : found
  })
}

// The first `leading` pictures from as large as can be to at least `least`, the rest beside or below.
function strips(place, leading, least, titlesOnly) {
  const found = []
  for (let lead = largest(place, leading); lead >= least; lead -= STEP) {
    found.push(strip(place, leading, lead, true, titlesOnly), strip(place, leading, lead, false, titlesOnly))
  }
  return found
}

// Nobody is enlarged.
function even(place) {
  const grids = Array.from({ length: place.count }, (_, i) => grid(place, i + 1))
  return best(place.count > 2 ? [...grids, ...strips(place, 1, Math.floor(0.4 * largest(place, 1)) + 1, false)] : grids)
}

// The first `leading` pictures are enlarged: those of at least `LARGE` of the height that leave the rest most room.
function enlarged(place, leading) {
  if (leading === place.count) return grid(place, leading)
  return best(strips(place, leading, Math.min(LARGE * place.height, 0.94 * largest(place, leading)), true))
}

/**
 * Return one {x, y, width, edge, caption, small} for each picture, in their order.
 *
 * caption(width) is the height of a caption over a picture in a cell so wide; `caption.title` that of its title alone, which
 * is what stands over a small picture beside an enlarged one; `caption.wide`: a cell that is wider than its picture need be
 * no wider than this.
 * @param {{width: number, height: number, count: number, gap: number, caption: any}} place
 * @param {number[]} large the numbers of the pictures enlarged
 */
export function arrange(place, large = []) {
  if (place.count === 0) return []
  const order = [...large, ...Array.from({ length: place.count }, (_, i) => i).filter((i) => !large.includes(i))]
  const { boxes } = large.length > 0 ? enlarged(place, large.length) : even(place)
  const placed = []
  order.forEach((picture, i) => { placed[picture] = boxes[i] })
  return placed
}
