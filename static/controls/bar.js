// @ts-check
// The bar: the title of the scene on show and the tools of the page.

import { listen, tell } from "../base/bus.js"
import { button, element, icon } from "../base/elements.js"
import { isPresenting } from "../base/presenting.js"
import { PHONE } from "../base/windows.js"

/**
 * Return the menu and its button, for the end of the bar.
 * @param {HTMLElement[]} tools buttons in the bar
 * @param {string} icon
 */
function moreMenu(tools, icon) {
  const places = tools.map((tool) => ({ tool, mark: document.createComment("") }))
  const menu = element("div.more", {
    popover: "auto", role: "group", ariaLabel: "More tools", onclick: () => menu.hidePopover(),
    ontoggle: (/** @type {ToggleEvent} */ { newState }) => { more.ariaExpanded = String(newState === "open") },
  })
  const more = button("tool.param-more", null, {
    title: "More", ariaLabel: "More", innerHTML: icon, popoverTargetElement: menu, ariaExpanded: false,
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

const MORE = "M5 10a2 2 0 1 0 0 4 2 2 0 0 0 0-4zm7 0a2 2 0 1 0 0 4 2 2 0 0 0 0-4zm7 0a2 2 0 1 0 0 4 2 2 0 0 0 0-4z"

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
      icon: "M9 5 3 10l6 5v-4h5a3.5 3.5 0 0 1 0 7H8v2h6a5.5 5.5 0 0 0 0-11H9z" },
    { name: "redo", title: "Redo (Ctrl+Shift+Z)",
      without: "nothing has been undone",
      icon: "M15 5l6 5-6 5v-4h-5a3.5 3.5 0 0 0 0 7h6v2h-6a5.5 5.5 0 0 1 0-11h5z" },
    { name: "clear", title: "Remove all clicks and boxes", isDrawn: true,
      icon: "M6 4.6 12 10.6 18 4.6 19.4 6 13.4 12 19.4 18 18 19.4 12 13.4 6 19.4 4.6 18 10.6 12 4.6 6z" },
    { name: "reset", title: "Back to the first state", isNear: true,
      icon: "M12 5a7 7 0 1 1-6.7 9h2.1A5 5 0 1 0 12 7v3.5L6.5 6 12 1.5z" },
  ],
  [
    { name: "pin", title: "Compare other states with this one",
      icon: "M9 3h6v2l-1 1v5l3 3v2h-4v5h-2v-5H7v-2l3-3V6L9 5z" },
    { name: "share", asks: true, title: "Link, QR code, HTML to embed", isNear: true,
      icon: "M4 12a4 4 0 0 1 4-4h3v2H8a2 2 0 0 0 0 4h3v2H8a4 4 0 0 1-4-4zm5-1h6v2H9zm4-3h3a4 4 0 0 1 0 8h-3v-2h3a2 2 0 0 0 0-4h-3z" },
    { name: "invite", asks: true, title: "Let an audience follow on its phones: QR code, guesses",
      icon: "M8 4a3.5 3.5 0 1 0 0 7 3.5 3.5 0 0 0 0-7zm8.5 2a3 3 0 1 0 0 6 3 3 0 0 0 0-6zM8 13c-3.6 0-6 1.8-6 4.4V20h12v-2.6c0-2.6-2.4-4.4-6-4.4zm8.5 1c-.7 0-1.3.1-1.8.2.8.9 1.3 2 1.3 3.2V20h6v-1.9c0-2.4-2.2-4.1-5.5-4.1z" },
    { name: "export", asks: true, title: "Data and figures of a picture",
      icon: "M11 3h2v8l3-3 1.4 1.4L12 14.8 6.6 9.4 8 8l3 3zM4 15h2v4h12v-4h2v6H4z" },
    { name: "present", title: "Present mode: large type, few controls (P)",
      icon: "M3 4h18v2h-1v10h-7v1.6l3.4 3-1.3 1.4L12 19.6 8.9 22l-1.3-1.4 3.4-3V16H4V6H3zm3 2v8h12V6z" },
    { name: "fullscreen", label: "Full screen", title: "Full screen (F)",
      icon: "M5 5h5v2H7v3H5zm9 0h5v5h-2V7h-3zM5 14h2v3h3v2H5zm12 0h2v5h-5v-2h3z" },
    { name: "theme", title: "Light or dark",
      icon: "M12 3a9 9 0 1 0 0 18 9 9 0 0 0 0-18zm0 2v14a7 7 0 0 1 0-14z" },
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
  const more = moreMenu([...tools.values()].filter(([, { isNear }]) => !isNear).map(([item]) => item), icon(MORE))
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
