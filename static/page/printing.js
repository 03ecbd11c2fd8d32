// @ts-check
// The browser's print ("base.css"): in light colours, and with copies of the pictures that are sharper than the screen.

import { gallery } from "../pictures/gallery.js"
import { onDark } from "../pictures/looks.js"
import { setTheme } from "./theme.js"

// Pixels of a picture: 340 dpi for two pictures side by side.
const SIDE = 1180

/** Give the browser light pictures to print. */
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
