// The changes since the last request, and when the next request goes.
//
// One request at a time: the next one goes when the answer to the last is painted.  So nothing queues, however fast a
// slider is dragged, and the newest values win.

import { listen, tell } from "./bus.js"

const PATIENCE = 400
const LONG = 5000

const LATE = "Computing…"
const COMPILING = "Computing… What is used for the first time is compiled."

// send(message) takes the message to the server.  changed() is called whenever the user asks for another state.
// hidden() gives the names of the pictures out of sight.  known(scene) says whether its description is here.
export function createRequests({ send, changed, hidden, known }) {
  let requested = 0
  let asked = null
  let asking = false
  let lost = false
  // By a pointer; by an animation.
  let grasped = false
  let animated = false
  let touched = false
  // What the next request says besides.
  let pending = {}
  let shown = null
  let chosen = null
  let target = null
  let late = null
  // When it was asked last, and how long the answer took to be painted.
  let sent = 0
  let took = 0
  // Control → the request by which it was changed last.
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
    // After all that is changed in the same task.
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
  const want = (what) => {
    Object.assign(pending, what)
    request()
  }
  // What is no change of the state.
  const add = (what) => {
    Object.assign(pending, what)
    ask()
  }
  // A preset or reset discards pending changes.
  const restart = (what) => {
    moved.set("preset", requested + 1)
    pending = {}
    want(what)
  }

  // While a pointer holds a slider the axes hold still; letting go is a request of its own.
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
    // The query of a state, perhaps of another scene.
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
    pick({ pick, drag }) {
      // A finger that moves scrolls the page.
      if ((drag && touched) || !Array.isArray(pick) || !pick.slice(1).every(Number.isFinite)) return
      want({ picked: pick })
    },
    hover(place) {
      if (place.slice(1).every(Number.isFinite)) add({ hover: place })
    },
    near(near) { if (!known(near)) add({ near }) },
    scene(scene) {
      // The scene chosen last, though its pictures may still be on their way.
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
    // The first state is on its way without being asked for.
    begin: wait,
    // This scene is on show; only now can anything be asked for.
    entered: (scene) => { shown = scene },
    // A state was painted, or failed to be: the next request may go.
    settled() {
      clearTimeout(late)
      if (asked !== null) took = performance.now() - sent
      asked = null
    },
    // Milliseconds from the last request until its answer was painted.
    get took() { return took },
    // Whether the user has changed something since the request with this number.
    isBehind: (answers) => answers < requested,
    // Whether a control has been moved since the request with this number.
    hasMoved: (control, answers) => moved.get(control) > answers,
    // The connection is gone: nothing is asked for any more.
    lose() {
      lost = true
      clearTimeout(late)
    },
  }
}
