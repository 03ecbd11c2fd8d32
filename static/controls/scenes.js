// @ts-check
// The menu of scenes: a dialog with a gallery, all scenes in groups, and a search.  It tells "scene" for a choice and "near" for
// the scene under the mouse or focus, so that its pictures are built in advance.

import { button, element } from "../base/elements.js"
import { tell } from "../base/bus.js"
import { dialogOf, section } from "./dialog.js"
import { showcaseOf } from "./showcase.js"

const REST = 60
const TILE = ".scene, .exhibit"

/** @param {SceneTile} scene @param {boolean} isHere @param {boolean} isFirst @param {(name: string) => void} choose */
function tileOf({ name, title, summary, picture }, isHere, isFirst, choose) {
  const words = element("span.about", ...isFirst ? [element("span.start", "start here")] : [],
    element("span.name", title), element("span.summary", summary))
  /** @type {ReturnType<typeof setTimeout>} */
  let resting = null
  const rest = () => { resting = setTimeout(() => tell("near", name), REST) }
  const leave = () => clearTimeout(resting)
  return button(`scene.param-scene-${name}`, () => choose(name), {
    ariaPressed: isHere, dataset: { scene: name }, innerHTML: `<svg viewBox="0 0 48 32" aria-hidden="true">${picture}</svg>`,
    onpointerenter: rest, onfocus: rest, onpointerleave: leave, onblur: leave,
  }, words)
}

/**
 * Return the tile next to another one in the direction of an arrow key.
 * @param {HTMLElement[]} tiles
 * @param {HTMLElement} tile
 * @param {string} key
 */
function neighbour(tiles, tile, key) {
  const i = tiles.indexOf(tile)
  if (key === "ArrowRight") return tiles[i + 1]
  if (key === "ArrowLeft") return tiles[i - 1]
  const from = tile.getBoundingClientRect()
  const sense = key === "ArrowDown" ? 1 : -1
  const rows = tiles.map((other) => {
    const { top, left } = other.getBoundingClientRect()
    return { other, down: sense * (top - from.top), aside: Math.abs(left - from.left) }
  }).filter(({ down }) => down > 1).sort((one, two) => one.down - two.down || one.aside - two.aside)
  return rows[0]?.other
}

/**
 * Return the dialog and the functions that open it and set the scene on show.
 * @param {SceneTile[]} scenes
 * @param {ShowcaseRow[]} showcase
 */
export function sceneMenu(scenes, showcase) {
  const search = element("input.search", { type: "search", ariaLabel: "Search scenes", placeholder: "Search", oninput: filter })
  const gallery = element("div.showcase")
  const list = element("div.groups")
  const none = element("p.none", { hidden: true, role: "status" }, "No scene matches.")
  const dialog = dialogOf("Scenes", "menu-of-scenes", [search], element("div.scenes", gallery, list), none)

  const tiles = () => /** @type {HTMLElement[]} */ ([...dialog.querySelectorAll(TILE)]).filter((tile) => tile.checkVisibility())
  /** @param {string} name */
  const choose = (name) => {
    tell("scene", name)
    dialog.close()
  }

  function filter() {
    const words = search.value.toLowerCase().split(/\s+/).filter(Boolean)
    for (const group of /** @type {NodeListOf<HTMLElement>} */ (dialog.querySelectorAll("section"))) {
      const own = /** @type {HTMLElement[]} */ ([...group.querySelectorAll(TILE)])
      for (const tile of own) {
        const text = `${group.ariaLabel} ${tile.textContent}`.toLowerCase()
        tile.hidden = !words.every((word) => text.includes(word))
      }
      group.hidden = own.every((tile) => tile.hidden)
    }
    none.hidden = dialog.querySelector("section:not([hidden])") !== null
  }

  dialog.addEventListener("keydown", (event) => {
    /** @type {HTMLElement | null} */
    const tile = /** @type {Element} */ (event.target).closest(TILE)
    if (event.target === search) {
      if (!["Enter", "ArrowDown"].includes(event.key)) return
      const [first] = tiles()
      if (first === undefined) return
      if (event.key === "Enter") first.click()
      else first.focus()
    } else if (tile !== null && event.key.startsWith("Arrow")) {
      const next = neighbour(tiles(), tile, event.key)
      ;(next ?? (event.key === "ArrowUp" ? search : tile)).focus()
    } else return
    event.preventDefault()
  })

  return {
    box: dialog,
    open() {
      gallery.replaceChildren(...showcaseOf(showcase, () => dialog.close()))
      search.value = ""
      filter()
      dialog.showModal()
      tiles().find((tile) => tile.ariaPressed === "true")?.focus()
    },
    /** @param {SceneDescription} scene */
    show({ name }) {
      const base = scenes.find((scene) => scene.name === name)?.origin ?? name
      // Scenes that look into another scene are offered only with that scene.
      const offered = scenes.filter((scene) => scene.origin === null || scene.origin === base)
      list.replaceChildren(...[...new Set(offered.map(({ group }) => group))].map((group) => section(group, group,
        element("div.tiles", ...offered.filter((scene) => scene.group === group)
          .map((scene) => tileOf(scene, scene.name === name, scene === scenes[0], choose))))))
    },
  }
}
