// @ts-check
// Lays out the pictures of a scene in the viewport, and enlarges some of them.
//
// The corner button of a picture or its number key enlarges it, with Shift a second and third one; Escape restores the layout.
// A phone shows one picture at a time, chosen by the names below it.

import { button, element, icon, relabel } from "../base/elements.js"
import { listen, tell } from "../base/bus.js"
import { isEmbedded } from "../base/embedding.js"
import { isTaken, onKeys } from "../base/keys.js"
import { isPresenting, setType, zoom } from "../base/presenting.js"
import { NARROW, PHONE } from "../base/windows.js"
import { arrange, spareWidth } from "./arrange.js"
import { isFolded, labelOf, nameOf } from "./picture.js"
import { sizePlot } from "./plot_looks.js"

const MOST_LARGE = 3
// Share of the height that an enlarged picture takes if the width allows, at a desk and in present mode.
const DESK = 0.82
const HALL = 0.9
const ENLARGE = "M5 9V5h4M15 5h4v4M19 15v4h-4M9 19H5v-4"
const REDUCE = "M9 5v4H5M19 9h-4V5M15 19v-4h4M5 15h4v4"

// Largest width of a cell that is wider than its picture, in units of the font size.
const WIDEST = 34
// A picture that is smaller than this in present mode, in units of the font size, is drawn in this size and scaled down.
const LEGIBLE = 13
// The text beside the pictures takes at most this width from them, in units of the font size.
const MOST_SPARE = 10

/**
 * Return the stage, which places the pictures of a scene.
 * @param {HTMLElement} shelf holds the pictures
 * @param {typeof import("./gallery.js").gallery} gallery
 */
