// @ts-check
// The table of differences between the pinned state and the state on show.

import { button, element } from "../base/elements.js"
import { listen, tell } from "../base/bus.js"
import { besideDialog } from "./beside.js"

/** Return the table's section, which is hidden while no state is pinned. */
export function comparison() {
  /** @type {[string, string]} */
  let queries = ["", ""]
  let shown = ""
  const beside = besideDialog()
  const said = element("p.text", { role: "status" })
  const flip = button("button.param-flip", () => tell("flip"), { title: "Switch between the two states (C)" }, "A | B")
  const apart = button("button.param-beside", () => beside.open(queries), { title: "Both, linked in time and rotation" },
    "Side by side")
  const unpin = button("button.param-unpin", () => tell("pin"), "Unpin")
  const body = element("tbody")
  const table = element("table",
    element("thead", element("tr", element("td"), element("th", "A"), element("th", "B"))), body)
  const box = element("section.comparison", { hidden: true, ariaLabel: "Comparison" },
    said, element("div.comparing", flip, apart, unpin), table, beside.dialog)
  listen({
    compared(compared) {
      // This event follows every state, so skip an unchanged table.
      const text = JSON.stringify(compared)
      if (text === shown) return
      shown = text
      box.hidden = compared === null
      if (compared === null) return
      const { title, isPinnedShown, rows } = compared
      queries = compared.queries
      said.textContent = title !== null ? `A: ${title}` : isPinnedShown ? "A (pinned) is shown" : "B is shown, A is pinned"
      flip.ariaPressed = String(isPinnedShown)
      table.hidden = rows.length === 0
      body.replaceChildren(...rows.map(([name, one, two]) => (
        element("tr", element("th", { scope: "row" }, name), element("td", one), element("td", two)))))
    },
  })
  return box
}
