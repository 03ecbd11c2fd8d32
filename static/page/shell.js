// @ts-check
// The frame of the page: bar, controls, pictures with the player, text.  Only the columns beside the pictures scroll.  In a
// narrow window the columns are tabs of one column; on a phone the picture stays at the top and one control at the bottom,
// and the text scrolls between them.

import { render as renderControls } from "../controls/controls.js"
import { render as renderPlayer } from "../controls/player.js"
import { render as renderPictures } from "../pictures/gallery.js"
import { announcer } from "./announce.js"
import { listen, tell } from "../base/bus.js"
import { startClient } from "./client.js"
import { linkTo } from "../base/embedding.js"
import { button, element, update } from "../base/elements.js"
import { arrowOf, onKeys } from "../base/keys.js"
import { render as renderLessons } from "./lessons.js"
import { renderProgress, renderStatus, renderText } from "./lines.js"
import { NARROW, PHONE, ROOMY, wear } from "../base/modes.js"
import { drawer, spot } from "./present_tools.js"
import { render as renderProse } from "./prose.js"
import { browserStore } from "../base/stores.js"

/** Return the tabs of the columns. @param {Record<string, HTMLElement>} columns label → column */
function tabsOf(columns) {
  const tabs = Object.entries(columns).map(([label, column]) => {
    const tab = button(`tab.param-tab-${label.toLowerCase()}`, () => choose(tab), { role: "tab" }, label)
    tab.setAttribute("aria-controls", column.id)
    column.ariaLabel = label
    return [tab, column]
  })
  /** @param {HTMLElement} chosen */
  const choose = (chosen) => {
    for (const [tab, column] of tabs) {
      const isChosen = tab === chosen
      tab.ariaSelected = String(isChosen)
      tab.tabIndex = isChosen ? 0 : -1
      column.classList.toggle("behind", !isChosen)
    }
  }
  /** @param {KeyboardEvent} event */
  const onkeydown = (event) => {
    const [across] = arrowOf(event) ?? [0]
    if (across === 0) return
    const here = tabs.findIndex(([tab]) => tab === event.target)
    const [next] = tabs[(here + across + tabs.length) % tabs.length]
    choose(next)
    next.focus()
    // Prevent the default, because elsewhere arrow keys move the time.
    event.preventDefault()
  }
  // Columns side by side are not tabs.
  const follow = () => {
    for (const [, column] of tabs) column.role = NARROW.matches && !PHONE.matches ? "tabpanel" : "region"
  }
  for (const query of [NARROW, PHONE]) query.addEventListener("change", follow)
  choose(tabs[0][0])
  follow()
  listen({
    // The text of a lesson, at its start.
    reading(on) { if (on) choose(tabs[1][0]) },
    // Pictures that are shown alone leave the columns as the page opens with them.
    alone(names) { if (names.length > 0) choose(tabs[0][0]) },
  })
  return element("div.tabs", { role: "tablist", ariaLabel: "Beside the pictures", onkeydown }, ...tabs.map(([tab]) => tab))
}

/** Return a link, seen when it has the focus, that moves the focus. @param {HTMLElement} to */
const skipTo = (to) => button("skip", () => to.focus(), "Skip to the controls")

/** Return content that unfolds. @param {string} label @param {HTMLElement[]} content */
const folding = (label, ...content) => element("details", element("summary", label), ...content)

/** Return a link to the state on show, in the explorer. @param {`a.${string}`} name its classes @param {string} label */
export function opener(name, label) {
  const link = element(name, { target: "_blank", rel: "noopener", href: "." }, label)
  // Update the link when it is used, so that it leads to the current state.
  for (const event of ["pointerdown", "focus", "click"]) {
    link.addEventListener(event, () => {
      tell("address")
      link.href = linkTo()
    })
  }
  return link
}

/**
 * Return the line above the pictures: a sentence on the state on show, and what unfolds beside it.
 * @param {HTMLElement} el the frame of the page
 */
