// A piece of text that changes often: set as text, never as HTML.

import { listen, tell } from "./bus.js"
import { element, lifetime } from "./mount.js"

export function render({ model, view, el }) {
  const signal = lifetime({ model, view })
  const item = element(model.tag, { className: `text ${model.look}`, ...(model.live ? { role: "status" } : {}) })
  const show = (text) => {
    item.textContent = text
    item.hidden = text === ""
  }
  listen("texts", (texts) => { if (model.key in texts) show(texts[model.key]) }, signal)
  show("")
  tell("mounted", { kind: "texts", key: model.key, show })
  el.append(item)
}
