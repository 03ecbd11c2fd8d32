// @ts-check
// Layers of pictures in a lesson: it hides one at a time, with its label and the captions that would reveal it.  A link to a layer
// highlights it while the link has the pointer or the focus; a click puts its picture in the lead.

import { tell } from "../base/bus.js"
import { clipTo } from "./frame.js"
import { gallery } from "./gallery.js"
import { linesOf, overlay } from "./guess.js"
import { circlePath, linePath } from "./looks.js"

/** @typedef {{picture: string, source: string}} Layer a layer by its data source */

/** @param {string} picture @returns {PlotView | undefined} */
const plotOf = (picture) => gallery.plots.find(({ model }) => model.name === picture)

/** @param {Layer | null} layer @returns {BokehModel[]} */
function renderersOf(layer) {
  // The label names the layer where it is.
  const sources = [layer?.source, `${layer?.source}-label`]
  return plotOf(layer?.picture)?.model.renderers.filter(({ data_source: data }) => sources.includes(data?.name)) ?? []
}

/** Return the function that hides a layer of the scene on show or what a guess is about, and shows what it has hidden before. */
export function createVeil() {
  /** @type {BokehModel[]} */
  let hidden = []
  /** @type {HTMLElement[]} */
  let silent = []
  return (/** @type {Layer | Prediction | null} */ layer) => {
    for (const cell of silent) cell.classList.remove("veiled")
    // A guess is about the whole state, which any picture may tell; a hidden layer about its own picture.
    silent = layer === null ? [] : "what" in layer ? gallery.shown.cells : [gallery.cell(layer.picture)]
    for (const cell of silent) cell.classList.add("veiled")
    const next = renderersOf(layer)
    for (const renderer of hidden) if (!next.includes(renderer)) renderer.visible = true
    for (const renderer of next) renderer.visible = false
    hidden = next
  }
}

const [GLOW, WIDTH, RING] = ["rgba(230, 159, 0, 0.5)", 16, 12]

/** Light up what the words in an element name. @param {HTMLElement} el */
export function lightNames(el) {
  /** @type {ReturnType<typeof overlay> | null} */
  let over = null
  const dim = () => {
    over?.remove()
    over = null
  }

  /** @param {Event} event @returns {string[]} picture and layer */
  const named = ({ target }) => /** @type {HTMLButtonElement | null} */ (/** @type {Element} */ (target).closest(".names"))?.value.split("/") ?? []

  /** @param {Event} event */
  function light(event) {
    const [picture, layer] = named(event)
    const plot = plotOf(picture)
    // A hidden layer is not lit up: it may be the answer of a guess.
    const renderer = plot?.model.renderers.find(({ name, visible }) => name === layer && visible)
    if (renderer === undefined) return
    dim()
    const { glyph: { type, x, y, xs = x, ys = y }, data_source: { name: source } } = renderer
    over = overlay(plot, "glow", { ariaHidden: true }, "pointer-events: none", (ctx) => {
      clipTo(ctx, plot.frame.bbox)
      for (const line of linesOf({ source, columns: [xs.field, ys.field], what: type === "Scatter" ? "point" : "curve" })) {
        const points = line.map(over.toPixels)
        if (points.length === 1) circlePath(ctx, ...points[0], RING)
        else linePath(ctx, points)
        ctx.lineWidth = WIDTH
        ctx.strokeStyle = GLOW
        ctx.stroke()
      }
    })
    over.draw()
  }

  for (const name of ["pointerover", "focusin"]) el.addEventListener(name, light)
  for (const name of ["pointerout", "focusout"]) el.addEventListener(name, dim)
  el.addEventListener("click", (event) => {
    const [picture] = named(event)
    const cell = gallery.cell(picture)
    if (cell !== undefined && (!cell.checkVisibility() || cell.classList.contains("aside"))) tell("look", picture)
    light(event)
  })
}
