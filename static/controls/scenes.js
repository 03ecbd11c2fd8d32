// The menu of scenes: a dialog over the page, by their pictures, in groups, with a search.  Tells "scene" of a choice,
// and "near" of what the mouse or the keyboard rests on: its pictures are built before they are asked for.

import { button, element } from "../page/elements.js"
import { tell } from "../page/bus.js"
import { dialogOf, section } from "./dialog.js"

const REST = 60

function tileOf({ name, title, summary, picture }, isHere, isFirst, choose) {
  const words = element("span.about", ...isFirst ? [element("span.start", "start here")] : [],
    element("span.name", title), element("span.summary", summary))
  let resting = null
  const rest = () => { resting = setTimeout(tell, REST, "near", name) }
  const leave = () => clearTimeout(resting)
  return button(`scene.param-scene-${name}`, () => choose(name), {
    ariaPressed: isHere, dataset: { scene: name }, innerHTML: `<svg viewBox="0 0 48 32" aria-hidden="true">${picture}</svg>`,
    onpointerenter: rest, onfocus: rest, onpointerleave: leave, onblur: leave,
  }, words)
}

// The tile next to this one in the direction of an arrow key.
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
 * Return {dialog, open(), show(name of the scene on show)}.
 * @param {{name: string, title: string, summary: string, picture: string, origin: string | null, group: string}[]} scenes
 */
export function sceneMenu(scenes) {
  const search = element("input.search", { type: "search", ariaLabel: "Search scenes", placeholder: "Search", oninput: filter })
  const list = element("div.scenes")
  const none = element("p.none", { hidden: true, role: "status" }, "No scene has these words.")
  const dialog = dialogOf("Scenes", "menu-of-scenes", [search], list, none)

  const tiles = () => [...list.querySelectorAll(".scene")].filter((tile) => tile.checkVisibility())
  const choose = (name) => {
    tell("scene", name)
    dialog.close()
  }

  function filter() {
    const words = search.value.toLowerCase().split(/\s+/).filter(Boolean)
    for (const group of list.children) {
      for (const tile of group.querySelectorAll(".scene")) {
        const text = `${group.ariaLabel} ${tile.textContent}`.toLowerCase()
        tile.hidden = !words.every((word) => text.includes(word))
      }
      group.hidden = group.querySelector(".scene:not([hidden])") === null
    }
    none.hidden = list.querySelector(".scene:not([hidden])") !== null
  }

  dialog.addEventListener("keydown", (event) => {
    const tile = event.target.closest(".scene")
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
    dialog,
    open() {
      search.value = ""
      filter()
      dialog.showModal()
      list.querySelector('[aria-pressed="true"]')?.focus()
    },
    show(name) {
      const base = scenes.find((scene) => scene.name === name)?.origin ?? name
      // Of what looks into another scene only that of the scene on show is offered.
      const offered = scenes.filter((scene) => scene.origin === null || scene.origin === base)
      list.replaceChildren(...[...new Set(offered.map(({ group }) => group))].map((group) => section(group, group,
        element("div.tiles", ...offered.filter((scene) => scene.group === group)
          .map((scene) => tileOf(scene, scene.name === name, scene === scenes[0], choose))))))
    },
  }
}
