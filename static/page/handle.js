// "drag me" beside the one handle of a scene that matters, until anything is changed: once for each scene in a browser.

import { listen } from "./bus.js"
import { isEmbedded } from "./embedding.js"
import { element } from "./elements.js"

const KEY = "hess-explorer-handles"
const CHANGES = ["change", "expression", "preset", "reset", "clear", "pick", "restore", "step", "enter"]

// The names of the scenes where it was said; where nothing may be kept it is said anew in each tab.
const said = new Set()
try {
  for (const name of localStorage.getItem(KEY)?.split(",") ?? []) said.add(name)
} catch (error) {
  console.info("Nothing can be kept in this browser.", error.message)
}

function remember(name) {
  said.add(name)
  try {
    localStorage.setItem(KEY, [...said].join(","))
  } catch {
    // Nor then.
  }
}

// of(handle of a scene), asked when that is painted → null where it is not of this part of the page, else {host, place(),
// moved}: the words are put over the host, where place() says in CSS, and again at each signal `moved` of Bokeh's.
export function sayDragMe(of) {
  let end = () => {}
  let entered = null
  for (const name of CHANGES) listen({ [name]: () => end() })
  listen({
    enter(description) { entered = description },
    painted() {
      if (entered === null) return
      const { name, handle } = entered
      entered = null
      const found = handle === null || isEmbedded() || said.has(name) ? null : of(handle)
      if (found === null) return
      const { host, place, moved } = found
      const sign = element("span.drag-me", { ariaHidden: true }, "drag me")
      const put = () => { Object.assign(sign.style, place()) }
      put()
      moved?.connect(put)
      host.append(sign)
      end = () => {
        moved?.disconnect(put)
        sign.remove()
      }
      remember(name)
    },
  })
}
