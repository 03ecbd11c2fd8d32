// @ts-check
// One state in one file that works without a server ("offline.py" writes it): pictures and player with their data.
// Controls are disabled.

import { render as renderPlayer } from "../controls/player.js"
import { gallery, render as renderPictures } from "../pictures/gallery.js"
import { listen, tell } from "./bus.js"
import { element } from "./elements.js"
import { createMount } from "./mount.js"
import { fill, paint } from "./painting.js"
import { render as renderProse } from "./prose.js"
import { render as renderStatus } from "./status.js"
import { render as renderText } from "./text.js"

/** @param {string} id */
const place = (id) => document.getElementById(id)

/**
 * Return a disabled control that shows a value.
 * @param {ControlDescription} control
 * @param {ControlValue} shown
 */
function controlOf({ name, label }, shown) {
  if (typeof shown === "string") return element("label", `${label} `, element("select", new Option(shown)))
  const [value, min, max, step] = shown
  const slider = element(`input.param-${name}`, { type: "range", min, max, step: step || "any", value })
  const number = String(Number(value.toPrecision(6))).replace("-", "−")
  return element("label", `${label} `, slider, element("output", number))
}

async function start() {
  /** @type {{description: SceneDescription, tree: Tree, client: ClientKeys, sheets: Record<string, string>}} */
  const { description, tree, client, sheets } = JSON.parse(place("state").textContent)
  const block = Uint8Array.from(atob(place("block").textContent), (letter) => letter.charCodeAt(0)).buffer
  listen({ "ask-client": (hear) => hear(client) })
  const mount = createMount(sheets)
  mount("pictures", renderPictures, {}, place("pictures"))
  mount("player", renderPlayer, {}, place("player"))
  for (const part of ["legend", "words"]) mount("prose", renderProse, { part }, place(part))
  for (const key of ["derived", "notes"]) mount("text", renderText, { key, tag: "div" }, place(key))
  mount("status", renderStatus, {}, place("status"))
  place("controls").append(...description.controls.filter(({ name }) => name in tree.controls)
    .map((control) => controlOf(control, tree.controls[control.name])))
  tell("client", client)
  const scene = await gallery.build(description)
  gallery.enter(description.name)
  tell("enter", description)
  await paint(scene.plots, () => {
    fill(scene, tree, block)
    tell("texts", tree.texts)
    tell("captions", tree.captions)
  })
  tell("painted")
  document.documentElement.dataset.ready = "true"
}

start()
