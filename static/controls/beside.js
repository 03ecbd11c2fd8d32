// Two states side by side, each in a page of its own with its controls: what is played or turned in one is in the other.
//
// Pages rather than a second drawing in this one: pictures, player and requests are there once for each page, and so each
// half is all that a page is; what goes to and fro is small ("linked.js").

import { linkTo } from "../page/embedding.js"
import { HALF } from "../page/side_by_side.js"
import { element } from "../page/elements.js"
import { PHONE } from "../page/windows.js"
import { gallery } from "../pictures/gallery.js"
import { nameOf } from "../pictures/picture.js"
import { dialogOf, section } from "./dialog.js"

// So wide a page must be to show all its pictures at once.
const LEAST = 804

// What both halves have of this page.
const SHARED = ["t", "speed", "az", "el", "theme"]

// The address of a part of the page in this state: of the scene on show the pictures in sight.
function addressOf(query) {
  const here = new URL(linkTo())
  const url = new URL(`?${query}&embed=1`, here)
  for (const key of SHARED) if (here.searchParams.has(key)) url.searchParams.set(key, here.searchParams.get(key))
  if (url.searchParams.get("scene") === gallery.shown.name) {
    url.searchParams.set("pictures", gallery.cellsInSight().map(nameOf).join(","))
  }
  return url.href
}

/** Return {dialog, open([query of A, query of B])}. */
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
    open(queries) {
      halves.forEach((half, i) => { half.src = addressOf(queries[i]) })
      dialog.showModal()
      // With all of its pictures, but on a phone.
      for (const half of halves) half.style.zoom = PHONE.matches ? 1 : Math.min(1, half.parentNode.clientWidth / LEAST)
    },
  }
}
