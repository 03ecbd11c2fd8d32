// @ts-check
// The bar: the title of the scene on show and the tools of the page.

import { listen, tell } from "../base/bus.js"
import { button, element, icon } from "../base/elements.js"
import { isPresenting, PHONE } from "../base/modes.js"

/**
 * A tool, which tells its name.  without: why it is disabled when there is no such step; menu: the menu that holds it; asks: it opens
 * a dialog, which needs the server.
 * @typedef {{name: keyof PageEvents, title: string, icon: string, label?: string, without?: string,
 *   menu?: "sharing" | "more", asks?: true}} Tool
 */
/** @type {Tool[]} */
const TOOLS = [
  { name: "undo", title: "Undo (Ctrl+Z)",
    without: "nothing has changed yet",
    icon: "M9 5 4 10l5 5M4 10h10a4 4 0 0 1 0 9h-4" },
  { name: "redo", title: "Redo (Ctrl+Shift+Z)",
    without: "nothing has been undone",
    icon: "M15 5l5 5-5 5M20 10H10a4 4 0 0 0 0 9h4" },
  { name: "pin", label: "Compare", title: "Keep this state beside the next ones",
    icon: "M9 4h6l-1 7 3 3H7l3-3zM12 14v7" },
  { name: "share", label: "Link, QR code, embed", asks: true, title: "Share this state", menu: "sharing",
    icon: "M10 8H8a4 4 0 0 0 0 8h2M14 8h2a4 4 0 0 1 0 8h-2M9 12h6" },
  { name: "invite", label: "Invite an audience", asks: true, title: "Let an audience follow on its phones: QR code, guesses", menu: "sharing",
    icon: "M9 11a3 3 0 1 0 0-6 3 3 0 0 0 0 6zM3 20c0-8 12-8 12 0M16 5a3 3 0 0 1 0 6M17 14c2 0 4 2 4 6" },
  { name: "export", label: "Export data, figures, films", asks: true, title: "Save a picture or the page as a file", menu: "sharing",
    icon: "M12 4v11M7 10l5 5 5-5M5 16v4h14v-4" },
  { name: "present", title: "Present mode: large type, few controls (P)",
    icon: "M3 4h18M5 4v12h14V4M8 21l4-5 4 5" },
  { name: "clear", label: "Remove clicks and boxes", title: "Remove all clicks and boxes", menu: "more",
    icon: "M6 6l12 12M18 6 6 18" },
  { name: "reset", label: "Reset", title: "Back to the initial state", menu: "more",
    icon: "M5 4v6h6M5 10a8 8 0 1 1 0 5" },
  { name: "fullscreen", label: "Full screen", title: "Full screen (F)", menu: "more",
    icon: "M5 9V5h4M15 5h4v4M19 15v4h-4M9 19H5v-4" },
  { name: "theme", label: "Light or dark", title: "Light or dark", menu: "more",
    icon: "M20 14A8 8 0 1 1 10 4a7 7 0 0 0 10 10z" },
]
const SHARE = "M6 14a2 2 0 1 0 0-4 2 2 0 0 0 0 4zM18 8a2 2 0 1 0 0-4 2 2 0 0 0 0 4zM18 20a2 2 0 1 0 0-4 2 2 0 0 0 0 4zM8 11l8-4M8 13l8 4"
const MORE = "M4 11h2v2H4zM11 11h2v2h-2zM18 11h2v2h-2z"

/**
 * Return the button of a menu and the menu.
 * @param {string} name
 * @param {string} label
 * @param {string} path of its icon
 * @param {HTMLElement[]} tools
 * @returns {[HTMLElement, HTMLElement]}
 */
function menuOf(name, label, path, tools) {
  const menu = element(`div.more.${name}`, {
    popover: "auto", role: "group", ariaLabel: label, onclick: () => menu.hidePopover(),
    ontoggle: (/** @type {ToggleEvent} */ { newState }) => { opener.ariaExpanded = String(newState === "open") },
  }, ...tools)
  const opener = button(`tool.param-${name}`, null, {
    title: label, ariaLabel: label, innerHTML: icon(path), popoverTargetElement: menu, ariaExpanded: false,
  }, element("span.label", label))
  return [opener, menu]
}

/** @param {Tool} tool */
function tool({ name, label = name[0].toUpperCase() + name.slice(1), title, icon: path }) {
  return button(`tool.param-${name}`, () => tell(name), { title, ariaLabel: label, innerHTML: icon(path) },
    element("span.label", label))
}

/**
 * Render the bar.
 * @param {{first: HTMLElement[], dialogs: HTMLElement[], el: HTMLElement}} part first: the elements before the title; dialogs: those
 *   that the tools open, none without a server
 */
export function render({ first, dialogs, el }) {
  const heading = element("h1.heading")
  const offered = TOOLS.filter(({ asks }) => !asks || dialogs.length > 0)
  const tools = offered.map((one) => ({ ...one, item: tool(one) }))
  /** @param {Tool["name"]} name */
  const itemOf = (name) => tools.find((one) => one.name === name)?.item
  /** @param {Tool["menu"]} menu */
  const within = (menu) => tools.filter((one) => one.menu === menu).map(({ item }) => item)
  const shared = within("sharing")
  const sharing = menuOf("sharing", "Share", SHARE, shared)
  sharing[0].hidden = shared.length === 0
  const more = menuOf("more", "More", MORE, within("more"))
  const [undo, redo, pin, present] = within(undefined)
  const [row, room] = [element("div.tools"), element("span.room")]
  const place = () => {
    row.replaceChildren(...first, heading, room, undo, redo, pin, ...sharing, present, ...more)
    // There is little room on a phone.
    if (PHONE.matches) more[1].append(redo, pin, present)
  }
  PHONE.addEventListener("change", place)
  place()
  el.append(row, ...dialogs)

  /** @param {HTMLElement} item @param {boolean} on */
  const press = (item, on) => { item.ariaPressed = String(on) }
  press(present, isPresenting())
  /** @param {{undo: number, redo: number}} counts */
  const enable = (counts) => {
    for (const { item, name, title, without } of tools) {
      if (without === undefined) continue
      item.disabled = counts[/** @type {"undo" | "redo"} */ (name)] === 0
      item.title = item.disabled ? `Disabled: ${without}` : title
    }
  }
  enable({ undo: 0, redo: 0 })
  listen({
    // Shows the number of followers.
    room({ code, followers }) {
      const item = itemOf("invite")
      if (item === undefined) return
      item.querySelector(".label").textContent = code === null ? item.ariaLabel : `${item.ariaLabel} ${followers}`
      press(item, code !== null)
    },
    presenting: (on) => press(present, on),
    compared: (compared) => press(pin, compared !== null),
    steps: enable,
    enter(scene) {
      heading.textContent = scene.title
      itemOf("clear").hidden = !scene.drawn
    },
  })
}
