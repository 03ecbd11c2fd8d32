// A piece of text that changes often: set as text, never as HTML.  A paragraph is read out when it changes.

import { listen } from "./bus.js"
import { element } from "./elements.js"

export function render({ key, tag = "p", el }) {
  const item = element(`${tag}.text.${key}`, tag === "p" ? { role: "status" } : {})
  const show = (text) => {
    item.textContent = text
    item.hidden = text === ""
  }
  listen({ texts(texts) { if (key in texts) show(texts[key]) } })
  show("")
  el.append(item)
}
