// The cell of one picture: caption, corner button, the place of the picture, and a line about what is under the mouse.

import { element } from "../page/elements.js"

// What the mouse does in a picture.
const HINTS = {
  drag: "Drag or click: what you point at is chosen",
  box: "Click: what you point at is chosen. Drag a box: a closer look",
  click: "Click: what you point at is chosen",
}

/** Return [cell, host]; the picture is drawn into the host. */
export function createCell({ name, folded, hands }, corner, pointed) {
  const host = element(`div.host.hands-${hands}`, { title: HINTS[hands] ?? "" })
  const under = element("output.text.hover", { hidden: true })
  const cell = element(`section.picture.picture-${name}`, {
    dataset: { name }, onpointerenter: pointed, onmouseleave: () => { under.hidden = true },
  }, element("h2.text.caption",
    element("span.title"), "\n", element("span.said")), corner, host, under)
  cell.classList.toggle("folded", folded !== null)
  // Until it is unfolded the server does not draw it.
  if (folded !== null) cell.dataset.late = ""
  return [cell, host]
}

export const nameOf = (cell) => cell.dataset.name
export const titleOf = (cell) => cell.querySelector(".title").textContent
export const captionOf = (cell) => cell.querySelector(".said").textContent
export const isFolded = (cell) => cell.classList.contains("folded")
export const isInSight = (cell) => cell.checkVisibility()

/** Put the new ones of these texts into a cell: {name: caption, hover-name: line about what is under the mouse}. */
export function fillTexts(cell, texts) {
  const { [nameOf(cell)]: text, [`hover-${nameOf(cell)}`]: hover } = texts
  if (text !== undefined) {
    const [title, ...said] = text.split("\n")
    cell.querySelector(".title").textContent = title
    cell.querySelector(".said").textContent = said.join(" ")
  }
  if (hover !== undefined) {
    const under = cell.querySelector(".hover")
    under.textContent = hover
    under.hidden = hover === "" || !cell.matches(":hover")
  }
}
