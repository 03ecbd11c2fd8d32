// @ts-check
// Access to Panel's page: its theme, and whether it is ready.

import { isDark } from "../pictures/looks.js"

/**
 * Return the functions that read and change Panel's page.
 * @param {PanelView} view
 */
export function createPage(view) {
  const bokeh = () => view.model.document
  const page = () => bokeh().roots().find((/** @type {any} */ top) => top.data?.attributes.dark_theme !== undefined).data
  const nextFrame = () => new Promise(requestAnimationFrame)
  return {
    isDark: () => page().dark_theme,
    /** @param {boolean} isDark */
    setDark(isDark) { page().dark_theme = isDark },
    /** Wait until Panel has rendered everything. */
    async standing() {
      while (bokeh() == null || !bokeh().is_idle) await nextFrame()
    },
    /** Wait until the page has the colours of its theme, which Panel draws some frames after `setDark`. */
    async themed() {
      while (isDark(getComputedStyle(document.body).color) !== page().dark_theme) await nextFrame()
    },
    /** @param {() => void} hear */
    onThemeChange(hear) {
      bokeh().on_change((/** @type {{attr: string}} */ event) => { if (event.attr === "dark_theme") hear() })
    },
  }
}