export function createStage(shelf, gallery) {
  /** @type {string[]} */
  let large = []
  let wanted = ""
  // The pictures that a step of a lesson shows alone; all if there is none.
  /** @type {string[]} */
  let alone = []
  // Pixels that the text has taken.
  let spare = 0
  const chips = element("div.chips", { role: "group", ariaLabel: "Picture" })
  shelf.after(chips)

  const placeShown = () => { if (gallery.shown !== null) place(gallery.shown) }

  // Write only changes: a plot is laid out again whenever its size is set.
  /** @param {HTMLElement} cell @param {import("./arrange.js").Box} box @param {number} type */
  function put(cell, { x, y, width, edge, caption, aside }, type) {
    const scale = isPresenting() && aside ? Math.min(1, edge / (LEGIBLE * type)) : 1
    cell.classList.toggle("aside", aside)
    cell.classList.toggle("thumbnail", scale < 1)
    const place = [x, y, width, edge, caption, 1000 * scale].map(Math.round).join(" ")
    if (cell.dataset.place === place) return
    cell.dataset.place = place
    for (const [key, value] of Object.entries({ x, y, width, edge, caption })) {
      cell.style.setProperty(`--${key}`, `${Math.round(value)}px`)
    }
    cell.style.setProperty("--scale", String(scale))
  }

  /** Update the font size and return it. */
  function typeNow() {
    const type = Number.parseFloat(getComputedStyle(shelf).fontSize)
    setType(type)
    return type
  }

  /** Update the sizes of labels, lines and dots in the plots of a scene. @param {Scene} scene */
  function size(scene) {
    const type = typeNow()
    for (const plot of scene.plots) {
      const cell = scene.cells.find((one) => nameOf(one) === plot.model.name)
      // A folded picture has no place yet.
      const scale = Number(cell.style.getPropertyValue("--scale")) || 1
      const edge = Number.parseFloat(cell.style.getPropertyValue("--edge")) || 0
      const sizes = `${type} ${zoom()} ${scale} ${edge}`
      if (scene.sizes.get(plot) === sizes) continue
      scene.sizes.set(plot, sizes)
      sizePlot(plot, type, scale, edge)
    }
  }

  /**
   * Return the viewport.  At a desk the text beside it takes the width that no picture needs.
   * @param {Scene} scene
   * @param {number} count of pictures
   * @param {number} type
   */
  function viewport(scene, count, type) {
    const isBeside = !NARROW.matches && !isPresenting() && !isEmbedded() && alone.length === 0
    const style = getComputedStyle(shelf)
    /** @param {string} name of a length in units of the font size, in "pictures.css" */
    const heightOf = (name) => Math.ceil(type * Number.parseFloat(style.getPropertyValue(name)))
    const full = {
      width: shelf.clientWidth + (isBeside ? spare : 0), height: shelf.clientHeight, count, gap: Math.round(0.6 * type),
      share: isPresenting() ? HALL : DESK, caption: heightOf("--caption-height"), title: heightOf("--title-height"),
      wide: WIDEST * type,
    }
    if (!isBeside) return full
    const taken = spareWidth(full, MOST_SPARE * type)
    if (scene === gallery.shown && spare !== taken) {
      spare = taken
      document.documentElement.style.setProperty("--spare", `${spare}px`)
    }
    return { ...full, width: full.width - taken }
  }

  /** Place the pictures of a scene; a scene that is not on show is laid out as it would open. @param {Scene} scene */
  function place(scene) {
    if (shelf.clientWidth === 0) return
    const type = typeNow()
    // Printing scales the pictures as they stand to the width of the paper ("base.css").
    for (const [key, value] of Object.entries({ across: shelf.clientWidth, down: shelf.clientHeight, type })) {
      scene.grid.style.setProperty(`--${key}`, `${value}px`)
    }
    const open = scene.cells.filter((cell) => !isFolded(cell))
    const chosenAlone = open.filter((cell) => alone.includes(nameOf(cell)))
    const cells = chosenAlone.length > 0 ? chosenAlone : open
    for (const cell of scene.cells) if (!cells.includes(cell)) cell.classList.add("off")
    const own = scene === gallery.shown ? large.map((name) => cells.findIndex((cell) => nameOf(cell) === name)) : []
    const chosen = own.filter((i) => i >= 0)
    const first = alone.at(-1) ?? scene.opening
    const opening = Math.max(0, cells.findIndex((cell) => nameOf(cell) === first))
    const seen = PHONE.matches ? [chosen[0] ?? opening] : cells.map((_, i) => i)
    const boxes = arrange(viewport(scene, seen.length, type), PHONE.matches ? [] : chosen)
    cells.forEach((cell, i) => {
      const at = seen.indexOf(i)
      cell.classList.toggle("off", at < 0)
      if (at >= 0) put(cell, boxes[at], type)
      label(cell, i, chosen.includes(i))
    })
    size(scene)
    if (scene === gallery.shown && PHONE.matches) showChips(scene, cells[seen[0]])
  }

  /** @param {HTMLElement} cell @param {number} i @param {boolean} isLarge */
  function label(cell, i, isLarge) {
    /** @type {HTMLElement} */
    const corner = cell.querySelector(".corner")
    const title = `${isLarge ? "Show all pictures" : "Enlarge"} (${i + 1})`
    if (corner.title === title) return
    relabel(corner, isLarge ? REDUCE : ENLARGE, title, `${isLarge ? "Reduce" : "Enlarge"} picture ${i + 1}`)
    corner.ariaPressed = String(isLarge)
  }

  /** @param {Scene} scene @param {HTMLElement} seen */
  function showChips({ name, cells }, seen) {
    chips.hidden = cells.length < 2 || alone.length > 0
    if (chips.dataset.scene !== name) {
      chips.dataset.scene = name
      chips.replaceChildren(...cells.map((cell) => button("chip", () => {
        if (isFolded(cell)) tell("fold", nameOf(cell))
        else enlarge([nameOf(cell)])
      })))
    }
    const items = /** @type {HTMLElement[]} */ ([...chips.children])
    items.forEach((chip, i) => {
      chip.textContent = labelOf(cells[i])
      chip.ariaPressed = String(cells[i] === seen)
    })
    items[cells.indexOf(seen)].scrollIntoView({ block: "nearest", inline: "nearest" })
  }

  /** @param {string} name */
  function unfold(name) {
    if (isFolded(gallery.cell(name))) tell("fold", name)
  }

  /** @param {string[]} names */
  function enlarge(names) {
    large = names
    tell("url", { large: names.join(",") })
    placeShown()
  }

  /**
   * Enlarge a picture, or restore the layout if it is large.
   * @param {string} name
   * @param {boolean} isAdded whether other large pictures stay large
   */
  function toggle(name, isAdded) {
    if (large.includes(name)) return enlarge(large.filter((one) => one !== name))
    enlarge(isAdded ? [...large, name].slice(-MOST_LARGE) : [name])
  }

  // A thumbnail is one button.
  shelf.addEventListener("click", ({ target }) => {
    if (!(target instanceof Element) || target.closest(".corner")) return
    const cell = target.closest(".thumbnail")
    if (cell instanceof HTMLElement) enlarge([nameOf(cell)])
  })
  document.addEventListener("keydown", (event) => {
    if (isTaken(event) || gallery.shown === null) return
    const [, digit] = /^(?:Digit|Numpad)([1-9])$/.exec(event.code) ?? []
    const cell = gallery.openCells()[Number(digit) - 1]
    if (cell === undefined) return
    event.preventDefault()
    toggle(nameOf(cell), event.shiftKey)
  })
  // Other uses of Escape come first.
  onKeys({ escape: () => large.length > 0 && enlarge([]) }, window)

  listen({
    alone(names) {
      alone = names
      for (const name of names) unfold(name)
      // Wait until the page has its new sizes.
      requestAnimationFrame(placeShown)
    },
    presenting: () => requestAnimationFrame(placeShown),
    client(own) { wanted = own.large ?? "" },
    // Their titles are the names on the chips.
    painted() { if (PHONE.matches) placeShown() },
    // The picture of a lesson step.
    look(name) {
      unfold(name)
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
    /** Return the corner button of a picture. @param {string} name */
    cornerFor: (name) => button("corner", (event) => toggle(name, event.shiftKey), { innerHTML: icon("", "1.3em") }),
    /** Show a scene, at first with the pictures enlarged that its link names. @param {Scene} scene */
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
