// The frame of the page: bar, controls, pictures with the player, text; nothing scrolls but the columns beside the
// pictures.  Where there is no room for both columns they are tabs of one; on a phone the picture stays above, the
// control at hand below, and the text scrolls between them.

import { render as renderBar } from "../controls/bar.js"
import { render as renderControls } from "../controls/controls.js"
import { render as renderPlayer } from "../controls/player.js"
import { render as renderPictures } from "../pictures/gallery.js"
import { listen, tell } from "./bus.js"
import { startClient } from "./client.js"
import { linkTo } from "./embedding.js"
import { onKeys } from "./keys.js"
import { render as renderLessons } from "./lessons.js"
import { createMount, element } from "./mount.js"
import { spot, wear } from "./presenting.js"
import { render as renderProgress } from "./progress.js"
import { render as renderProse } from "./prose.js"
import { render as renderStatus } from "./status.js"
import { render as renderText } from "./text.js"
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
  const place = () => {
    if (PHONE.matches) reading.prepend(sentence)
    else stage.before(sentence)
  }
  listen("enter", ({ moves }) => { sentence.textContent = moves }, signal)
  PHONE.addEventListener("change", place, { signal })
  place()
}

let controller = null

// Called by Panel; what was rendered before goes.
export function render({ model, view, el }) {
  controller?.abort()
  controller = new AbortController()
  const { signal } = controller
  const mount = createMount(model.sheets, signal)
  const text = (key, look, tag = "p") => mount("text", renderText, { key, look, tag, live: tag === "p" })
  const box = (className, ...parts) => element("div", { className }, ...parts)
  const controls = element("section", { className: "controls column", id: "controls" },
    mount("controls", renderControls), text("derived", "derived", "div"))
  const reader = element("section", { className: "reader column", id: "text" },
    box("reading", mount("lessons", renderLessons, { index: model.lessons }), mount("prose", renderProse, { part: "words" })),
    box("signs", mount("prose", renderProse, { part: "legend" })))
  // What scrolls is reached by keys.
  for (const column of [controls, ...reader.children]) column.tabIndex = 0
  const stage = box("stage", mount("pictures", renderPictures), mount("player", renderPlayer))
  const { scenes, files, palettes } = model
  el.classList.add("frame")
  el.append(
    element("header", { className: "bar" }, mount("bar", renderBar, { scenes, files, palettes }),
      box("news", text("busy", "busy"), mount("progress", renderProgress))),
    tabsOf({ Controls: controls, Text: reader }, signal), controls, stage, reader,
    box("foot", text("notes", "notes"), mount("status", renderStatus, {}, box("status-line"))), opener(), spot(signal))
  sayWhatMoves(stage, reader.firstChild, signal)
  wear(el, signal)
  listen("reading", (on) => el.classList.toggle("in-lesson", on), signal)
  onKeys({ f: () => tell("fullscreen"), p: () => tell("present") }, signal)
  startClient(model, view, signal)
}
