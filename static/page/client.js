// Asks for states, fills the pictures with them, and tells when they are painted.
//
// <html data-ready> is "false" from a change by the user until the answer to it is on the screen; data-state counts the
// painted states, and data-scene names the scene on show.

import { gallery } from "../pictures/gallery.js"
import { createAddress } from "./address.js"
import { listen, tell } from "./bus.js"
import { createCompare } from "./compare.js"
import { embed, embedded } from "./embedding.js"
import { createHandout } from "./handout.js"
import { createHistory } from "./history.js"
import { joinOther } from "./side_by_side.js"
import { fill, paint } from "./painting.js"
import { createPage } from "./panel_page.js"
import { present } from "./presenting.js"
import { createRequests } from "./requests.js"
import { createVisibility } from "./visibility.js"
import { answering, openWebsocket } from "./websocket.js"
import { handleCommands } from "./commands.js"

// The next pieces are asked for after a pause as long as the last ones took: half of the time is the user's, and a
// server that is slow is asked less often.
const PAUSE_BETWEEN_PIECES = 80
const LOST = "The connection to the server is lost. As soon as it answers, this page goes on in the same state."

// model.client: what the browser itself keeps of the address: t, speed, az, el, large, present; embed, pictures, controls;
// lesson, step.
export function startClient(model, view) {
  const root = document.documentElement
  const own = model.client
  // Scene → its description.
  const descriptions = new Map()
  let scene = null
  let state = null
  let more = null
  // What has been said of the scene on show.
  let latest = { scene: null, texts: {}, controls: {} }
  root.dataset.ready = "false"
  root.dataset.state = "0"
  present(own.present === "1")
  const isPart = own.embed === "1"
  if (isPart) embed()

  let send = null
  const page = createPage(view)
  const address = createAddress({ query: () => state.query, isDark: page.isDark, own })
  const visibility = createVisibility(() => requests.request())
  const requests = createRequests({
    send: (message) => send(message),
    changed: () => { root.dataset.ready = "false" },
    hidden: () => [...visibility.hidden(), ...(latest.scene.absent ?? [])],
    known: (name) => descriptions.has(name),
  })

  const history = createHistory({
    query: () => state.query, isSettled: () => state !== null && !requests.isBehind(state.answers), address,
  })

  const compare = createCompare(() => ({
    query: state.query, scene: latest.scene, derived: latest.texts.derived ?? "",
  }))

  handleCommands({ address, page })
  createHandout(() => latest)
  joinOther()

  listen({
    url(keys) {
      Object.assign(own, keys)
      // The first state brings the others.
      if (state !== null) address.write()
    },
    "ask-client": (hear) => hear(own),
    "ask-chart": (chart) => send({ chart }),
  })

  // The plots that a state gives other axes or other data; all of them at first.
  const touchedPlots = ({ ranges, sources }) => {
    if (!scene.painted) return scene.plots
    const filled = Object.keys(sources).map((name) => scene.sources.get(name)?.plots ?? new Set())
    return scene.plots.filter((plot) => plot.model.name in ranges || filled.some((some) => some.has(plot)))
  }

  // Put a state into the pictures, texts and controls.
  const fillAll = ({ tree, answers }, block) => {
    fill(scene, tree, block)
    Object.assign(latest.texts, tree.texts)
    Object.assign(latest.controls, tree.controls)
    tell("texts", tree.texts)
    // A control that has been moved on since is not moved back.
    tell("controls", Object.fromEntries(
      Object.entries(tree.controls).filter(([name]) => !requests.hasMoved(name, answers))))
  }

  const enter = (name) => {
    scene = gallery.enter(name)
    latest = { scene: descriptions.get(name), texts: {}, controls: {} }
    visibility.watch(scene.cells)
    requests.entered(name)
    root.dataset.scene = name
    document.title = `Hess Explorer · ${latest.scene.title}`
    tell("enter", latest.scene)
  }

  const show = async (next, block) => {
    state = next
    if (scene?.name !== state.scene) enter(state.scene)
    await paint(touchedPlots(state.tree), () => fillAll(state, block))
    address.write()
    root.dataset.state = state.number
    requests.settled()
    history.settle()
    compare.painted()
    if (!requests.lost) tell("texts", { busy: "" })
    tell("progress", state.progress)
    clearTimeout(more)
    if (requests.isBehind(state.answers)) requests.ask()
    else {
      tell("painted")
      // What hears that may have asked for another state.
      if (requests.isBehind(state.answers)) return
      if (state.progress === null) root.dataset.ready = "true"
      else more = setTimeout(requests.ask, Math.max(PAUSE_BETWEEN_PIECES, requests.took))
    }
  }

  const build = async (description) => {
    if (!gallery.has(description.name)) await gallery.build(description)
  }
  // States come one by one; the pictures of a scene that may be chosen next are built behind those on show.
  let arriving = Promise.resolve()
  // The newest description comes with a state of its scene, or of one that may be chosen before it.
  const onState = (next, described, block) => {
    const description = described !== null && isPart ? embedded(described, own) : described
    if (description !== null) descriptions.set(description.name, description)
    arriving = arriving.then(async () => {
      await build(descriptions.get(next.scene))
      await show(next, block)
      if (description !== null) await build(description)
    }).catch((error) => {
      // One state that cannot be shown must not keep the next ones away.
      requests.settled()
      console.error(error)
    })
  }

  const onAnswer = ({ state: next = null, scene: described = null, lesson = null, chart = null }, block, cells) => {
    if (lesson !== null) tell("lesson-read", { lesson, step: null })
    if (next !== null) onState(next, described, block)
    if (chart !== null) tell("charted", { head: chart, cells })
  }

  const onLost = async (why) => {
    if (requests.lost) return
    requests.lose()
    tell("texts", { busy: why || LOST })
    await answering()
    // Its own link is all that it needs; a page that has never shown anything would only come here again.
    if (state === null) return
    address.writeNow()
    location.reload()
  }

  const start = async () => {
    await Promise.all([gallery.standing, page.standing()])
    const followTheme = () => { root.style.colorScheme = page.isDark() ? "dark" : "light" }
    followTheme()
    page.onThemeChange(() => {
      followTheme()
      address.write()
    })
    tell("client", own)
    // The first state is read when the page stands, even if the user was faster and it is no longer the first.
    if (model.lesson !== "") tell("lesson-read", { lesson: JSON.parse(model.lesson), step: Number(own.step) - 1 })
    send = openWebsocket(onAnswer, onLost)
    requests.begin()
  }
  start()
}