function answerLine(el) {
  const answer = element("p.text.says", { role: "status" })
  /** @param {string} name @param {string} key @param {string} title @param {boolean} isOpen */
  const toggle = (name, key, title, isOpen) => {
    const item = button(`fold.param-${name}`, () => turn(item.ariaExpanded !== "true"), { title: `${title} (${key})` }, name[0].toUpperCase() + name.slice(1))
    /** @param {boolean} on */
    const show = (on) => {
      item.ariaExpanded = String(on)
      el.classList.toggle(`with-${name}`, on)
      tell("unfolding", { name, on })
    }
    /** @param {boolean} on */
    const turn = (on) => {
      browserStore.set(name, on ? "1" : "0")
      show(on)
    }
    const kept = browserStore.get(name)
    show(kept === null ? isOpen : kept === "1")
    onKeys({ [key.toLowerCase()]: () => item.checkVisibility() && item.click() })
    return item
  }
  listen({ texts({ answer: text }) { if (text !== undefined) update(answer, { textContent: text, title: text }) } })
  return element("div.says-line", answer,
    toggle("details", "D", "Numbers above the pictures", false), toggle("text", "T", "Text, legend and lessons", ROOMY.matches))
}

/**
 * Return the sentences about the motion, above the stage; on a phone in the text.
 * @param {HTMLElement} el the frame of the page
 * @param {HTMLElement} stage
 * @param {HTMLElement} reading
 */
function sentencesAbove(el, stage, reading) {
  const line = answerLine(el)
  const sentence = element("p.text.moves", { role: "region", ariaLabel: "Hint, or last change" })
  const place = () => {
    if (PHONE.matches) reading.prepend(line, sentence)
    else stage.before(line, sentence)
  }
  PHONE.addEventListener("change", place)
  place()
  return sentence
}

/**
 * Build the page and start its client, which is returned.
 * @param {Pick<PageModel, "client" | "lesson">} model
 * @param {Host} host answers the requests of the page
 * @param {{mount: ReturnType<typeof import("./mount.js").createMount>, bar: HTMLElement[], lessons: object, styles: HTMLElement[]}} parts the content
 *   of the bar, the properties of the lessons, and the style sheets of the frame
 * @param {HTMLElement} el
 */
export function buildPage(model, host, { mount, bar, lessons, styles }, el) {
  /** @param {string} key @param {string} [tag] */
  const text = (key, tag) => mount("text", renderText, { key, tag })
  const numbers = folding("Derived numbers", text("derived", "div"), text("fixed", "div"))
  // Hide these numbers until the controls appear, because they would move down then.
  numbers.hidden = true
  const controls = element("section.controls.column", { id: "controls" }, mount("controls", renderControls), numbers)
  const reader = element("section.reader.column", { id: "text" },
    element("div.reading", mount("lessons", renderLessons, lessons), mount("prose", renderProse, { part: "words" })),
    Object.assign(folding("Legend", mount("prose", renderProse, { part: "legend" })), { className: "signs", ariaLabel: "Legend" }))
  // Make scrolling columns reachable with the keyboard.
  const [reading, signs] = /** @type {Iterable<HTMLElement>} */ (reader.children)
  for (const column of [controls, reading, signs]) column.tabIndex = 0
  Object.assign(reading, { role: "region", ariaLabel: "What you see" })
  const stage = element("main.stage", mount("pictures", renderPictures),
    element("div.below", mount("player", renderPlayer), mount("progress", renderProgress)))
  el.classList.add("frame")
  el.append(
    ...styles, skipTo(controls), element("header.bar", ...bar, element("div.news", text("busy"))),
    stage, element("aside.side", { ariaLabel: "Controls and text" }, tabsOf({ Controls: controls, Text: reader }), controls, reader,
      opener("a.opener", "Open in Hess Explorer")),
    element("div.foot", text("notes"), mount("status", renderStatus, {}, element("div.status-line"))), drawer(el), spot())
  el.append(announcer(sentencesAbove(el, stage, reading)))
  wear(el)
  listen({
    reading: (on) => el.classList.toggle("in-lesson", on),
    alone: (names) => el.classList.toggle("alone", names.length > 0),
    enter() { numbers.hidden = false },
  })
  onKeys({ f: () => tell("fullscreen"), p: () => tell("present") })
  return startClient(model, host)
}
