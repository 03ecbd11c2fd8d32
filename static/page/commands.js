// @ts-check
// Commands that concern the page and not the state: address, theme, full screen, present mode.

import { listen, tell } from "../base/bus.js"
import { isPresenting, present } from "../base/presenting.js"
import { onDark } from "../pictures/looks.js"
import { setTheme } from "./theme.js"

/**
 * Carry out the commands that the page tells.
 * @param {ReturnType<typeof import("./address.js").createAddress>} address
 */
export function handleCommands(address) {
  listen({
    address: address.writeNow,
    theme() {
      setTheme(!onDark())
      tell("url", { theme: onDark() ? "dark" : "light" })
    },
    present() {
      present(!isPresenting())
      tell("url", { present: isPresenting() ? "1" : "" })
    },
    fullscreen() {
      if (document.fullscreenElement === null) document.documentElement.requestFullscreen().catch(console.warn)
      else document.exitFullscreen()
    },
  })
}
