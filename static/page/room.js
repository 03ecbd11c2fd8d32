// @ts-check
// The lecturer's room: it tells the server what is on the screen, and the page how many follow and what they guess.

import { createAudience } from "../pictures/audience.js"
import { listen, tell } from "../base/bus.js"
import { addressOf, atMost, newCode, openRoom, TAKEN } from "./room_socket.js"
import { tabStore } from "../base/stores.js"

const KEY = "own-room"

/** @typedef {{lesson: string, step: number, revealed: boolean, picture: string}} Place */

/**
 * Start the lecturer's side of rooms.
 * @param {{query: () => string | null}} page query() returns the query of the state on show, null before the first
 */
export function createRoom({ query }) {
  /** @type {{code: string, key: string | null} | null} */
  let own = null
  /** @type {ReturnType<typeof openRoom>} */
  let room = null
  // The requested place, and the place of the current state.
  /** @type {Place} */
  let wanted = { lesson: "", step: 0, revealed: false, picture: "" }
  let there = wanted
  /** @type {Map<string, Lesson>} */
  const lessons = new Map()
  /** @type {ReturnType<typeof createAudience> | null} */
  let audience = null
  let guesses = 0

  const post = atMost((/** @type {object} */ show) => room?.send({ show }))
  const isThere = () => wanted.lesson === there.lesson && wanted.step === there.step && wanted.revealed === there.revealed
  const show = () => { if (room !== null && query() !== null) post({ ...there, query: query() }) }
  const prediction = () => lessons.get(there.lesson)?.steps[there.step - 1]?.prediction

  function sayGuesses() {
    if (prediction() === undefined || audience !== null) return
    tell("audience", room === null ? "" : `${guesses} guess${guesses === 1 ? "" : "es"} from the audience.`)
  }

  function endAudience() {
    audience?.end()
    audience = null
    tell("audience", "")
  }

  /** @param {string} reason */
  function forget(reason) {
    own = room = null
    tabStore.set(KEY, null)
    endAudience()
    tell("room", { code: null, address: "", followers: 0, said: reason })
  }

  /** @param {string | ArrayBuffer} data */
  function receive(data) {
    const { key, followers, guesses: count, cloud } = JSON.parse(/** @type {string} */ (data))
    if (key !== undefined) {
      own.key = key
      tabStore.set(KEY, JSON.stringify(own))
    }
    if (key !== undefined || followers !== undefined) {
      tell("room", { code: own.code, address: addressOf(own.code), followers: followers ?? 0, said: "" })
      show()
    }
    if (count !== undefined) {
      guesses = count
      sayGuesses()
    }
    if (cloud !== undefined && prediction() !== undefined && isThere()) {
      endAudience()
      audience = createAudience(prediction(), cloud, (text) => tell("audience", text))
    }
  }

  function connect() {
    room = openRoom(own.code, {
      first: () => (own.key === null ? { open: true } : { lead: own.key }),
      receive,
      ended(code, reason) {
        if (code !== TAKEN) return forget(reason)
        own.code = newCode()
        connect()
      },
    })
  }

  listen({
    client(given) {
      wanted = { ...wanted, lesson: given.lesson, step: Number(given.step), picture: given.large.split(",")[0] }
      const text = tabStore.get(KEY)
      if (text === null) return
      own = JSON.parse(text)
      connect()
    },
    url({ lesson, step, large }) {
      if (lesson !== undefined) {
        // Guesses are removed with their step.
        if (lesson !== wanted.lesson || Number(step) !== wanted.step) endAudience()
        wanted = { ...wanted, lesson, step: Number(step), revealed: false }
        // No state follows the end of a lesson, so send this at once.
        if (lesson === "") {
          there = wanted
          show()
        }
      }
      if (large !== undefined) {
        wanted = { ...wanted, picture: large.split(",")[0] }
        // No new state is needed, unless another one is requested.
        if (!isThere()) return
        there = wanted
        show()
      }
    },
    step([, , revealed]) { wanted = { ...wanted, revealed } },
    "lesson-read"({ lesson }) { lessons.set(lesson.name, lesson) },
    // During a drag no state is the last one; on the way to another step the state belongs to no step yet.
    paint() { if (isThere()) show() },
    painted() {
      if (!isThere()) {
        if (wanted.step !== there.step || wanted.lesson !== there.lesson) guesses = 0
        there = wanted
        sayGuesses()
      }
      show()
    },
    "open-room"() {
      if (own !== null) return
      own = { code: newCode(), key: null }
      connect()
    },
    "end-room"() {
      room?.send({ end: true })
    },
  })
}
