// @ts-check
// How much of a scene's text is shown: the idea, what a student needs, or all that the paper has.  Kept in the browser.

import { element } from "../base/elements.js"
import { browserStore } from "../base/stores.js"

/** @type {[value: string, text: string][]} */
const DEPTHS = [["idea", "Idea"], ["student", "What you see"], ["paper", "With equations"]]
const ALL = "paper"

/**
 * Return the menu of depths, and the function that hides what is deeper in a new text.
 * @param {HTMLElement} text its first section is what one sees, its first paragraph the idea
 */
export function depthMenu(text) {
  const select = element("select", {
    ariaLabel: "Depth of the text", title: "How much of the text is shown, in every scene",
    onchange: () => {
      browserStore.set("depth", select.value)
      follow()
    },
  }, ...DEPTHS.map(([value, words]) => new Option(words, value)))
  select.value = DEPTHS.find(([value]) => value === browserStore.get("depth"))?.[0] ?? ALL

  function follow() {
    const parts = /** @type {HTMLElement[]} */ ([...text.children])
    const headings = parts.filter(({ tagName }) => tagName === "H2" || tagName === "H3")
    const idea = [headings[0], parts.find(({ tagName }) => tagName === "P")]
    const second = parts.indexOf(headings[1])
    parts.forEach((part, i) => {
      part.hidden = select.value === "idea" ? !idea.includes(part) : select.value === "student" && second >= 0 && i >= second
    })
  }

  return { menu: element("label.depth", select), follow }
}
