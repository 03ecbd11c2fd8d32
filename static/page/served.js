// @ts-check
// The page beside its server: with the tools that ask the server, and rooms.

import { render as renderBar } from "../controls/bar.js"
import { exportDialog } from "../controls/export.js"
import { sceneMenu } from "../controls/scenes.js"
import { inviteDialog, shareDialog } from "../controls/share.js"
import { button, element, icon } from "../base/elements.js"
import { isEmbedded } from "../base/modes.js"
import { createMount, FRAME, stylesOf } from "./mount.js"
import { recording } from "./recording.js"
import { createRoom } from "./room.js"
import { followed } from "./room_socket.js"
import { buildPage } from "./shell.js"
import { answering, openWebsocket } from "./websocket.js"

const MENU = "M4 7h16M4 12h16M4 17h16"

/** Return the link back to the lecture that this tab has left to play on its own. */
function rejoin() {
  const { code } = followed
  return code === null || isEmbedded ? [] : [element("a.rejoin", { href: `r/${code}` }, "Back to the lecture")]
}

/** @type {HTMLElement | null} */
let built = null

/**
 * Render the page.  Panel may call this again: the page is built once.
 * @param {{model: PageModel, el: HTMLElement}} component
 */
export function render({ model, el }) {
  if (built !== null) return el.replaceWith(built)
  built = el
  const { lessons: index, scenes, files, sheets } = model
  const mount = createMount(sheets)
  const menu = sceneMenu(scenes)
  const dialogs = [menu.dialog, shareDialog(), inviteDialog(), exportDialog(files)]
  const first = [button("tool.param-scenes", menu.open, { title: "Choose a scene", ariaHasPopup: "dialog", innerHTML: icon(MENU) },
    element("span", "Scenes"))]
  const { query } = buildPage(model, { mark: "?", connect: openWebsocket, answering }, {
    mount, bar: [mount("bar", renderBar, { first, dialogs }), ...rejoin()],
    lessons: { index, record: recording() }, styles: stylesOf(sheets, FRAME),
  }, el)
  if (!isEmbedded) createRoom({ query })
}
