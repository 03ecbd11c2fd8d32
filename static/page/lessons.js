// A lesson beside the pictures, step by step, and what can be tried in the scene on show.
//
// PageDown, which a clicker sends, does what comes next: it reveals the truth of a guess, then the answer of a question,
// then goes on.  PageUp goes a step back.

import { gallery } from "../pictures/gallery.js"
import { createGuess } from "../pictures/guess.js"
import { createAnimation } from "./animation.js"
import { listen, tell } from "./bus.js"
import { onKeys } from "./keys.js"
import { element } from "./mount.js"
import { CALM } from "./windows.js"

const SECOND = 1000

const html = (tag, className, innerHTML) => element(tag, { className, innerHTML })
const clock = (ms) => `${Math.floor(ms / 60000)}:${String(Math.floor(ms / SECOND) % 60).padStart(2, "0")}`

function button(name, label, onClick, properties = {}) {
  const item = element("button", { type: "button", className: `button param-${name}`, textContent: label, ...properties })
  item.addEventListener("click", onClick)
  return item
}

// What a step asks: {element, open()}; open() is false where there is nothing more to open.
function questionOf({ question, answer }) {
  if (question === "") return { parts: [], open: () => false }
  const details = element("details", { className: "answer" }, element("summary", { textContent: "Answer" }), html("div", "", answer))
  return {
    parts: [html("div", "question", question), details],
    open() {
      if (details.open) return false
      details.open = true
      return true
    },
  }
}

