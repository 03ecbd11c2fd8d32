// @ts-check
// The browser's print ("base.css"): in light colours, and with copies of the pictures that are sharper than the screen.

import { gallery } from "../pictures/gallery.js"

// Pixels of a picture: 340 dpi for two pictures side by side.
const SIDE = 1180

/** @param {ReturnType<typeof import("./theme.js").createTheme>} theme */
export function handlePrinting(theme) {
  /** @type {HTMLCanvasElement[]} */
  let sheets = []
  let wasDark = false
  window.addEventListener("beforeprint", () => {
    if (gallery.shown === null) return
    wasDark = theme.isDark()
    theme.setDark(false)
    sheets = gallery.shoot(SIDE)
  })
  window.addEventListener("afterprint", () => {
    for (const sheet of sheets) sheet.remove()
    theme.setDark(wasDark)
  })
}
