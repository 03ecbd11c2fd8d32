// @ts-check
// A lesson beside the pictures, step by step, and suggestions to try in the scene on show.
//
// PageDown (the key of a presenter) shows the rest of the text, reveals the truth of a guess, then the answer of a question, then
// goes to the next step.  PageUp goes back.

import { stepControls } from "../controls/step_controls.js"
import { gallery } from "../pictures/gallery.js"
import { createGuess } from "../pictures/guess.js"
import { createVeil, lightNames } from "../pictures/layers.js"
import { createAnimation } from "./animation.js"
import { listen, tell } from "../base/bus.js"
import { onKeys } from "../base/keys.js"
import { button, element, say } from "../base/elements.js"
import { browserStore } from "../base/stores.js"
import { within } from "../base/numbers.js"
import { byHand, CALM, isEmbedded } from "../base/modes.js"

// One turn of the mouse wheel is one step.
const PAUSE = 700

/** Return whether the page is opened for the first time, by its bare address.  Programs that drive a browser get the whole page. */
export function isFirstVisit() {
  // Without storage, every visit would count as the first.
  const isFirst = location.search === "" && !navigator.webdriver && browserStore.works() && browserStore.get("introduced") === null
  if (isFirst) browserStore.set("introduced", "1")
  return isFirst
}

/** @param {string} name @param {string} words */
const html = (name, words) => element(name, { innerHTML: byHand(words) })

/** Bring a part of a step to the top, in a hall to the page of the slide that it begins on. @param {HTMLElement} part */
const toTop = (part) => part.scrollIntoView({ block: "start", inline: "start" })

/** Return the question of a step and its answer. @param {LessonStep} step @returns {HTMLElement[]} */
const questionOf = ({ question, answer }) => (question === "" ? [] : [
  html("div.question", question), element("details.answer", {
    // Keep clear of the buttons of the step.
    /** @param {{currentTarget: HTMLDetailsElement}} event */
    ontoggle({ currentTarget: item }) { if (item.open) toTop(item) },
  }, element("summary", "Answer"), html("div", answer)),
])

/**
 * Render the menu of lessons, the lesson and the suggestions.
 * @param {{index: PageModel["lessons"], record?: {box: HTMLElement, begin: HTMLElement}, el: HTMLElement}} part record: the recorder
 *   of lessons, if the page has one
 */
