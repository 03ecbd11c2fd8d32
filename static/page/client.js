// @ts-check
// The client: it requests states, fills the pictures with them, and tells when they are painted.  The host of the page answers:
// a server, or the file that holds the page.
//
// <html data-ready> is "false" from a change by the user until its state is on the screen; data-state counts the painted
// states, and data-scene names the scene on show.

import { gallery } from "../pictures/gallery.js"
import { createAddress } from "./address.js"
import { listen, tell } from "../base/bus.js"
import { createCompare } from "./compare.js"
import { embedded } from "../base/embedding.js"
import { createHistory } from "./history.js"
import { joinOther } from "../controls/comparison.js"
import { fill, paint, setAxes, shareAxes } from "./painting.js"
import { isEmbedded, present } from "../base/modes.js"
import { createRequests } from "./requests.js"
import { tabStore } from "../base/stores.js"
import { createVisibility } from "./visibility.js"
import { handleCommands, handlePrinting, setTheme } from "./commands.js"
import { isFirstVisit } from "./lessons.js"

// The next part of a state is requested after a pause as long as the last part took: half of the time is left to the user,
// and a slow server gets fewer requests.  While nothing new arrives, the pause grows to a quarter of the time since the last
// part, so that a class that waits for a long computation does not keep the server busy with requests.
const PAUSE_BETWEEN_PIECES = 80
const SHARE_OF_WAIT = 0.25
// The server continues the computation of a new state after the next request.  The pause leaves the browser time to paint the
// pictures, and the user time to move on.
const PAUSE_BEFORE_PIECES = 40
const LOST = "Connection to the server lost. This page continues as soon as the server answers."

/**
 * Start the client and return access to the state on show.
 * @param {Pick<PageModel, "client" | "lesson">} model
 * @param {Host} host
 */
