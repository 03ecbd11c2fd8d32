// HTML of the scene on show, from the project's own files: its legend or its words.

import { listen, tell } from "./bus.js"
import { element, lifetime } from "./mount.js"

export function render({ model, view, el }) {
  const signal = lifetime({ model, view })
  const item = element("div", { className: model.part })
  const show = (scene) => { item.innerHTML = scene[model.part] }
  // A formula or a table that scrolls by itself is reached by the keyboard.
  const resize = new ResizeObserver(() => {
    for (const wide of item.querySelectorAll('math[display="block"], table')) {
      wide.tabIndex = wide.scrollWidth > wide.clientWidth ? 0 : -1
    }
  })
  resize.observe(item)
  signal.addEventListener("abort", () => resize.disconnect())
  listen("enter", show, signal)
  // Of the legend, only what is there.
  const showSigns = (said) => {
    const there = new Set(said.split(","))
    for (const [i, entry] of item.querySelectorAll(".legend li").entries()) entry.hidden = !there.has(String(i))
  }
  if (model.part === "legend") {
    listen("texts", ({ signs }) => { if (signs !== undefined) showSigns(signs) }, signal)
    tell("mounted", { kind: "texts", key: "signs", show: showSigns })
  }
  // A lesson has the place of the words.
  if (model.part === "words") listen("reading", (on) => { item.hidden = on }, signal)
  tell("mounted", { kind: "scene", show })
  el.append(item)
}
