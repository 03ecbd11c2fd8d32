// Commands to the page itself rather than to the state: its link, its theme, the full screen, present mode.

import { listen, tell } from "./bus.js"
import { isPresenting, present } from "./presenting.js"

// Only a page by https, or of this machine, may write to the clipboard: `instead` is said where it may not.
async function copy(text, instead) {
  try {
    await navigator.clipboard.writeText(text)
    return "Copied"
  } catch {
    return instead
  }
}

export function handleCommands({ address, page }) {
  listen({
    async link() {
      // The link of what is on the screen, not of what the address bar has come to.
      address.writeNow()
      tell("copied", { text: null, said: await copy(location.href, "It is in the address bar") })
    },
    address: address.writeNow,
    copy: async (text) => tell("copied", { text, said: await copy(text, "Copy it by hand") }),
    theme: page.turnTheme,
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
