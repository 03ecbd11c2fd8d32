// @ts-check
// Collects changes and sends requests.
//
// There is one request at a time: the next one is sent when the answer to the last one is painted.  So requests never queue,
// however fast a slider is dragged, and the newest values win.
import { listen, tell } from "../base/bus.js"

const PATIENCE = 400
const LONG = 5000

const LATE = "Computing…"
const LONGER = "Computing… The first use of a part takes longer, because it is compiled."
const SILENT = "The server does not respond. This page continues as soon as it does."

/**
 * Return two requests as one.
 * @param {Partial<StateRequest>} first
 * @param {Partial<StateRequest>} second its values and expressions win
 * @returns {Partial<StateRequest>}
 */
function merged(first, second) {
  const values = { ...first.values, ...second.values }
  const expressions = Object.entries(first.expressions ?? {}).filter(([name]) => !(name in (second.values ?? {})))
  return {
    ...first, ...second, scene: second.scene ?? first.scene ?? null, values,
    expressions: { ...Object.fromEntries(expressions), ...second.expressions },
  }
}

/**
 * Return the queue of requests.
 * @param {{send: (message: StateRequest) => void, changed: () => void, hidden: () => string[],
 *   known: (scene: string) => boolean}} client send(message) sends a request, changed() is called when the user wants another
 *   state, hidden() returns the pictures out of sight, known(scene) whether the description of a scene is here
 */
export function createRequests({ send, changed, hidden, known }) {
  let requested = 0
  /** @type {number | null} */
  let asked = null
  let asking = false
  let lost = false
  let silent = false
  // Whether a pointer holds a slider, and whether the last pointer was a finger.
  let grasped = false
  let touched = false
  // Fields of the next request, and of the last one until its answer is painted.
  /** @type {Partial<StateRequest>} */
  let pending = {}
  /** @type {Partial<StateRequest>} */
  let flying = {}
  let isResumed = false
  // The current scene, and the scene that was chosen last.
  /** @type {string | null} */
  let shown = null
  /** @type {string | null} */
  let target = null
  /** @type {ReturnType<typeof setTimeout>} */
  let late = null
  // Time of the last request, and time until its answer was painted.
  let sent = 0
  let took = 0
  // Maps a control to the number of the last request that changed it.
  const moved = new Map()

  const wait = () => {
    clearTimeout(late)
    if (silent) return
    late = setTimeout(() => {
      tell("texts", { busy: LATE })
      late = setTimeout(() => tell("texts", { busy: LONGER }), LONG)
    }, PATIENCE)
  }
  const ask = () => {
    if (shown === null || asked !== null || asking || lost) return
    asking = true
    // Wait for all changes of the same task.
    queueMicrotask(() => {
      asking = false
      asked = requested
      sent = performance.now()
      const { scene = null } = pending
      const entering = scene !== null && scene !== shown
      send({
        requested, held: grasped, values: {}, ...pending, scene: entering ? scene : null,
        hidden: entering ? null : hidden(),
      })
      // Send changes of the previous page only once: if they crash the server, they would crash it again and again.
      flying = isResumed ? {} : pending
      isResumed = false
      pending = {}
      wait()
    })
  }
  const request = () => {
    requested += 1
    changed()
    ask()
  }
  /** @param {Partial<StateRequest>} what */
  const want = (what) => {
    pending = merged(pending, what)
    request()
  }
  /** @param {object} controls by name @param {Partial<StateRequest>} what */
  const move = (controls, what) => {
    for (const name of Object.keys(controls)) moved.set(name, requested + 1)
    want(what)
  }
  // For fields that do not change the state.
  /** @param {Partial<StateRequest>} what */
  const add = (what) => {
    pending = merged(pending, what)
    ask()
  }
  // A preset or reset discards pending changes.
  /** @param {Partial<StateRequest>} what */
  const restart = (what) => {
    moved.set("preset", requested + 1)
    pending = { scene: pending.scene }
    flying = { scene: flying.scene }
    want(what)
  }

  // The axes stay fixed while a pointer holds a slider; its release is a request of its own.
  document.addEventListener("pointerdown", (event) => {
    touched = event.pointerType === "touch"
    grasped = event.composedPath().some((item) => item instanceof Element && item.matches(".hand, .scrub"))
  }, { capture: true })
  for (const name of ["pointerup", "pointercancel"]) {
    document.addEventListener(name, () => {
      if (!grasped) return
      grasped = false
      request()
    }, { capture: true })
  }
  listen({
    change: (values) => move(values, { values }),
    expression: (expressions) => move(expressions, { expressions }),
    preset: (preset) => restart({ preset }),
    reset: () => restart({ reset: true }),
    clear: () => restart({ clear: true }),
    // The answer may belong to another scene.
    restore(restore) {
      target = new URLSearchParams(restore).get("scene") ?? shown
      restart({ restore, scene: target })
    },
    step(step) {
      target = null
      restart({ step, scene: shown })
    },
    lesson: (lesson) => want({ lesson }),
    stop: () => want({ stop: true }),
    pick({ pick }) {
      if (pick.slice(1).every(Number.isFinite)) want({ picked: pick })
    },
    hover(point) {
      // A finger covers the point, and does not leave it when it is lifted.
      if (!touched && point.slice(1).every(Number.isFinite)) add({ hover: point })
    },
    near(near) { if (!known(near)) add({ near }) },
    scene(scene) {
      // Compare with the scene chosen last, which may not be on show yet.
      if (scene === (target ?? shown)) return
      target = scene
      delete pending.restore
      want({ scene })
    },
  })

  return {
    ask,
    request,
    get lost() { return lost },
    /**
     * Wait for the first state, which comes without a request.
     * @param {Partial<StateRequest> | null} unanswered changes of the page before, which are requested then
     */
    begin(unanswered) {
      wait()
      if (unanswered === null) return
      pending = unanswered
      target = unanswered.scene
      isResumed = true
      request()
    },
    /** The changes without an answer. @returns {Partial<StateRequest>} */
    get unanswered() {
      return { ...merged(flying, pending), hover: undefined, near: undefined }
    },
    /**
     * Note the scene on show; requests begin with the first scene.
     * @param {string} scene
     */
    entered: (scene) => { shown = scene },
    /** Allow the next request: a state was painted or has failed. */
    settled() {
      clearTimeout(late)
      if (asked !== null) took = performance.now() - sent
      asked = null
      flying = {}
    },
    /** Milliseconds from the last request until its answer was painted. */
    get took() { return took },
    /** Whether the user has changed something since a request. @param {number} answers its number */
    isBehind: (answers) => answers < requested,
    /** Whether a control was moved since a request. @param {string} control @param {number} answers */
    hasMoved: (control, answers) => moved.get(control) > answers,
    /** Say that the server does not respond, or no longer so. @param {boolean} on */
    silence(on) {
      if (lost) return
      silent = on
      clearTimeout(late)
      tell("texts", { busy: on ? SILENT : "" })
      if (asked !== null) wait()
    },
    /** Stop sending requests: the connection is lost. */
    lose() {
      lost = true
      clearTimeout(late)
    },
  }
}
