// @ts-check
// The cell of a picture: caption, corner button, host of the picture, and a line about the point under the mouse.

import { element } from "../base/elements.js"
import { byHand } from "../base/modes.js"
import { unbroken } from "./unbroken.js"

const CROSS = "arrow keys move a cross, Enter chooses, + and − zoom, 0 shows the whole"
const RING = "arrow keys move the ring, + and − zoom, 0 shows the whole"
// Tooltip of a picture and actions of the keyboard, see "plot_keys.js", by what the mouse does there.
/** @type {Record<string, [string, string]>} */
const HANDS = {
  drag: ["Drag or click to choose values, scroll or pinch to zoom", RING],
  "drag box": ["Drag the ring or click to choose values; drag a box, scroll or pinch to zoom", RING],
  box: ["Click to choose values; drag a box, scroll or pinch to zoom", CROSS],
  click: ["Click to choose values, scroll or pinch to zoom", CROSS],
}

/**
 * Return [cell, host]; the picture is drawn into the host.
 * @param {PictureDescription} picture
 * @param {HTMLElement} corner
 * @returns {[HTMLElement, HTMLElement]}
 */
export function createCell({ name, folded, hands }, corner) {
  const host = element(`div.host.hands-${hands.split(" ").at(-1)}`, { title: byHand(HANDS[hands]?.[0] ?? ""), dataset: { hands } })
  const under = element("output.text.hover", { hidden: true })
  const cell = element(`section.picture.picture-${name}`, {
    dataset: { name }, onmouseleave: () => { under.hidden = true },
  }, element("h2.text.caption",
    element("span.title"), "\n", element("span.verdict"), " ", element("span.numbers")), corner, host, under)
  cell.classList.toggle("folded", folded !== null)
  if (folded !== null) {
    // The server draws a folded picture when it is unfolded.
    cell.dataset.late = ""
    cell.dataset.label = folded.replace(/^Show (the )?/, "")
  }
  return [cell, host]
}

/** Return the name of a picture. @param {HTMLElement} cell */
export const nameOf = (cell) => cell.dataset.name
/** Return a part of the caption. @param {HTMLElement} cell @param {keyof Caption} part */
const textOf = (cell, part) => cell.querySelector(`.${part}`).textContent
/** Return the title of a picture. @param {HTMLElement} cell */
export const titleOf = (cell) => textOf(cell, "title")
/** Return the name of a picture on buttons: its title, which a picture that starts folded does not have at first. @param {HTMLElement} cell */
export const labelOf = (cell) => cell.dataset.label ?? titleOf(cell)
/**
 * Return [title, verdict, numbers] of a picture.
 * @param {HTMLElement} cell
 * @returns {[string, string, string]}
 */
export const captionOf = (cell) => [titleOf(cell), textOf(cell, "verdict"), textOf(cell, "numbers")]
/** Return whether a picture is folded. @param {HTMLElement} cell */
export const isFolded = (cell) => cell.classList.contains("folded")
/** Return whether a picture is visible. @param {HTMLElement} cell */
export const isInSight = (cell) => cell.checkVisibility()

/** Return the nodes of a text whose expressions between bars stay on one line. @param {string} text */
const spans = (text) => unbroken(text).map((part, i) => i % 2 ? element("span.unbroken", part) : part)

/**
 * Fill a cell with its caption, if that has changed.
 * @param {HTMLElement} cell
 * @param {Record<string, Caption>} captions by the names of pictures
 */
export function fillCaption(cell, { [nameOf(cell)]: caption }) {
  if (caption === undefined) return
  for (const [part, text] of Object.entries(caption)) {
    const item = cell.querySelector(`.${part}`)
    if (item.textContent !== text) item.replaceChildren(...spans(text))
  }
  /** @type {HTMLElement} */
  const host = cell.querySelector(".host")
  if (host.role !== null) host.ariaLabel = `${caption.title}: ${HANDS[host.dataset.hands][1]}`
}

/**
 * Fill a cell with the line about the point under the mouse, if that has changed.
 * @param {HTMLElement} cell
 * @param {Texts} texts "hover-" and name → line
 */
export function fillHover(cell, { [`hover-${nameOf(cell)}`]: hover }) {
  if (hover !== undefined) {
    /** @type {HTMLElement} */
    const under = cell.querySelector(".hover")
    under.textContent = hover
    under.hidden = hover === "" || !cell.matches(":is(:hover, :focus-within)")
  }
}
