// @ts-check
// Mounts the parts of the page.

import { element } from "../base/elements.js"
import { sized, wear } from "../base/modes.js"

// Style sheets of the frame around the parts.
export const FRAME = ["base/base.css", "page/shell.css"]
// Style sheets of each part, after "base/base.css".
/** @type {Record<string, string[]>} */
const SHEETS = {
  bar: ["controls/dialog.css", "controls/bar.css"],
  controls: ["controls/dialog.css", "controls/controls.css"],
  pictures: ["pictures/pictures.css"],
  player: ["controls/controls.css", "controls/player.css"],
  lessons: ["controls/controls.css", "page/page.css", "page/lessons.css"],
}

/** Return style sheets as elements. @param {Record<string, string>} sheets path → style sheet @param {string[]} paths */
export const stylesOf = (sheets, paths) => paths.map((path) => element("style", sized(sheets[path])))

/**
 * Return a function that mounts parts of the page, each in a shadow root with its own style sheets.
 * @param {Record<string, string>} sheets path → style sheet
 */
export const createMount = (sheets) => (
  /**
   * Mount a part and return its host.
   * @param {string} name
   * @param {(properties: any) => void} render
   * @param {object} properties
   * @param {HTMLElement} host gets the shadow root
   */
  (name, render, properties = {}, host = element("div")) => {
    const el = element(`div.${name}`)
    wear(el)
    host.attachShadow({ mode: "open" }).append(
      ...stylesOf(sheets, ["base/base.css", ...(SHEETS[name] ?? ["page/page.css"])]), el)
    render({ ...properties, el })
    return host
  })
