// @ts-check
// Two states side by side, each in an embedded page with its own controls; time and rotation are linked ("side_by_side.js").
//
// Each half is a page, not a second drawing in this page, so pictures, player and requests exist once per page.

import { linkTo } from "../base/embedding.js"
import { HALF } from "./side_by_side.js"
import { element } from "../base/elements.js"
import { PHONE } from "../base/windows.js"
import { gallery } from "../pictures/gallery.js"
import { nameOf } from "../pictures/picture.js"
import { dialogOf, section } from "./dialog.js"

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
  const halves = ["A, pinned", "B"].map((title) => element("iframe.half", { title, name: HALF }))
  const dialog = dialogOf("Side by side", "beside", [],
    element("div.halves", ...halves.map((half) => section(half.title, half.title, half))))
  dialog.addEventListener("close", () => { for (const half of halves) half.src = "about:blank" })
  window.addEventListener("message", ({ source, origin, data }) => {
    if (origin !== location.origin || !halves.some(({ contentWindow }) => contentWindow === source)) return
    for (const { contentWindow } of halves) if (contentWindow !== source) contentWindow.postMessage(data, origin)
  })
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
