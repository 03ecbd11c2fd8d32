// One of two pages side by side ("beside.js"): the moment that is shown in one is shown in the other, and so is the turn of
// a body or a sphere.  Whoever asked for a page of this name is of the same origin, or hears nothing.

import { listen, tell } from "./bus.js"

export const HALF = "hess-explorer-half"
// What is told to the other page → what it does.
const HEARD = { time: "follow", turned: "turn" }

export function joinOther() {
  if (window.name !== HALF || window.parent === window) return
  // What is done because the other page has asked for it is not told back.
  let isFollowing = false
  const { origin } = location
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
