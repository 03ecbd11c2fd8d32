// Lays out the pictures of a scene in the viewport, and enlarges some of them.
//
// A picture is enlarged by the button in its corner or the key of its number; Shift adds a second one; Escape brings all
// back.  On a phone one picture is seen at a time, chosen by its number below it.

import { button, element, icon, relabel } from "../page/elements.js"
import { listen, tell } from "../page/bus.js"
import { isTaken, onKeys } from "../page/keys.js"
import { isPresenting, setType, zoom } from "../page/presenting.js"
import { PHONE } from "../page/windows.js"
import { arrange } from "./arrange.js"
import { isFolded, nameOf } from "./picture.js"
import { sizePlot } from "./plot_looks.js"

const MOST_LARGE = 2
const ENLARGE = "M4 4h6v2H6v4H4zm10 0h6v6h-2V6h-4zM4 14h2v4h4v2H4zm14 0h2v6h-6v-2h4z"
const REDUCE = "M8 4h2v6H4V8h4zm6 0h2v4h4v2h-6zM4 14h6v6H8v-4H4zm10 0h6v2h-4v4h-2z"

// Heights of captions, in units of the type's size.
const LINE = 1.29
const AIR = 0.3
// Of so many letters' width is the longest caption with its title.
const LONGEST = 56
// Of the corner, on both sides.
const SIDES = 4.4
const WIDEST = 34
const MOST_LINES = 4
const LARGE_LINES = 3
// In cells of so few units the captions are set smaller.
const NARROW = 26
const SMALLER = 0.88

const isNarrow = (width, type) => width / type < NARROW && !isPresenting() && !PHONE.matches

// The height of a caption over a picture in a cell so wide, see "arrange.js".
function captions(type) {
  // From afar a few words are read, and the rest of the room is the picture's.
  const most = isPresenting() ? LARGE_LINES : MOST_LINES
  const own = (width) => (isNarrow(width, type) ? SMALLER * type : type)
  const needed = (width) => Math.max(2, Math.ceil(LONGEST / Math.max(1, width / own(width) - SIDES)))
  const lines = (width) => (isPresenting() && needed(width) > most ? 1 : Math.min(most, needed(width)))
  const high = (count, size) => Math.ceil((count * LINE + AIR) * size)
  return Object.assign((width) => high(lines(width), own(width)), { title: high(1, type), wide: WIDEST * type })
}

/**
 * Return {place(scene), size(scene), cornerFor(name), enter(scene)}.
 * @param {HTMLElement} shelf holds the pictures
 * @param {any} gallery see "gallery.js"
 */
