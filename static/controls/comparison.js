// What the pinned state and the one on show differ in, in a table under the controls.

import { button } from "../page/buttons.js"
import { listen, tell } from "../page/bus.js"
import { element } from "../page/mount.js"
import { besideDialog } from "./beside.js"

const cell = (tag, textContent, scope = "") => element(tag, { textContent, ...(scope && { scope }) })

/** Return the section, hidden while no state is pinned. */
export function comparison(signal) {
  let queries = []
  let shown = ""
  const beside = besideDialog(signal)
  const said = element("p", { className: "text", role: "status" })
  const flip = button("button param-flip", () => tell("flip"), { textContent: "A | B", title: "The pinned state, and back (C)" })
  const apart = button("button param-beside", () => beside.open(queries), {
    textContent: "Side by side", title: "Both, linked in time and rotation",
  })
  const unpin = button("button param-unpin", () => tell("pin"), { textContent: "Unpin" })
  const body = element("tbody")
  const table = element("table", {},
    element("thead", {}, element("tr", {}, cell("td", ""), cell("th", "A"), cell("th", "B"))), body)
  const box = element("section", { className: "comparison", hidden: true, ariaLabel: "Comparison" },
    said, element("div", { className: "comparing" }, flip, apart, unpin), table, beside.dialog)
  listen("compared", (compared) => {
    // It comes with every state.
    const text = JSON.stringify(compared)
    if (text === shown) return
    shown = text
    box.hidden = compared === null
    if (compared === null) return
    const { title, isPinnedShown, rows } = compared
    queries = compared.queries
    said.textContent = title !== null ? `A: ${title}` : isPinnedShown ? "A, pinned, is on show" : "B is on show, A is pinned"
    flip.ariaPressed = isPinnedShown
    table.hidden = rows.length === 0
    body.replaceChildren(...rows.map(([name, one, two]) => (
      element("tr", {}, cell("th", name, "row"), cell("td", one), cell("td", two)))))
  }, signal)
  return box
}
