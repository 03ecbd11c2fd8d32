// @ts-check
// Commands that concern the page and not the state: link, theme, full screen, present mode.

import { listen, tell } from "../base/bus.js"
import { isPresenting, present } from "../base/presenting.js"

/**
 * Copy a text and return the message for the user.
 * @param {string} text
 * @param {string} instead the message if the browser does not allow it: only HTTPS pages and localhost may copy
 */
async function copy(text, instead) {
  try {
    await navigator.clipboard.writeText(text)
    return "Copied"
  } catch {
    return instead
  }
}

/**
 * Carry out the commands that the page tells.
 * @param {{address: ReturnType<typeof import("./address.js").createAddress>,
 *   theme: ReturnType<typeof import("./theme.js").createTheme>}} parts
 */
export function handleCommands({ address, theme }) {
  listen({
    async link() {
      // The address bar may lag behind the screen.
      address.writeNow()
      tell("copied", { text: null, said: await copy(location.href, "It is in the address bar") })
    },
    address: address.writeNow,
    copy: async (text) => tell("copied", { text, said: await copy(text, "Copy it by hand") }),
    theme() {
      theme.setDark(!theme.isDark())
      tell("url", { theme: theme.isDark() ? "dark" : "light" })
    },
    present() {
      present(!isPresenting())
      tell("url", { present: isPresenting() ? "1" : "" })
    },
    fullscreen() {
      if (document.fullscreenElement === null) document.documentElement.requestFullscreen().catch(console.warn)
      else document.exitFullscreen()
    },
  })
}
