// @ts-check
// The menu of scenes: a dialog with a picture of each scene, in groups, and a search.  It tells "scene" for a choice and "near"
// for the scene under the mouse or focus, so that its pictures are built in advance.

import { button, element } from "../base/elements.js"
import { listen, tell } from "../base/bus.js"
import { dialogOf, section } from "./dialog.js"

const REST = 60

/** @param {SceneTile} scene @param {boolean} isHere @param {boolean} isFirst @param {(name: string) => void} choose */
function tileOf({ name, title, summary, picture, examples }, isHere, isFirst, choose) {
  const theme = document.documentElement.style.colorScheme === "dark" ? "dark" : "light"
  const image = picture === "" ? element("span.picture") : element("img.picture", {
    src: new URL(`../thumbnails/${picture}-${theme}.jpg`, import.meta.url).href, alt: "", loading: "lazy", width: 320, height: 320,
  })
  /** @type {ReturnType<typeof setTimeout>} */
  let resting = null
  const rest = () => { resting = setTimeout(() => tell("near", name), REST) }
  const leave = () => clearTimeout(resting)
  return button(`scene.param-scene-${name}`, () => choose(name), {
    ariaPressed: isHere, dataset: { scene: name, examples }, onpointerenter: rest, onfocus: rest, onpointerleave: leave, onblur: leave,
  }, image, ...isFirst ? [element("span.start", "start here")] : [], element("span.name", title), element("span.summary", summary))
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
  const { left, width } = tile.getBoundingClientRect()
  const others = key === "ArrowDown" ? tiles.slice(i + 1) : tiles.slice(0, i).reverse()
  return others.find((other) => Math.abs(other.getBoundingClientRect().left - left) < width / 2)
}

/** Return the dialog and the function that opens it. @param {SceneTile[]} scenes */
export function sceneMenu(scenes) {
  let here = ""
  const search = element("input.search", { type: "search", ariaLabel: "Search scenes", placeholder: "Search", oninput: filter })
  const list = element("div.scenes")
  const none = element("p.none", { hidden: true, role: "status" }, "No scene matches.")
  const dialog = dialogOf("Scenes", "menu-of-scenes", [search], list, none)

  const tiles = () => /** @type {HTMLElement[]} */ ([...list.querySelectorAll(".scene")]).filter((tile) => tile.checkVisibility())
  /** @param {string} name */
  const choose = (name) => {
    tell("scene", name)
    dialog.close()
  }

  function fill() {
    const base = scenes.find(({ name }) => name === here)?.origin ?? here
    // Offer a scene that measures another scene only together with that scene.
    const offered = scenes.filter(({ origin }) => origin === null || origin === base)
    list.replaceChildren(...[...new Set(offered.map(({ group }) => group))].map((group) => section(group, group,
      element("div.tiles", ...offered.filter((scene) => scene.group === group)
        .map((scene) => tileOf(scene, scene.name === here, scene === scenes[0], choose))))))
  }

  function filter() {
    const words = search.value.toLowerCase().split(/\s+/).filter(Boolean)
    for (const group of /** @type {NodeListOf<HTMLElement>} */ (list.querySelectorAll("section"))) {
      const own = /** @type {HTMLElement[]} */ ([...group.querySelectorAll(".scene")])
      for (const tile of own) {
        const text = `${group.ariaLabel} ${tile.textContent} ${tile.dataset.examples}`.toLowerCase()
        tile.hidden = !words.every((word) => text.includes(word))
      }
      group.hidden = own.every((tile) => tile.hidden)
    }
    none.hidden = list.querySelector("section:not([hidden])") !== null
  }

  dialog.addEventListener("keydown", (event) => {
    /** @type {HTMLElement | null} */
    const tile = /** @type {Element} */ (event.target).closest(".scene")
    if (event.target === search) {
      if (!["Enter", "ArrowDown"].includes(event.key)) return
      const [first] = tiles()
      if (first === undefined) return
      if (event.key === "Enter") first.click()
      else first.focus()
    } else if (tile !== null && event.key.startsWith("Arrow")) {
      const next = neighbour(tiles(), tile, event.key)
      ;(next ?? (event.key === "ArrowUp" ? search : tile)).focus()
    } else {
      // Typing starts a search: put the letter into the focused search box.
      if (/^\S$/u.test(event.key) && !event.ctrlKey && !event.metaKey && !event.altKey) search.focus()
      return
    }
    event.preventDefault()
  })

  listen({ enter({ name }) { here = name } })
  return {
    dialog,
    open() {
      // The theme may have changed.
      fill()
      search.value = ""
      filter()
      dialog.showModal()
      tiles().find((tile) => tile.ariaPressed === "true")?.focus()
    },
  }
}
