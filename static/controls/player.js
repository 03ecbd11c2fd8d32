// Play, pause, step, speed and the time slider.  The moving point is computed here, from the
// samples of the orbit that the page already has: no traffic while it plays.
// Tells "time" {t, state} to whoever draws the point, and moves the sources of one point.

import { listen, tell } from "../page/bus.js"
import { isTaken } from "../page/keys.js"
import { element, lifetime } from "../page/mount.js"
import { wear } from "../page/presenting.js"
import { gallery } from "../pictures/gallery.js"
import { between } from "../pictures/moment.js"
import { opening } from "./opening.js"

const SPEEDS = [0.25, 0.5, 1, 2, 4, 8]
// Seconds from the beginning of a motion to its end, at least, while nobody has touched anything.
const GENTLE = 20
// Where an arrow means something already.
const OWN_ARROWS = "input, button, a, summary, [role=slider]"
const ICONS = {
  play: "M8 5v14l11-7z",
  pause: "M6 5h4v14H6zm8 0h4v14h-4z",
  back: "M6 6h2v12H6zm3.5 6 8.5 6V6z",
  forward: "M16 6h2v12h-2zM6 18l8.5-6L6 6z",
}

// [button, set(icon, label)].
function button(name, label, onClick) {
  const item = element("button", { type: "button", className: `transport param-${name}` })
  item.innerHTML = `<svg viewBox="0 0 24 24" width="1.6em" height="1.6em" aria-hidden="true"><path fill="currentColor"/></svg>`
  item.addEventListener("click", onClick)
  const set = (icon, text) => {
    item.querySelector("path").setAttribute("d", ICONS[icon])
    item.setAttribute("aria-label", text)
    item.title = text
  }
  set(name, label)
  return [item, set]
}

// The columns of `data` at a time; `angles`: those that may jump by a turn.
function stateAt(data, angles, time) {
  const [i, s] = between(data.t, time)
  const state = {}
  for (const [name, column] of Object.entries(data)) {
    const [a, b] = [column[i], column[i + 1]]
    // An angle that crosses ±π between two samples is not interpolated.
    const jump = angles.includes(name) && Math.abs(b - a) > 1
    state[name] = jump ? (s < 0.5 ? a : b) : a + s * (b - a)
  }
  return state
}

// A button that shows a picture which is not seen at first, or folds it again.
function unfolding({ name, folded: label }) {
  const cell = gallery.shown.cells.find((one) => one.dataset.name === name)
  const item = element("button", {
    type: "button", className: `button unfold unfold-${name}`, title: label, "aria-label": label,
    textContent: `+ ${label.replace(/^Show (the )?/, "")}`,
  })
  item.setAttribute("aria-expanded", String(!cell.classList.contains("folded")))
  item.addEventListener("click", () => tell("fold", name))
  return item
}