export function startClient(model, host) {
  const root = document.documentElement
  const own = model.client
  /** @type {Map<string, SceneDescription>} */
  const descriptions = new Map()
  /** @type {Scene | null} */
  let scene = null
  /** @type {StateAnswer | null} */
  let state = null
  /** @type {ReturnType<typeof setTimeout>} */
  let more = null
  // Time when the last new part of the state was painted.
  let news = 0
  // The description of the scene on show, and its derived numbers.
  /** @type {SceneDescription | null} */
  let entered = null
  let derived = ""
  root.dataset.ready = "false"
  root.dataset.state = "0"
  present(own.present === "1")

  // The tab keeps the undo history and the changes without an answer until the same link is opened again; those of each part
  // by themselves, without a history.
  const key = isEmbedded ? `page${location.search}` : "page"
  const kept = JSON.parse(tabStore.get(key) ?? "{}")
  const { steps, unanswered = null } = kept.href === location.href ? kept : {}
  window.addEventListener("pagehide", () => {
    const isBehind = requests.isBehind(state?.answers ?? 0)
    const left = {
      href: location.href, steps: isEmbedded ? undefined : history.steps, unanswered: isBehind ? requests.unanswered : undefined,
    }
    tabStore.set(key, isEmbedded && !isBehind ? null : JSON.stringify(left))
  })

  /** @type {ReturnType<Host["connect"]>} */
  let send = null
  const address = createAddress({ query: () => state.query, own, mark: host.mark })
  const visibility = createVisibility(() => requests.request())
  const requests = createRequests({
    send: (message) => send(message),
    changed: () => { root.dataset.ready = "false" },
    hidden: () => [...visibility.hidden(), ...(entered.absent ?? [])],
    known: (name) => descriptions.has(name),
  })

  const history = createHistory({
    query: () => state.query, isSettled: () => state !== null && !requests.isBehind(state.answers), address,
  }, steps)

  const compare = createCompare(() => ({ query: state.query, scene: entered, derived }))

  handleCommands(address)
  joinOther()
  handlePrinting()
  shareAxes(() => scene)

  listen({
    url(keys) {
      Object.assign(own, keys)
      // The first state also writes the address of earlier changes.
      if (state !== null) address.write()
    },
    "ask-client": (hear) => hear(own),
  })

  /**
   * Return the plots whose axes or data change; all plots for the first state of a scene.
   * @param {Tree} tree
   */
  const touchedPlots = ({ ranges, sources }) => {
    if (!scene.painted) return scene.plots
    const filled = Object.keys(sources).map((name) => scene.sources.get(name)?.plots ?? new Set())
    return scene.plots.filter((plot) => plot.model.name in ranges || filled.some((some) => some.has(plot)))
  }

  /** Fill pictures, texts and controls with a state. @param {StateAnswer} answer @param {ArrayBuffer} block */
  const fillAll = ({ tree, answers }, block) => {
    fill(scene, tree, block)
    derived = tree.texts.derived ?? derived
    // Controls that were moved since the request keep their values.
    tell("controls", Object.fromEntries(
      Object.entries(tree.controls).filter(([name]) => !requests.hasMoved(name, answers))))
  }

  /** @param {string} name */
  const enter = (name) => {
    scene = gallery.enter(name)
    entered = descriptions.get(name)
    derived = ""
    visibility.watch(scene.cells)
    requests.entered(name)
    root.dataset.scene = name
    document.title = `Hess Explorer · ${entered.title}`
    tell("enter", entered)
  }

  /** @param {StateAnswer} next @param {ArrayBuffer} block */
  const show = async (next, block) => {
    const isSketched = state === next
    const isNew = state === null || isSketched || state.answers !== next.answers
    const hasNews = isNew || String(state.progress) !== String(next.progress)
    state = next
    if (scene?.name !== state.scene) enter(state.scene)
    await paint(touchedPlots(state.tree), () => {
      if (!isSketched) return fillAll(state, block)
      setAxes(scene, Object.keys(scene.ranges))
      for (const source of scene.sources.values()) source.feed()
      // The captions also name the plots.
      tell("captions", state.tree.captions)
    })
    scene.painted = true
    address.write()
    root.dataset.state = String(state.number)
    requests.settled()
    history.settle()
    compare.painted()
    if (!requests.lost) tell("texts", { busy: "" })
    tell("progress", state.progress)
    clearTimeout(more)
    if (requests.isBehind(state.answers)) requests.ask()
    else {
      tell("painted")
      // A listener may have requested another state meanwhile.
      if (requests.isBehind(state.answers)) return
      if (state.progress === null) root.dataset.ready = "true"
      else {
        const now = performance.now()
        if (hasNews) news = now
        const pause = Math.max(PAUSE_BETWEEN_PIECES, requests.took, SHARE_OF_WAIT * (now - news))
        more = setTimeout(requests.ask, isNew ? PAUSE_BEFORE_PIECES : pause)
      }
    }
  }

  /**
   * Show the first state in those pictures of the page that are there before the plots.
   * @param {StateAnswer} next
   * @param {ArrayBuffer} block
   */
  const sketch = async (next, block) => {
    if (scene !== null) return
    state = next
    enter(state.scene)
    fillAll(state, block)
    // The canvases get their sizes in one frame and are painted in the next one.
    for (let i = 0; i < 2; i++) await new Promise((done) => requestAnimationFrame(() => setTimeout(done)))
    performance.mark("first picture")
  }

  /** @param {SceneDescription} description @param {() => Promise<void>} [begun] */
  const build = async (description, begun) => {
    if (!gallery.has(description.name)) await gallery.build(description, begun)
  }
  // States are shown one after the other; the pictures of a scene that may come next are built after the state on show.
  let arriving = Promise.resolve()
  /**
   * Queue a state.  The description belongs to its scene, or to a scene that may be chosen next.
   * @param {StateAnswer} next
   * @param {SceneDescription | null} described
   * @param {ArrayBuffer} block
   */
  const onState = (next, described, block) => {
    const description = described !== null && isEmbedded ? embedded(described, own) : described
    if (description !== null) descriptions.set(description.name, description)
    arriving = arriving.then(async () => {
      await build(descriptions.get(next.scene), () => sketch(next, block))
      await show(next, block)
      if (description !== null) await build(description)
    }).catch((error) => {
      // A state that fails must not block later states.
      requests.settled()
      console.error(error)
    })
  }

  /** @type {Parameters<Host["connect"]>[0]} */
  const onAnswer = ({ state: next = null, scene: described = null, lesson = null }, block) => {
    if (lesson !== null) tell("lesson-read", { lesson, step: null })
    if (next !== null) onState(next, described, block)
  }

  /** @param {string} why */
  const onLost = async (why) => {
    if (requests.lost) return
    requests.lose()
    tell("texts", { busy: why || LOST })
    await host.answering()
    // The link and the tab restore the state.  A page that has never shown a state would only fail again.
    if (state === null) return
    address.writeNow()
    location.reload()
  }

  const start = async () => {
    await gallery.standing
    // Follow the preference of the system until the user chooses a theme.
    const preference = matchMedia("(prefers-color-scheme: dark)")
    let isAlone = false
    const followPreference = () => {
      setTheme(own.theme === "" ? isAlone || preference.matches : own.theme === "dark")
    }
    followPreference()
    preference.addEventListener("change", followPreference)
    listen({
      // Darken the page while pictures are shown alone, as in a cinema.
      alone(names) {
        isAlone = names.length > 0
        followPreference()
      },
    })
    tell("client", own)
    // The lesson of a link begins when the page is ready.  With a bare address this is the introduction, whose state is to come.
    if (own.lesson !== "") tell("lesson-read", { lesson: JSON.parse(model.lesson), step: Math.max(0, Number(own.step) - 1) })
    else if (model.lesson !== "" && isFirstVisit()) tell("lesson-read", { lesson: JSON.parse(model.lesson), step: null })
    send = host.connect(onAnswer, onLost, requests.silence)
    requests.begin(unanswered)
  }
  start()
  return { query: () => state?.query ?? null }
}
