// @ts-check
// The page of a follower: one picture of the lecturer's state, the step of the lesson, and a guess.  It has no session: all
// followers receive the same frames.

import { render as renderPictures, gallery } from "../pictures/gallery.js"
import { createGuess } from "../pictures/guess.js"
import { createVeil, lightNames } from "../pictures/layers.js"
import { listen, tell } from "../base/bus.js"
import { element, say } from "../base/elements.js"
import { createMount } from "./mount.js"
import { fill, paint } from "./painting.js"
import { atMost, followed, newName, openRoom } from "./room_socket.js"
import { tabStore } from "../base/stores.js"
import { decode } from "./websocket.js"

const NAME = "name-in-room"
const FOLLOWING = "Following the lecturer"
const WAITING = "Waiting for the lecturer…"
const LOST = "Connection lost. This page continues as soon as the server answers."

const code = location.pathname.split("/").at(-1)
const root = document.documentElement

/** Render the step of the lesson. @param {{el: HTMLElement}} part */
function renderStep({ el }) {
  const [of, title, text] = [element("p.of"), element("h2.title"), element("div.text")]
  const said = element("output.said")
  const question = element("div.question")
  const panel = element("section.lesson", { hidden: true, ariaLabel: "Lesson" }, of, title, said, text, question)
  el.append(panel)
  lightNames(el)
  listen({
    followed({ step, lesson = "", number }) {
      panel.hidden = step === null
      if (step === null) return
      of.textContent = `${lesson}, step ${number}`
      title.innerHTML = step.title
      text.innerHTML = step.text
      question.innerHTML = step.question
      question.hidden = step.question === ""
    },
    audience: (sentence) => say(said, sentence),
  })
}

function start() {
  const mount = createMount(JSON.parse(document.getElementById("sheets").textContent))
  const heading = element("h1")
  const status = element("p.status", { role: "status" }, WAITING)
  const free = element("a.button.param-let-go", { href: "./" }, "Let go")
  document.body.append(
    element("header", heading, free), status, mount("pictures", renderPictures, {}, element("main.pictures")),
    mount("lessons", renderStep, {}, element("aside", { tabIndex: 0, ariaLabel: "Lesson" })))

  // The name makes guesses of one phone count once, also after a reload.
  const name = tabStore.get(NAME) ?? newName()
  tabStore.set(NAME, name)
  followed.code = code

  /** @type {Map<string, SceneDescription>} */
  const descriptions = new Map()
  // Maps scene → source → its columns before the first state.
  /** @type {Map<string, Map<string, Data>>} */
  const empty = new Map()
  /** @type {ReturnType<typeof createGuess> | null} */
  let guess = null
  const veil = createVeil()
  // The step that asked for the guess.
  let asked = ""

  const send = atMost((/** @type {{guess: number[][], step: number}} */ message) => room.send(message))

  /** Begin or reveal the guess of a step, whose state is on show. @param {string} key @param {Followed} show */
  function ask(key, { step, number, revealed }) {
    if (key !== asked) {
      asked = key
      if (key !== "" && !revealed) {
        guess = createGuess(step.prediction, (text) => tell("audience", text), (points) => send({ guess: points, step: number }))
        guess.begin()
      }
    }
    if (!revealed || guess === null || guess.isRevealed) return
    guess.wait()
    guess.reveal()
  }

  /** @param {StateAnswer} state @param {Followed} show @param {ArrayBuffer} block */
  async function draw(state, show, block) {
    const key = show.step?.prediction ? `${show.lesson} ${show.number}` : ""
    const isNew = root.dataset.scene !== state.scene
    if (key !== asked || isNew) {
      guess?.end()
      guess = null
      asked = ""
      tell("audience", "")
    }
    if (isNew) {
      const description = descriptions.get(state.scene)
      if (!gallery.has(state.scene)) {
        const { sources } = await gallery.build(description)
        empty.set(state.scene, new Map([...sources].map(([name, source]) => [name, source.data])))
      }
      gallery.enter(state.scene)
      root.dataset.scene = state.scene
      tell("enter", description)
    }
    const scene = gallery.shown
    veil((show.revealed ? null : show.step?.prediction) ?? show.step?.hide ?? null)
    await paint(scene.plots, () => {
      fill(scene, state.tree, block)
      // Each state is complete: omitted columns are empty.
      for (const [source, data] of empty.get(state.scene)) {
        if (!(source in state.tree.sources)) scene.sources.get(source).put(data)
      }
    })
    tell("painted")
    heading.textContent = document.title = show.scene
    free.href = `./?${state.query}&large=${state.scene.split("/")[1]}`
    status.textContent = FOLLOWING
    tell("followed", show)
    ask(key, show)
    root.dataset.query = state.query
    root.dataset.ready = "true"
  }

  // While a state is painted, keep only the newest arrival.
  /** @type {(() => Promise<void>) | null} */
  let next = null
  let isDrawing = false
  async function drawNext() {
    if (isDrawing) return
    isDrawing = true
    while (next !== null) {
      const one = next
      next = null
      await one().catch(console.error)
    }
    isDrawing = false
  }

  const room = openRoom(code, {
    first: () => ({ follow: name }),
    receive(data) {
      const { head, block } = decode(/** @type {ArrayBuffer} */ (data))
      if (head.scene) descriptions.set(head.scene.name, head.scene)
      if (!head.state) return
      next = () => draw(head.state, head.show, block)
      drawNext()
    },
    connected(on) { status.textContent = !on ? LOST : root.dataset.ready ? FOLLOWING : WAITING },
    ended(_, reason) {
      followed.code = null
      status.textContent = reason
      free.textContent = "Open Hess Explorer"
      root.dataset.over = ""
    },
  })
}

start()
