// @ts-check
// The bar: the title of the scene on show and the tools of the page.

import { listen, tell } from "../base/bus.js"
import { button, element, icon } from "../base/elements.js"
import { isPresenting } from "../base/presenting.js"
import { PHONE } from "../base/windows.js"

/**
 * Return the menu and its button, for the end of the bar.
 * @param {HTMLElement[]} tools buttons in the bar
 */
function moreMenu(tools) {
  const places = tools.map((tool) => ({ tool, mark: document.createComment("") }))
  const menu = element("div.more", {
    popover: "auto", role: "group", ariaLabel: "More tools", onclick: () => menu.hidePopover(),
    ontoggle: (/** @type {ToggleEvent} */ { newState }) => { more.ariaExpanded = String(newState === "open") },
  })
  const more = button("tool.param-more", null, {
    title: "More", ariaLabel: "More", innerHTML: icon(MORE), popoverTargetElement: menu, ariaExpanded: false,
  })
  const place = () => {
    for (const { tool, mark } of places) {
      if (PHONE.matches) {
        if (mark.parentNode === null) tool.before(mark)
        menu.append(tool)
      } else if (mark.parentNode !== null) mark.replaceWith(tool)
    }
    more.hidden = !PHONE.matches
  }
  PHONE.addEventListener("change", place)
  // After the tools are in the bar.
  queueMicrotask(place)
  return [more, menu]
}

const MORE = "M4 11h2v2H4zM11 11h2v2h-2zM18 11h2v2h-2z"

/**
 * A tool, which tells its name.  isDrawn: only for scenes where clicks and boxes draw something; without: why it is disabled
 * when there is no such step; isNear: on a phone it stays in the bar, and the others are in the menu More; asks: it opens a
 * dialog, and is there only if the page has that dialog.
 * @typedef {{name: keyof PageEvents, title: string, icon: string, label?: string, isDrawn?: true, without?: string,
 *   isNear?: true, asks?: true}} Tool
 * @typedef {{box: HTMLElement, open: () => void, show?: (scene: SceneDescription) => void}} Dialog
 */
/** @type {Tool[][]} */
const TOOLS = [
  [
    { name: "undo", title: "Undo (Ctrl+Z)", isNear: true,
      without: "nothing has changed yet",
      icon: "M9 5 4 10l5 5M4 10h10a4 4 0 0 1 0 9h-4" },
    { name: "redo", title: "Redo (Ctrl+Shift+Z)",
      without: "nothing has been undone",
      icon: "M15 5l5 5-5 5M20 10H10a4 4 0 0 0 0 9h4" },
    { name: "clear", title: "Remove all clicks and boxes", isDrawn: true,
      icon: "M6 6l12 12M18 6 6 18" },
    { name: "reset", title: "Back to the first state", isNear: true,
      icon: "M5 4v6h6M5 10a8 8 0 1 1 0 5" },
  ],
  [
    { name: "pin", title: "Compare other states with this one",
      icon: "M9 4h6l-1 7 3 3H7l3-3zM12 14v7" },
    { name: "share", asks: true, title: "Link, QR code, HTML to embed", isNear: true,
      icon: "M10 8H8a4 4 0 0 0 0 8h2M14 8h2a4 4 0 0 1 0 8h-2M9 12h6" },
    { name: "invite", asks: true, title: "Let an audience follow on its phones: QR code, guesses",
      icon: "M9 11a3 3 0 1 0 0-6 3 3 0 0 0 0 6zM3 20c0-8 12-8 12 0M16 5a3 3 0 0 1 0 6M17 14c2 0 4 2 4 6" },
    { name: "export", asks: true, title: "Data and figures of a picture",
      icon: "M12 4v11M7 10l5 5 5-5M5 16v4h14v-4" },
    { name: "present", title: "Present mode: large type, few controls (P)",
      icon: "M3 4h18M5 4v12h14V4M8 21l4-5 4 5" },
    { name: "fullscreen", label: "Full screen", title: "Full screen (F)",
      icon: "M5 9V5h4M15 5h4v4M19 15v4h-4M9 19H5v-4" },
    { name: "theme", title: "Light or dark",
      icon: "M20 14A8 8 0 1 1 10 4a7 7 0 0 0 10 10z" },
  ],
]

/** @param {Tool} tool */
function tool({ name, label = name[0].toUpperCase() + name.slice(1), title, icon: path }) {
  return button(`tool.param-${name}`, () => tell(name), { title, ariaLabel: label, innerHTML: icon(path) },
    element("span.label", label))
}

/**
 * Render the bar.
 * @param {{first: HTMLElement[], dialogs: Record<string, Dialog>, el: HTMLElement}} part first: the elements before the title;
 *   dialogs: those of the tools that ask, by tool, and others that follow the scene on show
 */
export function render({ first, dialogs, el }) {
  const heading = element("h1.heading")
  const groupsOfTools = TOOLS.map((group) => group.filter(({ name, asks }) => !asks || name in dialogs))
  // Name → [button, its description].
  /** @type {Map<string, [HTMLButtonElement, Tool]>} */
  const tools = new Map(groupsOfTools.flat().map((one) => [one.name, [tool(one), one]]))
  /** @param {"without" | "isDrawn"} property */
  const those = (property) => [...tools.values()].filter(([, one]) => one[property])
  const groups = groupsOfTools.map((group) => element("div.group", ...group.map(({ name }) => tools.get(name)[0])))
  const more = moreMenu([...tools.values()].filter(([, { isNear }]) => !isNear).map(([item]) => item))
  el.append(
    element("div.tools", ...first, heading, element("span.room"), ...groups, ...more),
    ...Object.values(dialogs).map(({ box }) => box))

  /** @param {string} name @param {boolean} on */
  const press = (name, on) => { tools.get(name)[0].ariaPressed = String(on) }
  press("present", isPresenting())
  /** @param {{undo: number, redo: number}} counts */
  const enable = (counts) => {
    for (const [item, { name, title, without }] of those("without")) {
      item.disabled = counts[/** @type {"undo" | "redo"} */ (name)] === 0
      item.title = item.disabled ? `Disabled: ${without}` : title
    }
  }
  enable({ undo: 0, redo: 0 })
  listen({
    // The number of followers.
    room({ code, followers }) {
      if (!tools.has("invite")) return
      const [item] = tools.get("invite")
      item.querySelector(".label").textContent = code === null ? item.ariaLabel : `${item.ariaLabel} ${followers}`
      press("invite", code !== null)
    },
    presenting: (on) => press("present", on),
    compared: (compared) => press("pin", compared !== null),
    steps: enable,
    enter(scene) {
      heading.textContent = scene.title
      for (const [item] of those("isDrawn")) item.hidden = !scene.drawn
      for (const { show } of Object.values(dialogs)) show?.(scene)
    },
  })
  for (const [name, [, { asks }]] of tools) if (asks) listen({ [name]: dialogs[name].open })
}
