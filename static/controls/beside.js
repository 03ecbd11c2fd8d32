// @ts-check
// Two states side by side, each in an embedded page with its own controls; both show the
// same moment in the same axes, and bodies and spheres turn together.  They talk on a channel of their own, which has their name.
//
// Each half is a page, not a second drawing in this page, so pictures, player and requests exist once per page.

import { listen, tell } from "../base/bus.js"
import { element } from "../base/elements.js"
import { linkTo } from "../base/embedding.js"
import { PHONE } from "../base/windows.js"
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
export function besideDialog() {
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
