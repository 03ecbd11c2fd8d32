// @ts-check
// Links one of two pages side by side ("beside.js") to the other: both show the same moment, and bodies and spheres turn
// together.  Messages go only to pages of the same origin.

import { listen, tell } from "./bus.js"

export const HALF = "hess-explorer-half"
// Event for the other page → event that the other page tells itself.
/** @type {Record<string, "follow" | "turn">} */
const HEARD = { time: "follow", turned: "turn" }

/** Link this page to the other one, if it is one of two pages side by side. */
export function joinOther() {
  if (window.name !== HALF || window.parent === window) return
  // A change that follows the other page is not sent back.
  let isFollowing = false
  const { origin } = location
  /** @param {string} name @param {unknown} detail */
  const say = (name, detail) => { if (!isFollowing) window.parent.postMessage([name, detail], origin) }
  listen({
    time: ({ t }) => say("time", t),
    turned: (turned) => say("turned", turned),
  })
  window.addEventListener("message", ({ source, origin: from, data }) => {
    if (source !== window.parent || from !== origin || !Array.isArray(data) || !Object.hasOwn(HEARD, data[0])) return
    isFollowing = true
    tell(HEARD[data[0]], data[1])
    isFollowing = false
  })
}
