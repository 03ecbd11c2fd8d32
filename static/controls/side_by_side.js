// @ts-check
// Links one of two pages side by side ("beside.js") to the other: both show the same moment in the same axes, and bodies and
// spheres turn together.  Messages go only to pages of the same origin.

import { listen, tell } from "../base/bus.js"

export const HALF = "hess-explorer-half"
// Event for the other page → event that the other page tells itself.
/** @type {Record<string, "follow" | "turn" | "axes-beside">} */
const HEARD = { time: "follow", turned: "turn", axes: "axes-beside" }

/** Link this page to the other one, if it is one of two pages side by side. */
export function joinOther() {
  if (window.name !== HALF || window.parent === window) return
  // A change that follows the other page is not sent back.
  let isFollowing = false
  /** @type {PageEvents["axes"] | null} */
  let axes = null
  let hasMet = false
  const { origin } = location
  /** @param {string} name @param {unknown} detail */
  const say = (name, detail) => { if (!isFollowing) window.parent.postMessage([name, detail], origin) }
  listen({
    time: ({ t }) => say("time", t),
    turned: (turned) => say("turned", turned),
    axes(found) {
      axes = found
      say("axes", found)
    },
  })
  window.addEventListener("message", ({ source, origin: from, data }) => {
    if (source !== window.parent || from !== origin || !Array.isArray(data) || !Object.hasOwn(HEARD, data[0])) return
    // The page that stood first tells its axes again, once the other can hear them.
    if (data[0] === "axes" && !hasMet && axes !== null) say("axes", axes)
    hasMet ||= data[0] === "axes"
    isFollowing = true
    tell(HEARD[data[0]], data[1])
    isFollowing = false
  })
}
