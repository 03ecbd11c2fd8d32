// @ts-check
// A "drag me" sign beside the main handle of a scene until anything is changed; shown once per scene and browser.

import { listen } from "./bus.js"
import { element } from "./elements.js"
import { browserStore } from "./stores.js"
import { isEmbedded } from "./modes.js"

/** @type {(keyof PageEvents)[]} */
const CHANGES = ["change", "expression", "preset", "reset", "clear", "pick", "restore", "step", "enter"]

// Scenes whose sign was shown.  Without storage, each tab shows a sign once.
const said = new Set(browserStore.get("handles")?.split(","))

/** @param {string} name */
function remember(name) {
  said.add(name)
  browserStore.set("handles", [...said].join(","))
}

/**
 * Show the sign for one kind of handle.
 *
 * `find` gets the handle of a scene that was painted, and returns null for a handle that this part of the page does not have.
 * Otherwise it returns the host element, the position of the sign as CSS properties, and the Bokeh signal at which the
 * position changes.
 * @template {Handle} Kind
 * @param {(handle: Kind) => {host: Element, place: () => object, moved?: BokehSignal} | null} find
 */
export function sayDragMe(find) {
  let end = () => {}
  /** @type {SceneDescription | null} */
  let entered = null
  let isReading = false
  for (const name of CHANGES) listen({ [name]: () => end() })
  listen({
    enter(description) { entered = description },
    // A lesson says what to do, so it needs no sign.
    reading(on) {
      isReading = on
      if (on) end()
    },
    painted() {
      if (entered === null) return
      const { name, handle } = entered
      entered = null
      const found = handle === null || isEmbedded || isReading || said.has(name) ? null : find(/** @type {Kind} */ (handle))
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
