// @ts-check
// The player: play, pause, step, speed, and the time slider.  It interpolates the moving point from the samples of the orbit
// on the page, so playing sends no requests.  It tells "time" and fills the sources of single points.
//
// It plays a scene slowly when it has first been drawn whole, so that newcomers see what moves; but not if the user prefers reduced
// motion, in an embedded page, at a moment that a link names, or in a lesson beside all pictures.

import { button, element, icon, relabel } from "../base/elements.js"
import { listen, tell } from "../base/bus.js"
import { arrowOf, isTaken } from "../base/keys.js"
import { within } from "../base/numbers.js"
import { gallery } from "../pictures/gallery.js"
import { stateAt } from "../pictures/moment.js"
import { CALM, isEmbedded } from "../base/modes.js"

const SPEEDS = [0.25, 0.5, 1, 2, 4, 8]
// Shortest duration of the first playing, in seconds.
const GENTLE = 20
// Elements that handle arrow keys themselves.
const OWN_ARROWS = "input, button, a, summary, [role=slider]"
const PLAY = "M8 6v12l10-6z"
const PAUSE = "M8 6v12M16 6v12"
const BACK = "M6 7v10M18 7v10l-8-5z"
const FORWARD = "M18 7v10M6 7v10l8-5z"

/** @param {string} name @param {string} path @param {string} title @param {() => void} onclick */
const transport = (name, path, title, onclick) => (
  button(`transport.param-${name}`, onclick, { innerHTML: icon(path, "1.6em"), title, ariaLabel: title }))

/** Render the player. @param {{el: HTMLElement}} part */
export function render({ el }) {
  const slider = element("input.param-t", {
    type: "range", min: 0, step: "any", ariaLabel: "Time t", onchange: writeTime,
    oninput: () => {
      play(false)
      move(slider.valueAsNumber)
    },
  })
  // The clock is no live region, because screen readers would announce it all the time.
  const output = element("output", { ariaLive: "off" })
  const speed = element("select.param-speed", {
    ariaLabel: "Speed", title: "Speed: units of t per second", onchange: () => tell("url", { speed: speed.value }),
  }, ...SPEEDS.map((value) => new Option(`${value}×`, String(value))))
  const back = transport("back", BACK, "Step back (←)", () => step(-1))
  const toggle = transport("play", PLAY, "Play (Space)", () => play(!playing))
  const forward = transport("forward", FORWARD, "Step forward (→)", () => step(1))
  const items = [back, toggle, forward, slider, output, speed]
  const bar = element("div.player", { role: "group", ariaLabel: "Motion in time" }, ...items)
  el.append(bar)

  /** @type {Pick<SceneDescription, "dots" | "angles" | "pictures">} */
  let scene = { dots: {}, angles: [], pictures: [] }
  /** @type {Source | null} */
  let source = null
  let t = 0
  let playing = false
  // True if a click has chosen the start of the motion, which begins with the next state.
  let isStarting = false
  /** @type {number | null} */
  let last = null
  // The animation of a lesson.
  /** @type {PageEvents["run"]} */
  let run = null
  // Units of t per second of the first playing; else null.
  /** @type {number | null} */
  let gentle = null
  // Scenes that were played.
  const begun = new Set()
  let isWaiting = false
  // Motion takes the time of the browser, and on some machines that of the computation.
  let isComputing = false
  let isReading = false
  let isAlone = false

  const end = () => source?.data.t?.at(-1) ?? 0
  function writeTime() { tell("url", { t: t.toFixed(3) }) }
  function show() {
    const usable = source !== null && source.data.t?.length > 1
    const state = usable ? stateAt(source.data, scene.angles, t) : null
    slider.valueAsNumber = t
    output.textContent = `t = ${t.toFixed(2)}`
    slider.ariaValueText = `${output.textContent} of ${end().toFixed(2)}`
    tell("time", { t, state })
    for (const [name, [x, y]] of Object.entries(scene.dots)) {
      gallery.source(name).put(state ? { x: [state[x]], y: [state[y]] } : { x: [], y: [] })
    }
  }

  /** @param {number} to */
  function move(to) {
    t = within(to, 0, end())
    show()
  }

  /** @param {number} now */
  function frame(now) {
    if (!playing) return
    if (last !== null) {
      const rate = run ? (run.to - run.from) / run.seconds : gentle ?? Number(speed.value)
      const next = t + (rate * Math.min(100, now - last)) / 1000
      const isOver = run !== null && (next - run.to) * rate >= 0
      move(isOver ? run.to : run === null && next >= end() ? 0 : next)
      if (isOver) return play(false)
    }
    last = now
    requestAnimationFrame(frame)
  }

  /** @param {boolean} on */
  function play(on) {
    playing = on
    if (!on) run = gentle = null
    last = null
    relabel(toggle, on ? PAUSE : PLAY, on ? "Pause (Space)" : "Play (Space)")
    bar.dataset.playing = String(on)
    if (on) requestAnimationFrame(frame)
    else writeTime()
  }

  /** @param {number} direction */
  function step(direction) {
    play(false)
    move(t + direction * end() / 200)
    writeTime()
  }

  // Space plays unless a text box has the focus; arrows step where they have no other meaning.
  document.addEventListener("keydown", (event) => {
    if (isTaken(event) || toggle.hidden) return
    const [across] = arrowOf(event) ?? [0]
    const target = event.composedPath()[0]
    if (event.key === " ") {
      if (!event.repeat) play(!playing)
    } else if (across === 0 || (target instanceof HTMLElement && target.closest(OWN_ARROWS))) return
    else step(across)
    event.preventDefault()
  })
  // The browser presses a focused button when Space is released.
  document.addEventListener("keyup", (event) => {
    if (event.key === " " && !isTaken(event) && !toggle.hidden) event.preventDefault()
  })

  function playGently() {
    if (playing || end() === 0) return
    gentle = Math.min(Number(speed.value), end() / GENTLE)
    play(true)
  }

  const onData = () => {
    slider.max = String(end())
    // Keep the time while there is no motion.
    if (end() > 0 && t > end()) t = end()
    show()
  }
  listen({
    run(wanted) {
      play(false)
      if (wanted === null) return
      run = wanted
      move(run.from)
      play(true)
    },
    follow(time) {
      if (playing) play(false)
      move(Number(time))
    },
    pick({ pick: [picture], drag }) { isStarting ||= !drag && scene.pictures.some(({ name, starts }) => name === picture && starts) },
    // An example starts at its initial time.
    preset() { move(0) },
    alone(names) { isAlone = names.length > 0 },
    reading(on) { isReading = on },
    progress(progress) { isComputing = progress !== null },
    painted() {
      if (!isComputing) {
        if (isWaiting && (isAlone || !isReading)) playGently()
        isWaiting = false
      }
      if (!isStarting) return
      isStarting = false
      move(0)
      play(!CALM.matches)
    },
    // The next scene continues from this time.
    scene() { if (playing) play(false) },
    client(own) {
      t = Number(own.t)
      speed.value = String(SPEEDS.includes(Number(own.speed)) ? Number(own.speed) : 1)
    },
    enter(entered) {
      if (gentle !== null) play(false)
      // A link with a time shows that moment.
      const isMoment = begun.size === 0 && t !== 0
      isWaiting = !isMoment && !begun.has(entered.name) && !CALM.matches && !isEmbedded
      begun.add(entered.name)
      scene = entered
      source = gallery.source("data-orbit") ?? null
      // A scene without a motion has no player.
      for (const item of items) item.hidden = source === null
      source?.watch(onData)
      onData()
    },
  })
}
