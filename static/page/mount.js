// How the parts of the page are mounted.

import { element } from "./elements.js"
import { wear } from "./presenting.js"

// Which style sheets each part has besides "page/base.css".
const SHEETS = {
  bar: ["controls/dialog.css", "controls/bar.css"],
  controls: ["controls/dialog.css", "controls/controls.css"],
  pictures: ["pictures/pictures.css"],
  player: ["controls/controls.css", "controls/player.css"],
  lessons: ["page/page.css", "page/lessons.css"],
}

/**
 * Return what mounts parts of the page, each in a shadow of its own, where its styles are its alone.
 * @param {Record<string, string>} sheets path → style sheet
 */
export const createMount = (sheets) => (name, render, properties = {}, host = element("div")) => {
  const el = element(`div.${name}`)
  wear(el)
  host.attachShadow({ mode: "open" }).append(
    ...["page/base.css", ...(SHEETS[name] ?? ["page/page.css"])].map((path) => element("style", sheets[path])), el)
  render({ ...properties, el })
  return host
}