export function createStage(shelf, gallery) {
  let large = []
  let wanted = ""
  const chips = element("div.chips", { role: "group", ariaLabel: "Picture" })
  shelf.after(chips)

  const placeShown = () => { if (gallery.shown !== null) place(gallery.shown) }

  // Only what changes is written: a plot whose size is set is laid out again.
  function put(cell, { x, y, width, edge, caption, small }, type) {
    const place = [x, y, width, edge, caption].map(Math.round).join(" ")
    cell.classList.toggle("small", small)
    cell.classList.toggle("narrow", isNarrow(width, type))
    if (cell.dataset.place === place) return
    cell.dataset.place = place
    for (const [key, value] of Object.entries({ x, y, width, edge, caption })) {
      cell.style.setProperty(`--${key}`, `${Math.round(value)}px`)
    }
  }

  // The size of the type, also in the plots of this scene.
  function size(scene) {
    const type = Number.parseFloat(getComputedStyle(shelf).fontSize)
    setType(type)
    const sizes = `${type} ${zoom()}`
    if (scene.sizes !== sizes && scene.plots.length > 0) {
      scene.sizes = sizes
      for (const plot of scene.plots) sizePlot(plot, type)
    }
    return type
  }

  // Give the pictures of a scene their places; those of another scene as it would open.
  function place(scene) {
    const { clientWidth: width, clientHeight: height } = shelf
    if (width === 0) return
    const type = size(scene)
    const cells = scene.cells.filter((cell) => !isFolded(cell))
    const own = scene === gallery.shown ? large.map((name) => cells.findIndex((cell) => nameOf(cell) === name)) : []
    const chosen = own.filter((i) => i >= 0)
    // From afar nothing is seen of a small one beside.
    const isAlone = isPresenting() && chosen.length > 0
    const seen = PHONE.matches ? [chosen[0] ?? 0] : isAlone ? chosen : cells.map((_, i) => i)
    const caption = captions(type)
    const boxes = arrange({
      width, height, count: seen.length, gap: Math.round(0.6 * type), caption,
    }, PHONE.matches || isAlone ? [] : chosen)
    cells.forEach((cell, i) => {
      const at = seen.indexOf(i)
      cell.classList.toggle("off", at < 0)
      if (at >= 0) put(cell, { ...boxes[at], small: boxes[at].small || boxes[at].caption <= caption.title }, type)
      label(cell, i, chosen.includes(i))
    })
    if (scene === gallery.shown && PHONE.matches) showChips(scene.cells, cells[seen[0]])
  }

  function label(cell, i, isLarge) {
    const corner = cell.querySelector(".corner")
    const title = `${isLarge ? "Beside the others again" : "Enlarge"} (${i + 1})`
    if (corner.title === title) return
    relabel(corner, isLarge ? REDUCE : ENLARGE, title, `${isLarge ? "Reduce" : "Enlarge"} picture ${i + 1}`)
    corner.ariaPressed = isLarge
  }

  function showChips(cells, seen) {
    chips.replaceChildren(...cells.map((cell, i) => button("chip", () => {
      if (isFolded(cell)) tell("fold", nameOf(cell))
      else enlarge([nameOf(cell)])
    }, { ariaPressed: cell === seen, ariaLabel: `Picture ${i + 1}` }, i + 1)))
  }

  function enlarge(names) {
    large = names
    tell("url", { large: names.join(",") })
    placeShown()
  }

  // Another one in its place, or with it; the same one again: all are equal.
  function toggle(name, isAdded) {
    if (large.includes(name)) return enlarge(large.filter((one) => one !== name))
    enlarge(isAdded ? [...large, name].slice(-MOST_LARGE) : [name])
  }

  document.addEventListener("keydown", (event) => {
    if (isTaken(event) || gallery.shown === null) return
    const [, digit] = /^(?:Digit|Numpad)([1-9])$/.exec(event.code) ?? []
    const cell = gallery.openCells()[Number(digit) - 1]
    if (cell === undefined) return
    event.preventDefault()
    toggle(nameOf(cell), event.shiftKey)
  })
  // After whatever else Escape is for.
  onKeys({ escape: () => large.length > 0 && enlarge([]) }, window)

  listen({
    // When all of the page has its new sizes.
    presenting: () => requestAnimationFrame(placeShown),
    client(own) { wanted = own.large ?? "" },
    // The picture that a lesson looks at.
    look(name) {
      if (isFolded(gallery.cell(name))) tell("fold", name)
      enlarge([name])
    },
    fold(name) {
      const folded = gallery.cell(name).classList.toggle("folded")
      if (folded) large = large.filter((one) => one !== name)
      else if (PHONE.matches) large = [name]
      placeShown()
      tell("folded", { name, folded })
    },
  })

  new ResizeObserver(placeShown).observe(shelf)

  return {
    place, size,
    cornerFor: (name) => button("corner", (event) => toggle(name, event.shiftKey), { innerHTML: icon("", "1.3em") }),
    // The scene is on show: what its link has enlarged is so at first.
    enter(scene) {
      const names = scene.cells.map(nameOf)
      large = wanted.split(",").filter((name) => names.includes(name)).slice(0, MOST_LARGE)
      for (const name of large) gallery.cell(name).classList.remove("folded")
      wanted = ""
      tell("url", { large: large.join(",") })
      place(scene)
    },
  }
}
