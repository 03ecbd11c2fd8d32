// @ts-check
// Collects changes and sends requests.
//
// There is one request at a time: the next one is sent when the answer to the last one is painted.  So requests never queue,
// however fast a slider is dragged, and the newest values win.
import { listen, tell } from "./bus.js"

const PATIENCE = 400
const LONG = 5000

const LATE = "Computing…"
const COMPILING = "Computing… This part is compiled on first use."

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
  // Whether a pointer holds a slider, an animation moves one, and the last pointer was a finger.
  let grasped = false
  let animated = false
  let touched = false
  // Fields of the next request.
  /** @type {Partial<StateRequest>} */
  let pending = {}
  // The scene on show, the scene to request next, and the scene that was chosen last.
  /** @type {string | null} */
  let shown = null
  /** @type {string | null} */
  let chosen = null
  /** @type {string | null} */
  let target = null
  /** @type {ReturnType<typeof setTimeout>} */
  let late = null
  // When the last request was sent, and the time until its answer was painted.
  // When it was asked last, and how long the answer took to be painted.
  let sent = 0
  let took = 0
  // Control → number of the request that changed it last.
  const moved = new Map()

  const wait = () => {
    clearTimeout(late)
    late = setTimeout(() => {
      tell("texts", { busy: LATE })
      late = setTimeout(() => tell("texts", { busy: COMPILING }), LONG)
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
      const entering = chosen !== null && chosen !== shown
      send({
        requested, held: grasped || animated, values: {}, ...pending, scene: entering ? chosen : null,
        hidden: entering ? null : hidden(),
      })
      pending = {}
      chosen = null
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
    Object.assign(pending, what)
    request()
  }
  // For fields that do not change the state.
  /** @param {Partial<StateRequest>} what */
  const add = (what) => {
    Object.assign(pending, what)
    ask()
  }
  // A preset or reset discards pending changes.
  /** @param {Partial<StateRequest>} what */
  const restart = (what) => {
    moved.set("preset", requested + 1)
    pending = {}
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
    animated(on) {
      animated = on
      request()
    },
    change(changes) {
      for (const name of Object.keys(changes)) {
        moved.set(name, requested + 1)
        delete pending.expressions?.[name]
      }
      want({ values: { ...pending.values, ...changes } })
    },
    expression(texts) {
      for (const name of Object.keys(texts)) moved.set(name, requested + 1)
      want({ expressions: { ...pending.expressions, ...texts } })
    },
    preset: (preset) => restart({ preset }),
    reset: () => restart({ reset: true }),
    clear: () => restart({ clear: true }),
    // The state may belong to another scene.
    restore(restore) {
      chosen = target = new URLSearchParams(restore).get("scene") ?? shown
      restart({ restore })
    },
    step(step) {
      chosen = target = null
      restart({ step })
    },
    lesson: (lesson) => add({ lesson }),
    stop: () => want({ stop: true }),
    pick({ pick }) {
      if (Array.isArray(pick) && pick.slice(1).every(Number.isFinite)) want({ picked: pick })
    },
    hover(place) {
      // A finger covers the place, and does not leave it when it is lifted.
      if (!touched && place.slice(1).every(Number.isFinite)) add({ hover: place })
    },
    near(near) { if (!known(near)) add({ near }) },
    scene(scene) {
      // Compare with the scene chosen last, which may not be on show yet.
      if (scene === (target ?? shown)) return
      chosen = target = scene
      delete pending.restore
      request()
    },
  })

  return {
    ask,
    request,
    get lost() { return lost },
    // The first state comes without a request.
    begin: wait,
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
    },
    /** Milliseconds from the last request until its answer was painted. */
    get took() { return took },
    /** Whether the user has changed something since a request. @param {number} answers its number */
    isBehind: (answers) => answers < requested,
    /** Whether a control was moved since a request. @param {string} control @param {number} answers */
    hasMoved: (control, answers) => moved.get(control) > answers,
    /** Stop sending requests: the connection is lost. */
    lose() {
      lost = true
      clearTimeout(late)
    },
  }
}
