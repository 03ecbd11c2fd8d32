// The menu of scenes, by their pictures.  Tells "scene" of a choice, and "near" of what the mouse or the keyboard rests
// on: its pictures are built before they are asked for.

import { listen, tell } from "../page/bus.js"
import { element, lifetime } from "../page/mount.js"

const REST = 60
const SVG = "http://www.w3.org/2000/svg"

function button({ name, title, summary, picture }, pressed) {
  const svg = document.createElementNS(SVG, "svg")
  svg.setAttribute("viewBox", "0 0 48 32")
  svg.setAttribute("aria-hidden", "true")
  svg.innerHTML = picture
  const item = element("button", {
    type: "button", className: `scene param-scene-${name}`, title: summary, "aria-pressed": String(pressed),
  }, svg, element("span", { textContent: title }))
  item.dataset.scene = name
  item.addEventListener("click", () => tell("scene", name))
  let resting = null
  for (const event of ["pointerenter", "focus"]) {
    item.addEventListener(event, () => { resting = setTimeout(tell, REST, "near", name) })
  }
  for (const event of ["pointerleave", "blur"]) item.addEventListener(event, () => clearTimeout(resting))
  return item
}

export function render({ model, view, el }) {
  const signal = lifetime({ model, view })
  const bar = element("div", { className: "scenes", role: "group", "aria-label": "Scene" })
  el.append(bar)

  function show({ name }) {
    const here = model.scenes.find((scene) => scene.name === name)
    const base = here?.origin ?? name
    // Of what looks into another scene only that of the scene on show is offered.
    const offered = model.scenes.filter((scene) => scene.origin === null || scene.origin === base)
    const focused = bar.getRootNode().activeElement?.dataset.scene
    bar.replaceChildren(...offered.map((scene) => button(scene, scene.name === name)))
    const pressed = bar.querySelector('[aria-pressed="true"]')
    if (pressed !== null) bar.scrollTop = pressed.offsetTop - bar.clientHeight / 2
    if (focused !== undefined) bar.querySelector(`[data-scene="${focused}"]`)?.focus()
  }
  listen("enter", show, signal)
  tell("mounted", { kind: "scene", show })
}
