// The controls of the scene on show: a slider and a box for each number, a menu for each choice, one of examples, and
// Reset, Undo, Clear, Copy link.  What the server says of all values comes by "controls": {name: [value, low, high,
// step, whether it is disabled] or option}.

import { listen, tell } from "../page/bus.js"
import { element, lifetime } from "../page/mount.js"
import { menu } from "./menu.js"
import { number } from "./number.js"

function choice({ name, label, options, help }) {
  const plain = options.map((option) => [option, option])
  const [frame, show] = menu(name, label, plain, help, (option) => tell("change", { [name]: option }))
  return [element("div", {}, frame, element("p", { className: "text help", textContent: help })), show]
}

function button(name, label, title, press) {
  const item = element("button", { type: "button", className: `button param-${name}`, textContent: label, title })
  item.addEventListener("click", press)
  return item
}

export function render({ model, view, el }) {
  const signal = lifetime({ model, view })
  const column = element("div", { className: "column" })
  el.append(column)
  let shows = {}

  const build = (scene) => {
    const [examples, showExample] = menu("preset", "Example",
      [["Choose an example…", ""], ...scene.presets.map((name) => [name, name])],
      "States to begin with", (name) => { if (name !== "") tell("preset", name) })
    shows = { preset: showExample }
    const items = scene.controls.map((control) => {
      const [item, show] = control.kind === "number" ? number(control) : choice(control)
      shows[control.name] = show
      return item
    })
    column.replaceChildren(examples, ...items, element("div", { className: "buttons" },
      button("reset", "Reset", "Back to the first state of this scene", () => tell("reset")),
      ...(scene.drawn ? [
        button("undo", "Undo", "Take back the last click or box in a picture", () => tell("undo")),
        button("clear", "Clear", "Without all clicks and boxes", () => tell("clear"))] : []),
      button("link", "Copy link", "A link to all that is on the screen", () => tell("link"))))
  }
  const show = (values) => {
    for (const [name, value] of Object.entries(values)) shows[name]?.(value)
  }
  listen("enter", build, signal)
  listen("controls", show, signal)
  tell("mounted", { kind: "scene", show: build })
  tell("mounted", { kind: "controls", show })
}