export function render({ index, record, el }) {
  const menu = element("details.lesson-menu", { hidden: index.length === 0 })
  const panel = element("section.lesson", { hidden: true, ariaLabel: "Lesson" })
  const audience = element("output.audience")
  const tries = element("section.tries", { hidden: true, ariaLabel: "Try this" })
  const controls = stepControls()
  const veil = createVeil()
  el.append(menu, ...(record ? [record.box] : []), panel, tries)
  lightNames(el)

  /** @type {Lesson | null} */
  let lesson = null
  let at = 0
  let turned = 0
  // These values belong to the current step and are reset with it.
  /** @type {ReturnType<typeof createGuess> | null} */
  let guess = null
  /** @type {HTMLButtonElement | null} */
  let revealing = null
  /** @type {ReturnType<typeof createAnimation> | null} */
  let animation = null
  /** @type {(() => void) | null} */
  let arriving = null
  /** @type {LessonStep | null} */
  let expected = null

  /** @param {string} name @param {number} number @param {boolean} revealed @param {() => void} then */
  const go = (name, number, revealed, then) => {
    arriving = then
    tell("step", [name, number, revealed])
  }

  // True if the step shows only its own pictures.
  const isAlone = () => lesson !== null && lesson.steps[at].pictures.length > 0

  function leaveStep() {
    guess?.end()
    animation?.stop()
    guess = animation = arriving = expected = null
  }

  /**
   * Enlarge the picture of a step and hide its layer.  In a scene that is entered this comes before the first painting: Bokeh
   * does not notice a picture that is enlarged and reduced again within a frame.
   * @param {LessonStep} step
   */
  function arrange({ scene, look, pictures, hide, prediction }) {
    if (gallery.shown?.name !== scene) return
    tell("alone", pictures)
    if (look !== "") tell("look", look)
    veil(prediction ?? hide ?? null)
  }

  // Shows a step whose state is shown or requested.
  function showStep() {
    leaveStep()
    const step = lesson.steps[at]
    const { prediction } = step
    const isLast = at === lesson.steps.length - 1
    const isAlone = step.pictures.length > 0
    const [said, buttons] = [element("output.said"), element("div.row")]
    say(audience, "")
    if (prediction) {
      guess = createGuess(prediction, (text) => { said.textContent = text })
      revealing = button("button.param-reveal", reveal, "Reveal")
      buttons.append(revealing)
    }
    if (step.animation) {
      animation = createAnimation(step.animation)
      buttons.append(button("button.param-animate", animation.start, animation.label))
    }
    expected = step
    panel.classList.toggle("alone", isAlone)
    const title = element("h2.title", { innerHTML: step.title, tabIndex: -1 })
    const progress = element("progress", { max: lesson.steps.length, value: at + 1, ariaLabel: "Steps" })
    panel.replaceChildren(
      element("p.of", lesson.title), title,
      element("div.slide", html("div.text", step.text), buttons, said, audience, ...questionOf(step)),
      element("div.steps", controls.group, element("div.row",
        button("button.param-back-a-step", back, {
          disabled: at === 0, title: at === 0 ? "Disabled: this is the first step" : "Back (Page Up)",
        }, "Back"),
        button("button.param-next-step", next, {
          disabled: isLast && !isAlone, title: isLast && !isAlone ? "Disabled: this is the last step" : "Next (Page Down)",
        }, !isAlone ? "Next" : isLast ? "The whole page" : "Go on ↓"),
        button("button.param-leave-lesson", leave, {
          hidden: isEmbedded, title: isAlone ? "Show the whole page (Esc)" : "Leave the lesson",
        }, isAlone ? "Skip" : "Leave"),
        element("div.where", progress, element("span.count", `${at + 1} / ${lesson.steps.length}`)))))
    controls.fill(step.controls, panel.querySelectorAll("button.drag"))
    said.hidden = guess === null
    buttons.hidden = guess === null && animation === null
    tell("url", { lesson: lesson.name, step: String(at + 1) })
  }

  /** Called when the state of the step is on show. @param {LessonStep} step */
  function arrive(step) {
    expected = null
    arrange(step)
    guess?.begin()
    if (!CALM.matches) animation?.start()
  }

  /** @param {number} number */
  function turnTo(number) {
    if (number < 0 || number >= lesson.steps.length) return
    at = number
    showStep()
    go(lesson.name, at, false, () => arrive(lesson.steps[at]))
    /** @type {HTMLElement} */
    const title = panel.querySelector(".title")
    title.focus({ preventScroll: true })
    panel.scrollIntoView({ block: "start" })
  }

  function reveal() {
    if (guess === null || guess.isRevealed) return false
    const [shown, pressed] = [guess, revealing]
    shown.wait()
    Object.assign(pressed, { disabled: true, title: "Disabled: already revealed" })
    go(lesson.name, at, true, () => {
      veil(lesson.steps[at].hide ?? null)
      shown.reveal()
      // The verdict on the guess stands under the button: scroll it above the buttons of the step.
      toTop(pressed)
    })
    return true
  }

  /** Turn the pages of a slide, and return whether there was one more. @param {1 | -1} by */
  function turnPage(by) {
    const slide = panel.querySelector(".slide")
    const before = slide.scrollLeft
    slide.scrollBy({ left: by * slide.clientWidth })
    return Math.round(slide.scrollLeft - before) !== 0
  }

  function back() {
    if (!turnPage(-1)) turnTo(at - 1)
  }

  function next() {
    if (turnPage(1) || reveal()) return
    /** @type {HTMLDetailsElement | null} */
    const answer = panel.querySelector(".answer:not([open])")
    if (answer !== null) answer.open = true
    else if (isAlone() && at === lesson.steps.length - 1) leave()
    else turnTo(at + 1)
  }

  /**
   * Begin a lesson.
   * @param {Lesson} given
   * @param {number} number the first step
   * @param {boolean} isHere whether a link has brought the state of that step
   */
  function begin(given, number, isHere) {
    lesson = given
    at = within(number, 0, lesson.steps.length - 1)
    panel.hidden = false
    menu.hidden = tries.hidden = true
    tell("reading", true)
    const here = () => (isHere ? arrive(lesson.steps[at]) : turnTo(at))
    const isPainted = gallery.shown !== null
    if (isHere || !isPainted) showStep()
    if (isPainted) here()
    else arriving = here
  }

  function leave() {
    leaveStep()
    veil(null)
    tell("alone", [])
    controls.fill([])
    lesson = null
    panel.hidden = true
    panel.replaceChildren()
    menu.hidden = index.length === 0
    tries.hidden = tries.childElementCount === 0
    tell("reading", false)
    tell("url", { lesson: "", step: "" })
  }

  menu.append(element("summary", "Lessons"), element("ul", ...index.map(({ name, title, minutes }) => (
    element("li", button(`button.param-lesson-${name}`, () => tell("lesson", name), `${title} (${minutes} min)`))))), ...(record ? [record.begin] : []))

  /** Show the suggestions for a scene, one at a time. @param {SceneDescription} scene */
  function showTries(scene) {
    const { name, tries: steps } = scene
    tries.replaceChildren()
    tries.hidden = steps.length === 0 || lesson !== null
    if (steps.length === 0) return
    let one = 0
    const title = element("h3")
    const text = element("div.text")
    /** @param {number} by */
    const turn = (by) => {
      one = (one + by + steps.length) % steps.length
      title.innerHTML = `Try this: ${steps[one].title}`
      text.innerHTML = byHand(steps[one].text)
      text.append(...questionOf(steps[one]))
      count.textContent = `${one + 1} / ${steps.length}`
    }
    const perform = () => {
      animation?.stop()
      const step = steps[one]
      animation = step.animation && createAnimation(step.animation)
      go(name, one, false, () => arrive(step))
    }
    const count = element("span.count")
    tries.append(title, text, element("div.row",
      button("button.param-try", perform, "Do it for me"),
      button("button.param-try-before", () => turn(-1), { ariaLabel: "Previous" }, "‹"), count,
      button("button.param-try-next", () => turn(1), { ariaLabel: "Next" }, "›")))
    turn(0)
  }

  // A link to a state leads there within the page, unless a key asks the browser for a new tab.
  el.addEventListener("click", (event) => {
    const link = event.target instanceof Element ? event.target.closest("a") : null
    const target = link?.getAttribute("href") ?? ""
    if (!target.startsWith("?") || event.ctrlKey || event.metaKey || event.shiftKey) return
    event.preventDefault()
    animation?.stop()
    tell("restore", target.slice(1))
  })
  listen({
    enter(scene) {
      showTries(scene)
      // Run after all parts of the page know the scene, and before it is painted.
      queueMicrotask(() => { if (expected !== null) arrange(expected) })
    },
    audience: (text) => say(audience, text),
    painted() {
      const then = arriving
      arriving = null
      then?.()
    },
    "lesson-read": ({ lesson: given, step }) => begin(given, step ?? 0, step !== null),
  })
  addEventListener("wheel", (event) => {
    if (!isAlone()) return
    // Reset the zoom of all pictures.
    event.preventDefault()
    event.stopPropagation()
    if (event.deltaY <= 0 || event.timeStamp - turned < PAUSE) return
    turned = event.timeStamp
    next()
  }, { capture: true, passive: false })
  onKeys({
    pagedown: () => lesson !== null && next(), pageup: () => lesson !== null && back(), escape: () => isAlone() && leave(),
  })
}
