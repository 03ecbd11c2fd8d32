// @ts-check
// The gallery of the menu of scenes: pictures of examples, one row per idea.

import { tell } from "../base/bus.js"
import { button, element } from "../base/elements.js"
import { section } from "./dialog.js"

/**
 * Return the rows of the gallery.
 * @param {ShowcaseRow[]} rows
 * @param {() => void} close called when an example has been chosen
 */
export function showcaseOf(rows, close) {
  const theme = document.documentElement.style.colorScheme === "dark" ? "dark" : "light"
  /** @param {ShowcaseRow["exhibits"][number]} exhibit */
  const exhibitOf = ({ title, query, file }) => button("exhibit", () => {
    tell("restore", query)
    close()
  }, element("img", {
    src: new URL(`../thumbnails/${file}-${theme}.jpg`, import.meta.url).href, alt: "", loading: "lazy", width: 240, height: 240,
  }), element("span", title))
  return rows.map(({ idea, exhibits }) => section(idea, idea, element("div.exhibits", ...exhibits.map(exhibitOf))))
}
