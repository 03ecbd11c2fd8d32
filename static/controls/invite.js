// @ts-check
// The dialog Invite: QR code and address by which an audience follows, and how many do.

import { button, element } from "../base/elements.js"
import { listen, tell } from "../base/bus.js"
import { qrCode } from "./qr.js"
import { dialogOf } from "./dialog.js"

/** Return the dialog, which opens with the room. */
export function inviteDialog() {
  const { code, draw } = qrCode("QR code of the address")
  const scan = element("p", { hidden: true }, "Scan the code, or open")
  const address = element("p.room-address")
  const count = element("p.room-count", { role: "status" })
  const unreachable = element("p.unreachable", { hidden: true }, "Phones cannot reach this address. Start the explorer with " +
    "--address 0.0.0.0, and open the page by the name of this computer in its network.")
  const end = button("button.param-end-room", () => tell("end-room"), "End the lecture")
  const dialog = dialogOf("Invite", "menu-of-scenes.invite", [], element("div.invitation",
    code, element("div", scan, address, unreachable, count,
      element("p.small", "Phones show your scene, state, picture and lesson step, and take guesses. No names are collected, and " +
        "nothing is kept when the lecture ends."), end)))
  let drawn = ""

  /** @param {string} link */
  async function show(link) {
    if (link === drawn) return
    drawn = link
    const [, host, path] = /^https?:\/\/(.*)(\/r\/.*)$/.exec(link) ?? ["", "", ""]
    unreachable.hidden = !/^(localhost|127\.|\[::1\])/.test(host)
    address.replaceChildren(host, element("wbr"), element("span", path))
    const why = await draw(link)
    if (why !== "") count.textContent = why
  }

  listen({
    room({ code: name, address: link, followers, said }) {
      scan.hidden = end.hidden = name === null
      count.textContent = name === null ? said : `${followers} follower${followers === 1 ? "" : "s"}`
      show(link)
    },
    invite() {
      tell("open-room")
      dialog.showModal()
    },
  })
  return dialog
}
