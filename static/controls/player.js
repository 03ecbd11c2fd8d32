// The player: play, pause, step, speed and the time slider.  It interpolates the moving point from the samples of the orbit
// that the page already has, so nothing is requested while it plays.
// Tells "time" {t, state} to whatever draws the point, and fills the sources of single points.

import { button, element, icon, relabel } from "../page/elements.js"
import { listen, tell } from "../page/bus.js"
import { arrowOf, isTaken } from "../page/keys.js"
import { gallery } from "../pictures/gallery.js"
import { stateAt } from "../pictures/moment.js"
import { isFolded } from "../pictures/picture.js"
import { opening } from "./opening.js"

const SPEEDS = [0.25, 0.5, 1, 2, 4, 8]
// Seconds from the beginning of a motion to its end, at least, while nobody has touched anything.
const GENTLE = 20
// Where an arrow means something already.
const OWN_ARROWS = "input, button, a, summary, [role=slider]"
const PLAY = "M8 5v14l11-7z"
const PAUSE = "M6 5h4v14H6zm8 0h4v14h-4z"
const BACK = "M6 6h2v12H6zm3.5 6 8.5 6V6z"
const FORWARD = "M16 6h2v12h-2zM6 18l8.5-6L6 6z"

const transport = (name, path, title, onclick) => (
  button(`transport.param-${name}`, onclick, { innerHTML: icon(path, "1.6em"), title, ariaLabel: title }))

// A button that shows a picture which is not seen at first, or folds it again.
const unfolding = ({ name, folded: label }) => button(`button.unfold.unfold-${name}`, () => tell("fold", name), {
  title: label, ariaLabel: label, ariaExpanded: !isFolded(gallery.cell(name)),
}, `+ ${label.replace(/^Show (the )?/, "")}`)

export function render({ el }) {
  const slider = element("input.param-t", {
    type: "range", min: 0, step: "any", ariaLabel: "Time t", onchange: writeTime,
    oninput: () => {
      play(false)
      move(Number(slider.value))
    },
  })
  const output = element("output")
  const speed = element("select.param-speed", {
    ariaLabel: "Speed", title: "Speed: units of t per second", onchange: () => announce({ speed: speed.value }),
  }, ...SPEEDS.map((value) => new Option(`${value}×`, value)))
  const back = transport("back", BACK, "Step back (←)", () => step(-1))
  const toggle = transport("play", PLAY, "Play (Space)", () => play(!playing))
  const forward = transport("forward", FORWARD, "Step forward (→)", () => step(1))
  const folds = element("span.folds")
  const items = [back, toggle, forward, slider, output, speed]
  const bar = element("div.player", { role: "group", ariaLabel: "Motion in time" }, ...items, folds)
  el.append(bar)

  let scene = { dots: {}, angles: [], pictures: [] }
  let source = null
  let t = 0
  let playing = false
  let last = null
  // Of a lesson: from, to, in so many seconds.
  let run = null
  // Units of t per second while nobody has touched anything, see "opening.js"; else null.
  let gentle = null

  const end = () => source?.data.t?.at(-1) ?? 0
  const announce = (keys) => tell("url", keys)
  function writeTime() { announce({ t: t.toFixed(3) }) }
  function show() {
    const usable = source !== null && source.data.t?.length > 1
    const state = usable ? stateAt(source.data, scene.angles, t) : null
    for (const [name, [x, y]] of Object.entries(scene.dots)) {
      gallery.source(name).put(state ? { x: [state[x]], y: [state[y]] } : { x: [], y: [] })
    }
    slider.value = t
    output.textContent = `t = ${t.toFixed(2)}`
    slider.ariaValueText = `${output.textContent} of ${end().toFixed(2)}`
    tell("time", { t, state })
  }

  function move(to) {
    t = Math.max(0, Math.min(end(), to))
    show()
  }

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

  function play(on) {
    playing = on
    if (!on) run = gentle = null
    last = null
    relabel(toggle, on ? PAUSE : PLAY, on ? "Pause (Space)" : "Play (Space)")
    bar.dataset.playing = on
    if (on) requestAnimationFrame(frame)
    else writeTime()
  }

  function step(direction) {
    play(false)
    move(t + direction * end() / 200)
    writeTime()
  }

  // Space plays whatever has the focus but a text box; arrows step where they mean nothing else.
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
  // A button would be pressed when the key is let go.
  document.addEventListener("keyup", (event) => {
    if (event.key === " " && !isTaken(event) && !toggle.hidden) event.preventDefault()
  })
  const start = opening({
    begin() {
      if (playing || end() === 0) return
      gentle = Math.min(Number(speed.value), end() / GENTLE)
      play(true)
    },
    end() { if (gentle !== null) play(false) },
    isOwn: (event) => event.composedPath().includes(toggle) || (event.key === " " && !isTaken(event)),
  })

  const onData = () => {
    slider.max = end()
    // Where there is nothing to see the time waits.
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
    // The player of the next scene goes on from here.
    scene() { if (playing) play(false) },
    folded({ name, folded }) { folds.querySelector(`.unfold-${name}`).ariaExpanded = !folded },
    client(own) {
      t = Number(own.t)
      // A link that names a time is one to that moment.
      if (t !== 0) start.rest()
      speed.value = SPEEDS.includes(Number(own.speed)) ? Number(own.speed) : 1
    },
    enter(entered) {
      start.enter(entered.name)
      scene = entered
      source = gallery.source("data-orbit") ?? null
      // A scene without a motion needs no time.
      for (const item of items) item.hidden = source === null
      folds.replaceChildren(...entered.pictures.filter(({ folded }) => folded !== null).map(unfolding))
      source?.watch(onData)
      onData()
    },
  })
}
