// @ts-check
// Commands that concern the page and not the state: address, theme, full screen, present mode, and the browser's print.

import { listen, tell } from "../base/bus.js"
import { isPresenting, present } from "../base/modes.js"
import { gallery } from "../pictures/gallery.js"
import { onDark, setDark } from "../pictures/looks.js"

// Pixels of a printed picture: 340 dpi for two pictures side by side.
const SIDE = 1180

/** Make the page dark or light: `color-scheme` for its styles, and the colours of its pictures. @param {boolean} isDark */
export function setTheme(isDark) {
  document.documentElement.style.colorScheme = isDark ? "dark" : "light"
  setDark(isDark)
  tell("themed")
}

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

/** Give the browser pictures to print ("base.css"): in light colours, and sharper than those on the screen. */
export function handlePrinting() {
  /** @type {HTMLCanvasElement[]} */
  let sheets = []
  let wasDark = false
  window.addEventListener("beforeprint", () => {
    if (gallery.shown === null) return
    wasDark = onDark()
    setTheme(false)
    sheets = gallery.shoot(SIDE)
  })
  window.addEventListener("afterprint", () => {
    for (const sheet of sheets) sheet.remove()
    setTheme(wasDark)
  })
}
