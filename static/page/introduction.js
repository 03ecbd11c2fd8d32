// @ts-check
// The introduction for a first visitor: one large dark picture, one sentence, one thing to drag.  By scrolling or a key the other
// pictures come in one at a time, until the whole page stands.  It is shown once, and never for a link with a state.

import { stepControls } from "../controls/step_controls.js"
import { listen, tell } from "../base/bus.js"
import { button, element } from "../base/elements.js"
import { onKeys } from "../base/keys.js"
import { browserStore } from "../base/stores.js"

// One turn of a wheel brings one picture.
const PAUSE = 700

/** @type {{picture: string, controls: string[], sentence: string, hint: string}[]} */
const STEPS = [
  {
    picture: "body", controls: ["phi0"], sentence: "No friction, and yet it forgets how it started.",
    hint: "Drag φ₀, the start: at first it matters, soon it does not.",
  },
  {
    picture: "surface", controls: ["phi0"], sentence: "Its motion lies on a torus, and gathers on one curve.",
    hint: "Every start but one goes to the green cycle. Only a motion on the orange one stays there.",
  },
  {
    picture: "circle", controls: ["I23"], sentence: "One turn is a map of a circle.",
    hint: "Drag I₂₃ towards 0: the two crossings meet and vanish, and nothing is forgotten any more.",
  },
  {
    picture: "bifurcation", controls: [], sentence: "Two numbers decide: the energy h and the area integral f.",
    hint: "Drag the ring: in the violet zone the motion forgets.",
  },
]

/** Return whether the page is opened for the first time, by its bare address.  Programs that drive a browser get the whole page. */
function isFirstVisit() {
  // Without a store every visit would be the first.  A link opens its state.
  return location.search === "" && !navigator.webdriver && browserStore.works() && browserStore.get("introduced") === null
}

/** Render the introduction. @param {{el: HTMLElement}} part */
export function render({ el }) {
  if (!isFirstVisit()) return
  const { group, fill } = stepControls(() => true)
  const sentence = element("p.sentence", { ariaLive: "polite" })
  const hint = element("p.hint")
  const more = button("button.param-go-on", next)
  const box = element("section.introduction", { ariaLabel: "Introduction" }, sentence, hint, group,
    element("div.row", more, button("button.param-skip-introduction", end, { title: "Show the whole page (Esc)" }, "Skip")))
  let at = -1
  let turned = 0
  const isOn = () => at >= 0 && at < STEPS.length

  function show() {
    const { controls, sentence: words, hint: how } = STEPS[at]
    sentence.textContent = words
    hint.textContent = how
    fill(controls)
    more.textContent = at + 1 < STEPS.length ? "Go on ↓" : "The whole page"
    tell("introduce", STEPS.slice(0, at + 1).map(({ picture }) => picture))
  }

  /** @param {number} step */
  function go(step) {
    at = step
    if (isOn()) return show()
    box.remove()
    tell("introduce", null)
  }
  function next() { go(at + 1) }
  function end() { if (isOn()) go(STEPS.length) }

  addEventListener("wheel", (event) => {
    if (!isOn()) return
    // No picture is zoomed.
    event.preventDefault()
    event.stopPropagation()
    if (event.deltaY <= 0 || event.timeStamp - turned < PAUSE) return
    turned = event.timeStamp
    next()
  }, { capture: true, passive: false })
  onKeys({ pagedown: () => isOn() && next(), escape: () => isOn() && end() })
  listen({
    enter() {
      if (at >= 0) return
      browserStore.set("introduced", "1")
      el.append(box)
      next()
    },
  })
}
