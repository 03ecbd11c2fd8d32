// @ts-check
// Hides one layer of a picture at a time, with its label, for a step of a lesson, and the captions that would tell about it.

import { gallery } from "./gallery.js"

/** @typedef {{picture: string, source: string}} Layer a layer by its data source */

/** @param {Layer | null} layer @returns {BokehModel[]} */
function renderersOf(layer) {
  const plot = layer === null ? undefined : gallery.plots.find(({ model }) => model.name === layer.picture)
  // Hide the label too, because it would show the place of the layer.
  const sources = [layer?.source, `${layer?.source}-label`]
  return plot === undefined ? [] : plot.model.renderers.filter(({ data_source: data }) => sources.includes(data?.name))
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
