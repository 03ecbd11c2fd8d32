// @ts-check
// The theme of the page: `color-scheme` for its styles, and the colours of its pictures.

import { tell } from "../base/bus.js"
import { setDark } from "../pictures/looks.js"

/** Make the page dark or light. @param {boolean} isDark */
export function setTheme(isDark) {
  document.documentElement.style.colorScheme = isDark ? "dark" : "light"
  setDark(isDark)
  tell("themed")
}
