// The menu of scenes: a dialog over the page, by their pictures, in groups, with a search.  Tells "scene" of a choice,
// and "near" of what the mouse or the keyboard rests on: its pictures are built before they are asked for.

import { tell } from "../page/bus.js"
import { element } from "../page/mount.js"
import { dialogOf } from "./dialog.js"

const REST = 60
const SVG = "http://www.w3.org/2000/svg"

function drawing(picture) {
  const svg = document.createElementNS(SVG, "svg")
  svg.setAttribute("viewBox", "0 0 48 32")
  svg.setAttribute("aria-hidden", "true")
  svg.innerHTML = picture
  return svg
}

function tileOf({ name, title, summary, picture }, isHere, isFirst) {
  const words = element("span", { className: "about" },
    element("span", { className: "name", textContent: title }), element("span", { className: "summary", textContent: summary }))
  if (isFirst) words.prepend(element("span", { className: "start", textContent: "start here" }))
  const tile = element("button", {
    type: "button", className: `scene param-scene-${name}`, "aria-pressed": String(isHere),
  }, drawing(picture), words)
  tile.dataset.scene = name
  let resting = null
  for (const event of ["pointerenter", "focus"]) {
    tile.addEventListener(event, () => { resting = setTimeout(tell, REST, "near", name) })
  }
  for (const event of ["pointerleave", "blur"]) tile.addEventListener(event, () => clearTimeout(resting))
  return tile
}

// The tile next to this one in the direction of an arrow key.
function neighbour(tiles, tile, key) {
  const i = tiles.indexOf(tile)
  if (key === "ArrowRight") return tiles[i + 1]
  if (key === "ArrowLeft") return tiles[i - 1]
  const from = tile.getBoundingClientRect()
  const down = key === "ArrowDown"
  const rows = tiles.map((other) => [other, other.getBoundingClientRect()])
    .filter(([, { top }]) => (down ? top > from.top + 1 : top < from.top - 1))
    .sort(([, one], [, other]) => (
      (down ? one.top - other.top : other.top - one.top) || Math.abs(one.left - from.left) - Math.abs(other.left - from.left)))
  return rows[0]?.[0]
}

// scenes: {name, title, summary, picture, origin, group} of each.  {dialog, open(), show(name of the scene on show)}.
export function sceneMenu(scenes) {
  const search = element("input", { type: "search", className: "search", "aria-label": "Search scenes", placeholder: "Search" })
  const list = element("div", { className: "scenes" })
  const none = element("p", { className: "none", textContent: "No scene has these words.", hidden: true, role: "status" })
  const dialog = dialogOf("Scenes", "menu-of-scenes", [search], list, none)

  const tiles = () => [...list.querySelectorAll(".scene")].filter((tile) => tile.checkVisibility())
  const choose = (tile) => {
    tell("scene", tile.dataset.scene)
    dialog.close()
  }

  function filter() {
    const words = search.value.toLowerCase().split(/\s+/).filter(Boolean)
    for (const group of list.children) {
      for (const tile of group.querySelectorAll(".scene")) {
        const text = `${group.dataset.group} ${tile.textContent}`.toLowerCase()
        tile.hidden = !words.every((word) => text.includes(word))
      }
      group.hidden = group.querySelector(".scene:not([hidden])") === null
    }
    none.hidden = list.querySelector(".scene:not([hidden])") !== null
  }

  search.addEventListener("input", filter)
  list.addEventListener("click", ({ target }) => {
    const tile = target.closest(".scene")
    if (tile !== null) choose(tile)
  })
  dialog.addEventListener("keydown", (event) => {
    const tile = event.target.closest(".scene")
    if (event.target === search) {
      if (!["Enter", "ArrowDown"].includes(event.key)) return
      const [first] = tiles()
      if (first === undefined) return
      if (event.key === "Enter") choose(first)
      else first.focus()
    } else if (tile !== null && event.key.startsWith("Arrow")) {
      const next = neighbour(tiles(), tile, event.key)
      ;(next ?? (event.key === "ArrowUp" ? search : tile)).focus()
    } else return
    event.preventDefault()
  })

  return {
    dialog,
    open() {
      search.value = ""
      filter()
      dialog.showModal()
      const here = list.querySelector('[aria-pressed="true"]')
      here?.focus()
    },
    show(name) {
      const base = scenes.find((scene) => scene.name === name)?.origin ?? name
      // Of what looks into another scene only that of the scene on show is offered.
      const offered = scenes.filter((scene) => scene.origin === null || scene.origin === base)
      list.replaceChildren(...[...new Set(offered.map(({ group }) => group))].map((group) => {
        const part = element("section", { "aria-label": group }, element("h3", { textContent: group }),
          element("div", { className: "tiles" }, ...offered.filter((scene) => scene.group === group)
            .map((scene) => tileOf(scene, scene.name === name, scene === scenes[0]))))
        part.dataset.group = group
        return part
      }))
    },
  }
}
