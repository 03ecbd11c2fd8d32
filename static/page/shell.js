// The frame of the page: bar, controls, pictures with the player, text; nothing scrolls but the columns beside the
// pictures.  Where there is no room for both columns they are tabs of one; on a phone the picture stays above, the
// control at hand below, and the text scrolls between them.

import { listen, tell } from "./bus.js"
import { element, lifetime } from "./mount.js"
import { linkTo } from "./embedding.js"
import { isTaken } from "./keys.js"
import { spot, wear } from "./presenting.js"
import { NARROW, PHONE } from "./windows.js"

// The tabs of the two columns: {tab id: column}.
function tabsOf(columns, signal) {
  const list = element("div", { className: "tabs", role: "tablist", "aria-label": "Beside the pictures" })
  const tabs = Object.entries(columns).map(([label, column]) => {
    const tab = element("button", {
      type: "button", className: `tab param-tab-${label.toLowerCase()}`, role: "tab", id: `tab-${column.id}`, textContent: label,
      "aria-controls": column.id,
    })
    tab.addEventListener("click", () => choose(tab))
    return [tab, column]
  })
  const choose = (chosen) => {
    for (const [tab, column] of tabs) {
      const isChosen = tab === chosen
      tab.setAttribute("aria-selected", String(isChosen))
      tab.tabIndex = isChosen ? 0 : -1
      column.classList.toggle("behind", !isChosen)
    }
  }
  list.append(...tabs.map(([tab]) => tab))
  list.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key]
    if (step === undefined) return
    const here = tabs.findIndex(([tab]) => tab === event.target)
    const [next] = tabs[(here + step + tabs.length) % tabs.length]
    choose(next)
    next.focus()
    // Elsewhere they move the time.
    event.preventDefault()
  })
  // Side by side they are no tabs.
  const follow = () => {
    const isTabs = NARROW.matches && !PHONE.matches
    for (const [tab, column] of tabs) {
      column.setAttribute("role", isTabs ? "tabpanel" : "region")
      if (isTabs) {
        column.setAttribute("aria-labelledby", tab.id)
        column.removeAttribute("aria-label")
      } else {
        column.setAttribute("aria-label", tab.textContent)
        column.removeAttribute("aria-labelledby")
      }
    }
  }
  for (const query of [NARROW, PHONE]) query.addEventListener("change", follow, { signal })
  choose(tabs[0][0])
  follow()
  return list
}

// Of an embedded page: the way to all of it.
function opener() {
  const link = element("a", { className: "opener", target: "_blank", rel: "noopener", textContent: "Open in Hess Explorer", href: "." })
  // The state on show when it is used.
  for (const event of ["pointerdown", "focus", "click"]) {
    link.addEventListener(event, () => {
      tell("address")
      link.href = linkTo()
    })
  }
  return link
}

// The sentence on what moves what: over the stage; on a phone it scrolls with the text.
function sayWhatMoves(stage, reading, signal) {
  const sentence = element("p", { className: "text moves" })
  const enter = ({ moves }) => { sentence.textContent = moves }
  const place = () => {
    if (PHONE.matches) reading.prepend(sentence)
    else stage.before(sentence)
  }
  listen("enter", enter, signal)
  tell("mounted", { kind: "scene", show: enter })
  PHONE.addEventListener("change", place, { signal })
  place()
}

export function render({ model, view, el }) {
  const signal = lifetime({ model, view })
  const children = (...names) => names.map((name) => model.get_child(name))
  const box = (className, ...names) => element("div", { className }, ...children(...names))
  const controls = element("section", { className: "controls column", id: "controls" }, ...children("controls", "derived"))
  const text = element("section", { className: "reader column", id: "text" },
    box("reading", "lessons", "words"), box("signs", "legend"))
  // What scrolls is reached by keys.
  for (const column of [controls, ...text.children]) column.tabIndex = 0
  const stage = box("stage", "pictures", "player")
  el.classList.add("frame")
  el.append(
    element("header", { className: "bar" }, ...children("bar"), box("news", "busy", "progress")),
    tabsOf({ Controls: controls, Text: text }, signal), controls,
    stage, text, box("foot", "notes", "status"), box("unseen", "ready"), opener(), spot(signal))
  sayWhatMoves(stage, text.firstChild, signal)
  wear(el, signal)
  listen("reading", (on) => el.classList.toggle("in-lesson", on), signal)
  document.addEventListener("keydown", (event) => {
    const wish = { f: "fullscreen", p: "present" }[event.key.toLowerCase()]
    if (isTaken(event) || wish === undefined) return
    event.preventDefault()
    tell(wish)
  }, { signal })
}