export function render({ index, el, signal }) {
  const menu = element("details", { className: "lesson-menu" })
  const panel = element("section", { className: "lesson", hidden: true, "aria-label": "Lesson" })
  const tries = element("section", { className: "tries", hidden: true, "aria-label": "Try this" })
  el.append(menu, panel, tries)

  let lesson = null
  let wanted = null
  let at = 0
  let begun = 0
  // What the step on show can open next, and what ends with it.
  let question = questionOf({ question: "" })
  let guess = null
  let animation = null
  let arriving = null
  let ticking = null

  const go = (name, number, revealed, then) => {
    arriving = then
    tell("step", [name, number, revealed])
  }

  function leaveStep() {
    guess?.end()
    animation?.stop()
    guess = animation = arriving = null
  }

  // The step as it is shown; its state is on its way, or on show already.
  function showStep() {
    leaveStep()
    const step = lesson.steps[at]
    question = questionOf(step)
    const { prediction } = step
    const isLast = at === lesson.steps.length - 1
    const [said, buttons] = [element("output", { className: "said" }), element("div", { className: "row" })]
    if (prediction) {
      guess = createGuess(prediction, (text) => { said.textContent = text })
      buttons.append(button("reveal", "Reveal", reveal))
    }
    if (step.animation) {
      animation = createAnimation(step.animation)
      buttons.append(button("animate", animation.label, animation.start))
    }
    const title = html("h2", "title", step.title)
    title.tabIndex = -1
    const progress = element("progress", { max: lesson.steps.length, value: at + 1, "aria-label": "Steps" })
    const time = element("span", { className: "timer", role: "timer", "aria-label": "Time since the lesson began" })
    const tick = () => { time.textContent = `${clock(performance.now() - begun)} of ${lesson.minutes} min` }
    tick()
    clearInterval(ticking)
    ticking = setInterval(tick, SECOND)
    panel.replaceChildren(
      element("p", { className: "of", textContent: lesson.title }),
      element("div", { className: "row where" }, progress,
        element("span", { className: "count", textContent: `${at + 1} / ${lesson.steps.length}` }), time),
      title, html("div", "text", step.text), buttons, said, ...question.parts,
      element("div", { className: "row steps" },
        button("back-a-step", "Back", () => turnTo(at - 1), {
          disabled: at === 0, title: at === 0 ? "Disabled: this is the first step" : "Back (Page Up)",
        }),
        button("next-step", "Next", next, {
          disabled: isLast, title: isLast ? "Disabled: this is the last step" : "What comes next (Page Down)",
        }),
        button("leave-lesson", "Leave the lesson", leave)))
    for (const item of [buttons, said]) item.hidden = !prediction && !(item === buttons && step.animation)
    tell("url", { lesson: lesson.name, step: String(at + 1) })
  }

  // The state of the step is on show.
  function arrive() {
    const step = lesson.steps[at]
    if (step.look !== "") tell("look", step.look)
    guess?.begin()
    if (animation !== null && !CALM.matches) animation.start()
  }

  function turnTo(number) {
    if (number < 0 || number >= lesson.steps.length) return
    at = number
    showStep()
    go(lesson.name, at, false, arrive)
    panel.querySelector(".title").focus({ preventScroll: true })
    panel.scrollIntoView({ block: "start" })
  }

  function reveal() {
    if (guess === null || guess.isRevealed) return false
    const shown = guess
    shown.wait()
    go(lesson.name, at, true, shown.reveal)
    return true
  }

  function next() {
    if (!reveal() && !question.open()) turnTo(at + 1)
  }

  // `number`: of its first step on show; a link has brought the state along.
  function begin(given, number, isHere) {
    lesson = given
    at = Math.max(0, Math.min(number, lesson.steps.length - 1))
    begun = performance.now()
    panel.hidden = false
    menu.hidden = tries.hidden = true
    tell("reading", true)
    if (isHere) {
      showStep()
      if (gallery.shown === null) arriving = arrive
      else arrive()
    } else turnTo(at)
  }

  function leave() {
    leaveStep()
    clearInterval(ticking)
    lesson = null
    panel.hidden = true
    panel.replaceChildren()
    menu.hidden = false
    tries.hidden = tries.childElementCount === 0
    tell("reading", false)
    tell("url", { lesson: "", step: "" })
  }

  menu.append(element("summary", { textContent: "Lessons" }), element("ul", {}, ...index.map(({ name, title, minutes }) => (
    element("li", {}, button(`lesson-${name}`, `${title} (${minutes} min)`, () => {
      wanted = name
      tell("lesson", name)
    }))))))

  // What can be tried in this scene, one at a time.
  function showTries(scene) {
    const { name, tries: steps } = scene
    tries.replaceChildren()
    tries.hidden = steps.length === 0 || lesson !== null
    if (steps.length === 0) return
    let one = 0
    const title = element("h3", {})
    const text = element("div", { className: "text" })
    const turn = (by) => {
      one = (one + by + steps.length) % steps.length
      title.innerHTML = `Try this: ${steps[one].title}`
      text.innerHTML = steps[one].text
      const { parts } = questionOf(steps[one])
      text.append(...parts)
      count.textContent = `${one + 1} / ${steps.length}`
    }
    const perform = () => {
      animation?.stop()
      animation = steps[one].animation ? createAnimation(steps[one].animation) : null
      const { look } = steps[one]
      go(name, one, false, () => {
        if (look !== "") tell("look", look)
        if (!CALM.matches) animation?.start()
      })
    }
    const count = element("span", { className: "count" })
    tries.append(title, text, element("div", { className: "row" },
      button("try", "Do it for me", perform),
      button("try-before", "‹", () => turn(-1), { "aria-label": "The one before" }), count,
      button("try-next", "›", () => turn(1), { "aria-label": "The next one" })))
    turn(0)
  }

  listen("enter", showTries, signal)
  listen("painted", () => {
    const then = arriving
    arriving = null
    then?.()
  }, signal)
  listen("lesson-read", ({ lesson: given, step }) => {
    if (step !== null) begin(given, step, true)
    else if (given.name === wanted) begin(given, 0, false)
    wanted = null
  }, signal)
  onKeys({ pagedown: () => lesson !== null && next(), pageup: () => lesson !== null && turnTo(at - 1) }, signal)
  signal.addEventListener("abort", () => {
    clearInterval(ticking)
    leaveStep()
  })
}
