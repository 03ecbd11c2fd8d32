// A piece of text that changes often: set as text, never as HTML.

import { listen } from "./bus.js"
import { element } from "./mount.js"

export function render({ key, tag, look, live, el, signal }) {
  const item = element(tag, { className: `text ${look}`, ...(live ? { role: "status" } : {}) })
  const show = (text) => {
    item.textContent = text
    item.hidden = text === ""
  }
  listen("texts", (texts) => { if (key in texts) show(texts[key]) }, signal)
  show("")
  el.append(item)
}
