// A lesson beside the pictures, step by step, and what can be tried in the scene on show.
//
// PageDown, which a clicker sends, does what comes next: it reveals the truth of a guess, then the answer of a question,
// then goes on.  PageUp goes a step back.

import { gallery } from "../pictures/gallery.js"
import { createGuess } from "../pictures/guess.js"
import { createAnimation } from "./animation.js"
import { listen, tell } from "./bus.js"
import { onKeys } from "./keys.js"
import { button, element } from "./elements.js"
import { CALM } from "./windows.js"

const SECOND = 1000

const html = (name, innerHTML) => element(name, { innerHTML })
const clock = (ms) => `${Math.floor(ms / 60000)}:${String(Math.floor(ms / SECOND) % 60).padStart(2, "0")}`

// The question of a step, and its answer.
const questionOf = ({ question, answer }) => (question === "" ? [] : [
  html("div.question", question), element("details.answer", element("summary", "Answer"), html("div", answer)),
])

export function render({ index, el }) {
  const menu = element("details.lesson-menu")
  const panel = element("section.lesson", { hidden: true, ariaLabel: "Lesson" })
  const tries = element("section.tries", { hidden: true, ariaLabel: "Try this" })
  el.append(menu, panel, tries)

  let lesson = null
  let wanted = null
  let at = 0
  let begun = 0
  // These belong to the step on show and end with it.
  let guess = null
  let animation = null
  let arriving = null
  let ticking = null

  const time = element("span.timer", { role: "timer", ariaLabel: "Time since the lesson began" })
  const tick = () => { time.textContent = `${clock(performance.now() - begun)} of ${lesson.minutes} min` }

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
    const { prediction } = step
    const isLast = at === lesson.steps.length - 1
    const [said, buttons] = [element("output.said"), element("div.row")]
    if (prediction) {
      guess = createGuess(prediction, (text) => { said.textContent = text })
      buttons.append(button("button.param-reveal", reveal, "Reveal"))
    }
    if (step.animation) {
      animation = createAnimation(step.animation)
      buttons.append(button("button.param-animate", animation.start, animation.label))
    }
    const title = element("h2.title", { innerHTML: step.title, tabIndex: -1 })
    const progress = element("progress", { max: lesson.steps.length, value: at + 1, ariaLabel: "Steps" })
    panel.replaceChildren(
      element("p.of", lesson.title),
      element("div.row.where", progress,
        element("span.count", `${at + 1} / ${lesson.steps.length}`), time),
      title, html("div.text", step.text), buttons, said, ...questionOf(step),
      element("div.row.steps",
        button("button.param-back-a-step", () => turnTo(at - 1), {
          disabled: at === 0, title: at === 0 ? "Disabled: this is the first step" : "Back (Page Up)",
        }, "Back"),
        button("button.param-next-step", next, {
          disabled: isLast, title: isLast ? "Disabled: this is the last step" : "What comes next (Page Down)",
        }, "Next"),
        button("button.param-leave-lesson", leave, "Leave the lesson")))
    said.hidden = guess === null
    buttons.hidden = guess === null && animation === null
    tell("url", { lesson: lesson.name, step: String(at + 1) })
  }

  // The state of the step is on show.
  function arrive({ look }) {
    if (look !== "") tell("look", look)
    guess?.begin()
    if (!CALM.matches) animation?.start()
  }

  function turnTo(number) {
    if (number < 0 || number >= lesson.steps.length) return
    at = number
    showStep()
    go(lesson.name, at, false, () => arrive(lesson.steps[at]))
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
    if (reveal()) return
    const answer = panel.querySelector(".answer:not([open])")
    if (answer === null) turnTo(at + 1)
    else answer.open = true
  }

  // `number`: of its first step on show; a link has brought the state along.
  function begin(given, number, isHere) {
    lesson = given
    at = Math.max(0, Math.min(number, lesson.steps.length - 1))
    begun = performance.now()
    tick()
    clearInterval(ticking)
    ticking = setInterval(tick, SECOND)
    panel.hidden = false
    menu.hidden = tries.hidden = true
    tell("reading", true)
    if (isHere) {
      showStep()
      const here = () => arrive(lesson.steps[at])
      if (gallery.shown === null) arriving = here
      else here()
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

  menu.append(element("summary", "Lessons"), element("ul", ...index.map(({ name, title, minutes }) => (
    element("li", button(`button.param-lesson-${name}`, () => {
      wanted = name
      tell("lesson", name)
    }, `${title} (${minutes} min)`))))))

  // What can be tried in this scene, one at a time.
  function showTries(scene) {
    const { name, tries: steps } = scene
    tries.replaceChildren()
    tries.hidden = steps.length === 0 || lesson !== null
    if (steps.length === 0) return
    let one = 0
    const title = element("h3")
    const text = element("div.text")
    const turn = (by) => {
      one = (one + by + steps.length) % steps.length
      title.innerHTML = `Try this: ${steps[one].title}`
      text.innerHTML = steps[one].text
      text.append(...questionOf(steps[one]))
      count.textContent = `${one + 1} / ${steps.length}`
    }
    const perform = () => {
      animation?.stop()
      animation = steps[one].animation && createAnimation(steps[one].animation)
      const step = steps[one]
      go(name, one, false, () => arrive(step))
    }
    const count = element("span.count")
    tries.append(title, text, element("div.row",
      button("button.param-try", perform, "Do it for me"),
      button("button.param-try-before", () => turn(-1), { ariaLabel: "The one before" }, "‹"), count,
      button("button.param-try-next", () => turn(1), { ariaLabel: "The next one" }, "›")))
    turn(0)
  }

  listen({
    enter: showTries,
    painted() {
      const then = arriving
      arriving = null
      then?.()
    },
    "lesson-read"({ lesson: given, step }) {
      if (step !== null) begin(given, step, true)
      else if (given.name === wanted) begin(given, 0, false)
      wanted = null
    },
  })
  onKeys({ pagedown: () => lesson !== null && next(), pageup: () => lesson !== null && turnTo(at - 1) })
}