export function render({ model, view, el }) {
  const signal = lifetime({ model, view })
  const slider = element("input", { type: "range", className: "param-t", min: 0, step: "any", "aria-label": "Time t" })
  const output = element("output")
  const speed = element("select", {
    className: "param-speed", "aria-label": "Speed", title: "Speed: units of t per second",
  }, ...SPEEDS.map((value) => new Option(`${value}×`, value)))
  const bar = element("div", { className: "player", role: "group", "aria-label": "Motion in time" })

  let scene = { dots: {}, angles: [], pictures: [] }
  let source = null
  let watching = null
  let t = 0
  const begin = (own) => {
    t = Number(own.t)
    // A link that names a time is one to that moment.
    if (t !== 0) start.rest()
    speed.value = SPEEDS.includes(Number(own.speed)) ? Number(own.speed) : 1
  }
  let playing = false
  let last = null
  // Of a lesson: from, to, in so many seconds.
  let run = null
  // Units of t per second while nobody has touched anything, see "opening.js"; else null.
  let gentle = null

  const end = () => {
    const times = source?.data.t
    return times?.length ? times[times.length - 1] : 0
  }
  const announce = (keys) => tell("url", keys)

  function show() {
    const usable = source !== null && source.data.t?.length > 1
    const state = usable ? stateAt(source.data, scene.angles, t) : null
    for (const [name, [x, y]] of Object.entries(scene.dots)) {
      gallery.source(name).put(state ? { x: [state[x]], y: [state[y]] } : { x: [], y: [] })
    }
    slider.value = t
    output.textContent = `t = ${t.toFixed(2)}`
    slider.setAttribute("aria-valuetext", `t = ${t.toFixed(2)} of ${end().toFixed(2)}`)
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
    setPlay(on ? "pause" : "play", on ? "Pause (Space)" : "Play (Space)")
    bar.dataset.playing = on
    if (on) requestAnimationFrame(frame)
    else announce({ t: t.toFixed(3) })
  }

  const step = (direction) => {
    play(false)
    move(t + direction * end() / 200)
    announce({ t: t.toFixed(3) })
  }

  const [back] = button("back", "Step back (←)", () => step(-1))
  const [toggle, setPlay] = button("play", "Play (Space)", () => play(!playing))
  const [forward] = button("forward", "Step forward (→)", () => step(1))
  slider.addEventListener("input", () => { play(false); move(Number(slider.value)) })
  slider.addEventListener("change", () => announce({ t: t.toFixed(3) }))
  speed.addEventListener("change", () => announce({ speed: speed.value }))
  const folds = element("span", { className: "folds" })
  bar.append(back, toggle, forward, slider, output, speed, folds)
  el.append(bar)

  // Space plays whatever has the focus but a text box; arrows step where they mean nothing else.
  const onKey = (event) => {
    const target = event.composedPath()[0]
    if (isTaken(event) || toggle.hidden) return
    if (event.key === " ") {
      if (!event.repeat) play(!playing)
    } else if (target instanceof HTMLElement && target.closest(OWN_ARROWS)) return
    else if (event.key === "ArrowLeft") step(-1)
    else if (event.key === "ArrowRight") step(1)
    else return
    event.preventDefault()
  }
  document.addEventListener("keydown", onKey, { signal })
  // A button would be pressed when the key is let go.
  document.addEventListener("keyup", (event) => {
    if (event.key === " " && !isTaken(event) && !toggle.hidden) event.preventDefault()
  }, { signal })
  listen("run", (wanted) => {
    play(false)
    if (wanted === null) return
    run = wanted
    move(run.from)
    play(true)
  }, signal)
  listen("follow", (time) => {
    if (playing) play(false)
    move(Number(time))
  }, signal)
  // The player of the next scene goes on from here.
  listen("scene", () => { if (playing) play(false) }, signal)

  const start = opening({
    begin() {
      if (playing || end() === 0) return
      gentle = Math.min(Number(speed.value), end() / GENTLE)
      play(true)
    },
    end() { if (gentle !== null) play(false) },
    isOwn: (event) => event.composedPath().includes(toggle) || (event.key === " " && !isTaken(event)),
  }, signal)

  const onData = () => {
    slider.max = end()
    // Where there is nothing to see the time waits.
    if (end() > 0 && t > end()) t = end()
    show()
  }
  const enter = (entered) => {
    watching?.abort()
    watching = new AbortController()
    start.enter(entered.name)
    scene = entered
    source = gallery.source("data-orbit") ?? null
    // A scene without a motion needs no time.
    for (const item of [back, toggle, forward, slider, output, speed]) item.hidden = source === null
    folds.replaceChildren(...entered.pictures.filter(({ folded }) => folded !== null).map(unfolding))
    source?.watch(onData, watching.signal)
    onData()
  }
  listen("folded", ({ name, folded }) => {
    folds.querySelector(`.unfold-${name}`).setAttribute("aria-expanded", String(!folded))
  }, signal)
  wear(el, signal)
  listen("client", begin, signal)
  listen("enter", enter, signal)
  tell("mounted", { kind: "client", show: begin })
  tell("mounted", { kind: "scene", show: enter })
  signal.addEventListener("abort", () => {
    playing = false
    watching?.abort()
  })
}
