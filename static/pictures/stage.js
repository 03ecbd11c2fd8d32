// @ts-check
// Places the pictures of a scene: those in the lead, and a strip of small ones beside them.
//
// A tap on a picture of the strip, its corner button or its number key puts it in the lead, with Shift beside those that lead; Escape
// restores the lead of the scene.  Pictures that start folded are names in the strip.

import { button, element, icon, relabel } from "../base/elements.js"
import { listen, tell } from "../base/bus.js"
import { isTaken, onKeys } from "../base/keys.js"
import { isEmbedded, isPresenting, PHONE, setType, zoom } from "../base/modes.js"
import { arrange, onPhone } from "./arrange.js"
import { isFolded, labelOf, nameOf } from "./picture.js"
import { sizePlot } from "./plot_looks.js"

const MOST_LARGE = 3
const ENLARGE = "M5 9V5h4M15 5h4v4M19 15v4h-4M9 19H5v-4"
const REDUCE = "M9 5v4H5M19 9h-4V5M15 19v-4h4M5 15h4v4"
// Smallest edge of a picture of the strip, in pixels, and in a hall, in units of the font size; height of the strip on a phone.
const [LEAST, LEAST_IN_HALL, LEAST_ON_PHONE] = [150, 8, 118]
// Height below which a phone, turned, has no room for a second picture, and height of a row of names there.
const [LOW, ROW] = [400, 48]

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
  let isReading = false
  // Names of the pictures that start folded; on a phone of all pictures.
  const chips = element("div.chips", { role: "group", ariaLabel: "Pictures" })
  shelf.after(chips)

  const placeShown = () => { if (gallery.shown !== null) place(gallery.shown) }

  // Write only changes: a plot is laid out again whenever its size is set.
  /** @param {HTMLElement} cell @param {import("./arrange.js").Box} box */
  function put(cell, { x, y, edge, caption, aside }) {
    cell.classList.toggle("aside", aside)
    cell.querySelector(".host").toggleAttribute("inert", aside)
    const place = [x, y, edge, caption].map(Math.round).join(" ")
    if (cell.dataset.place === place) return
    cell.dataset.place = place
    for (const [key, value] of Object.entries({ x, y, edge, caption })) cell.style.setProperty(`--${key}`, `${Math.round(value)}px`)
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
      const { classList, style } = scene.cells.find((one) => nameOf(one) === plot.model.name)
      // A folded picture has no place.
      const edge = Number.parseFloat(style.getPropertyValue("--edge"))
      if (Number.isNaN(edge)) continue
      const isAside = classList.contains("aside")
      const sizes = `${type} ${zoom(edge)} ${isAside} ${edge}`
      if (scene.sizes.get(plot) === sizes) continue
      scene.sizes.set(plot, sizes)
      sizePlot(plot, type, isAside, edge)
    }
  }

  /** Return the viewport. @param {number} type */
  function viewport(type) {
    const style = getComputedStyle(shelf)
    /** @param {string} name of a length in units of the font size, in "pictures.css" */
    const heightOf = (name) => Math.ceil(type * Number.parseFloat(style.getPropertyValue(name)))
    return {
      width: shelf.clientWidth, height: shelf.clientHeight, gap: Math.round(0.6 * type),
      least: PHONE.matches ? (shelf.clientHeight < LOW ? ROW : LEAST_ON_PHONE) : isPresenting() ? LEAST_IN_HALL * type : LEAST,
      head: heightOf("--caption-height"), title: heightOf("--title-height"), names: heightOf("--name-height"),
    }
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
    const leads = leadsOf(scene, cells)
    // In a hall the text of a lesson needs the room of the others.
    const others = isReading && isPresenting() ? [] : cells.filter((cell) => !leads.includes(cell))
    // A phone shows one picture, and a small one beside the names.
    const second = alone.length > 0 || shelf.clientHeight < LOW || leads.length + others.length < 2 ? [] : [leads[1] ?? others[0]]
    const seen = PHONE.matches ? [leads[0], ...second] : [...leads, ...others]
    const leading = PHONE.matches ? 1 : leads.length
    const isAlone = isEmbedded || isPresenting() || alone.length > 0 || scene.cells.length === 1
    const names = isAlone ? [] : scene.cells.filter(({ dataset }) => PHONE.matches || "label" in dataset)
    const { boxes, names: frame } = PHONE.matches ? onPhone(viewport(type), second.length, names.length)
      : arrange(viewport(type), leading, others.length, names.length)
    for (const cell of scene.cells) cell.classList.toggle("off", !seen.includes(cell))
    seen.forEach((cell, i) => {
      put(cell, boxes[i])
      label(cell, cells.indexOf(cell), i < leading)
    })
    size(scene)
    if (scene !== gallery.shown) return
    for (const [key, value] of Object.entries(frame)) chips.style.setProperty(`--${key}`, `${Math.round(value)}px`)
    showChips(scene, names, leads[0])
  }

  /**
   * Return the cells that lead: the chosen ones, those that are shown alone, or those of the scene.
   * @param {Scene} scene
   * @param {HTMLElement[]} cells
   */
  function leadsOf(scene, cells) {
    const wishes = [scene === gallery.shown ? large : [], alone, scene.lead, [nameOf(cells[0])]]
    const found = wishes.map((names) => names.flatMap((name) => cells.filter((cell) => nameOf(cell) === name)))
    return found.find((some) => some.length > 0)
  }

  /** @param {HTMLElement} cell @param {number} i @param {boolean} isLeading */
  function label(cell, i, isLeading) {
    /** @type {HTMLElement} */
    const corner = cell.querySelector(".corner")
    const isChosen = large.includes(nameOf(cell))
    const action = isChosen ? "Back to the usual lead" : isLeading ? "Lead alone" : "Lead"
    const title = `${action} (${i + 1})`
    if (corner.title === title) return
    relabel(corner, isChosen ? REDUCE : ENLARGE, title, `${action}: ${labelOf(cell) || `picture ${i + 1}`}`)
    corner.ariaPressed = String(isChosen)
  }

  /** @param {Scene} scene @param {HTMLElement[]} cells @param {HTMLElement} lead */
  function showChips({ name }, cells, lead) {
    const key = [name, ...cells.map(nameOf)].join(" ")
    chips.hidden = cells.length === 0
    if (chips.dataset.key !== key) {
      chips.dataset.key = key
      chips.replaceChildren(...cells.map((cell) => button(`chip.unfold-${nameOf(cell)}`, () => {
        if (isFolded(cell) || !PHONE.matches) tell("fold", nameOf(cell))
        else enlarge([nameOf(cell)])
      })))
    }
    const items = /** @type {HTMLElement[]} */ ([...chips.children])
    items.forEach((chip, i) => {
      chip.textContent = labelOf(cells[i])
      chip.ariaPressed = String(PHONE.matches ? cells[i] === lead : !isFolded(cells[i]))
    })
  }

  /** @param {string} name */
  function unfold(name) {
    if (isFolded(gallery.cell(name))) tell("fold", name)
  }

  /** @param {string[]} names */
  function enlarge(names) {
    large = names
    // From now on, animate moves of pictures.
    shelf.classList.add("placed")
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

  // A picture of the strip acts as one button.
  shelf.addEventListener("click", ({ target }) => {
    if (!(target instanceof Element) || target.closest(".corner")) return
    const cell = target.closest(".aside")
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
  // Other uses of Escape have priority.
  onKeys({ escape: () => large.length > 0 && enlarge([]) }, window)

  listen({
    alone(names) {
      alone = names
      for (const name of names) unfold(name)
      // Wait until the page has its new layout.
      requestAnimationFrame(placeShown)
    },
    presenting: () => requestAnimationFrame(placeShown),
    reading(on) {
      isReading = on
      placeShown()
    },
    unfolding({ name, on }) {
      if (name !== "details") return
      shelf.parentElement.classList.toggle("detailed", on)
      placeShown()
    },
    client(own) { wanted = own.large ?? "" },
    // The chips carry the titles of these pictures.
    painted() { if (PHONE.matches) placeShown() },
    // Mark the picture of a lesson step.
    look(name) {
      unfold(name)
      enlarge([name])
    },
    fold(name) {
      const folded = gallery.cell(name).classList.toggle("folded")
      enlarge(folded ? large.filter((one) => one !== name) : [name])
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
