// @ts-check
// Comparison of two states: the table of differences between the pinned one and the one on show, and both side by side, each in an
// embedded page with its own controls.  These show the same moment in the same axes, and bodies and spheres turn together; the two
// windows have the same name, which is that of their channel.
//
// Each half is a page, not a second drawing in this page, so pictures, player and requests exist once per page.

import { listen, tell } from "../base/bus.js"
import { button, element } from "../base/elements.js"
import { linkTo } from "../base/embedding.js"
import { PHONE } from "../base/modes.js"
import { gallery } from "../pictures/gallery.js"
import { nameOf } from "../pictures/picture.js"
import { dialogOf, section } from "./dialog.js"

const HALF = "hess-explorer-half"
// Event for the other page → event that the other page tells itself.
/** @type {Record<string, "follow" | "turn" | "axes-beside">} */
const HEARD = { time: "follow", turned: "turn", axes: "axes-beside" }

/** Link this page to the other one, if it is one of two pages side by side. */
export function joinOther() {
  if (!window.name.startsWith(HALF)) return
  const other = new BroadcastChannel(window.name)
  // A change that follows the other page is not sent back.
  let isFollowing = false
  /** @type {PageEvents["axes"] | null} */
  let axes = null
  let hasMet = false
  /** @param {string} name @param {unknown} detail */
  const say = (name, detail) => { if (!isFollowing) other.postMessage([name, detail]) }
  listen({
    time: ({ t }) => say("time", t),
    turned: (turned) => say("turned", turned),
    axes(found) {
      axes = found
      say("axes", found)
    },
  })
  other.addEventListener("message", ({ data: [name, detail] }) => {
    // The page that stood first tells its axes again, once the other can hear them.
    if (name === "axes" && !hasMet && axes !== null) say("axes", axes)
    hasMet ||= name === "axes"
    isFollowing = true
    tell(HEARD[name], detail)
    isFollowing = false
  })
}

// Width at which a page shows all its pictures.
const LEAST = 804

// Keys of the address that both halves take from this page.
const SHARED = ["t", "speed", "az", "el", "theme"]

/** Return the address of an embedded page with a state and, for the scene on show, the pictures in sight. @param {string} query */
function addressOf(query) {
  const here = new URL(linkTo())
  const url = new URL(`?${query}&embed=1`, here)
  for (const key of SHARED) if (here.searchParams.has(key)) url.searchParams.set(key, here.searchParams.get(key))
  if (url.searchParams.get("scene") === gallery.shown.name) {
    url.searchParams.set("pictures", gallery.cellsInSight().map(nameOf).join(","))
  }
  return url.href
}

/** Return the dialog and the function that opens it with two states. */
function besideDialog() {
  const name = HALF + crypto.getRandomValues(new Uint32Array(2)).join("-")
  const halves = ["A, pinned", "B"].map((title) => element("iframe.half", { title, name }))
  const dialog = dialogOf("Side by side", "beside", [],
    element("div.halves", ...halves.map((half) => section(half.title, half.title, half))))
  dialog.addEventListener("close", () => { for (const half of halves) half.src = "about:blank" })
  return {
    dialog,
    /** @param {[string, string]} queries */
    open(queries) {
      halves.forEach((half, i) => { half.src = addressOf(queries[i]) })
      dialog.showModal()
      // Scaled to show all pictures, except on a phone.
      for (const half of halves) half.style.zoom = String(PHONE.matches ? 1 : Math.min(1, half.parentElement.clientWidth / LEAST))
    },
  }
}

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
