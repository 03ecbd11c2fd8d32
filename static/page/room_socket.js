// @ts-check
// The websocket of a room, see "rooms/messages.py", and the room that a tab remembers.

import { tabStore } from "../base/stores.js"
import { answering, watch } from "./websocket.js"

// Close codes of "server/room_socket.py": the room is over, or not for this page.
export const TAKEN = 4003
const FIRST_OF_OURS = 4000
const FULL = 1013
// A device that slept longer than this reconnects: its connection may be dead without its knowledge.
const SLEEP = 20_000
const PAUSE = 250
const FOLLOWED = "followed-room"

const CODE = /^[2-9A-HJ-NP-Z]{6}$/
const LETTERS = "23456789ABCDEFGHJKLMNPQRSTUVWXYZ"

/** Return a random code of six letters, see `CODE` in "rooms/messages.py". */
export const newCode = () => Array.from(crypto.getRandomValues(new Uint8Array(6)), (byte) => LETTERS[byte % LETTERS.length]).join("")

/** Return a random name that cannot be guessed. */
export const newName = () => Array.from(crypto.getRandomValues(new Uint8Array(16)), (byte) => byte.toString(16).padStart(2, "0")).join("")

/** Return the address at which the audience follows. @param {string} code */
export const addressOf = (code) => new URL(`r/${code}`, document.baseURI).href

/** The room that this tab follows. */
export const followed = {
  /** Return its code, or null. */
  get code() {
    const code = tabStore.get(FOLLOWED)
    return code !== null && CODE.test(code) ? code : null
  },
  set code(code) { tabStore.set(FOLLOWED, code) },
}

/**
 * Connect to a room, again whenever the connection is lost, until the room or the page ends it.
 * @param {string} code
 * @param {{first: () => object, receive: (data: string | ArrayBuffer) => void, connected?: (on: boolean) => void,
 *   ended: (code: number, reason: string) => void}} page first() returns the first message, ended(code, reason) is called when
 *   the server has closed the room
 */
export function openRoom(code, { first, receive, connected = () => {}, ended }) {
  /** @type {WebSocket} */
  let socket = null
  let isOver = false
  let hiddenAt = 0

  function connect() {
    const url = new URL(`rooms/${code}`, document.baseURI)
    url.protocol = url.protocol.replace("http", "ws")
    const own = new WebSocket(url)
    socket = own
    own.binaryType = "arraybuffer"
    own.addEventListener("open", () => {
      own.send(JSON.stringify(first()))
      connected(true)
    })
    own.addEventListener("message", ({ data }) => { if (own === socket && data !== "") receive(data) })
    watch(own, (on) => connected(!on), () => { if (own === socket) reconnect() })
    own.addEventListener("close", async ({ code: why, reason }) => {
      if (isOver || own !== socket) return
      connected(false)
      if (why >= FIRST_OF_OURS || (why === FULL && reason !== "")) {
        isOver = true
        ended(why, reason)
        return
      }
      await answering()
      if (!isOver && own === socket) connect()
    })
  }

  function reconnect() {
    if (isOver) return
    socket.close()
    connect()
  }

  document.addEventListener("visibilitychange", () => {
    if (document.hidden) hiddenAt = performance.now()
    else if (performance.now() - hiddenAt > SLEEP) reconnect()
  })
  setTimeout(connect)
  return {
    /** Send a message; it is lost while there is no connection. @param {object} message */
    send(message) { if (socket?.readyState === WebSocket.OPEN) socket.send(JSON.stringify(message)) },
  }
}

/**
 * Throttle a function: call it with the newest argument, at most once per `PAUSE`, and always with the last argument.
 * @template Argument
 * @param {(argument: Argument) => void} act
 */
export function atMost(act) {
  /** @type {ReturnType<typeof setTimeout>} */
  let timer = null
  /** @type {{argument: Argument} | null} */
  let waiting = null
  const next = () => {
    timer = null
    if (waiting === null) return
    const { argument } = waiting
    waiting = null
    timer = setTimeout(next, PAUSE)
    act(argument)
  }
  return (/** @type {Argument} */ argument) => {
    waiting = { argument }
    if (timer === null) next()
  }
}
