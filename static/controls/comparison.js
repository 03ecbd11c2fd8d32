// What the pinned state and the one on show differ in, in a table under the controls.

import { listen, tell } from "../page/bus.js"
import { element } from "../page/mount.js"
import { besideDialog } from "./beside.js"

export function comparison(signal) {
  const said = element("p", { className: "text", role: "status" })
  const flip = element("button", {
    type: "button", className: "button param-flip", textContent: "A | B", title: "The pinned state, and back (C)",
  })
  const beside = besideDialog(signal)
  const apart = element("button", {
    type: "button", className: "button param-beside", textContent: "Side by side", title: "Both, linked in time and rotation",
  })
  const unpin = element("button", { type: "button", className: "button param-unpin", textContent: "Unpin" })
  const body = element("tbody")
  const table = element("table", {}, element("thead", {}, element("tr", {},
    ...["", "A", "B"].map((text) => element(text === "" ? "td" : "th", { textContent: text })))), body)
  const box = element("section", { className: "comparison", hidden: true, "aria-label": "Comparison" },
    said, element("div", { className: "comparing" }, flip, apart, unpin), table, beside.dialog)
  flip.addEventListener("click", () => tell("flip"))
  let queries = []
  apart.addEventListener("click", () => beside.open(queries))
  unpin.addEventListener("click", () => tell("pin"))
  let shown = ""
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
    flip.setAttribute("aria-pressed", String(isPinnedShown))
    table.hidden = rows.length === 0
    body.replaceChildren(...rows.map(([name, one, two]) => element("tr", {},
      element("th", { scope: "row", textContent: name }), element("td", { textContent: one }), element("td", { textContent: two }))))
  }, signal)
  return box
}
