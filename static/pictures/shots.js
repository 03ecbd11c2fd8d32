// @ts-check
// Bokeh plots for print and for films: in the colours of any theme, and sharper than on the screen.

import { element } from "../base/elements.js"
import { atRatio, takeColours } from "./bokeh_private.js"
import { layersOf } from "./ghost.js"
import { colourPlot } from "./plot_looks.js"

/** @param {PlotView} plot @param {number} side @param {number} ratio */
function composed(plot, side, ratio) {
  const { primary } = plot.canvas_view
  const { x0, y0, x1, y1 } = plot.frame.bbox
  const sheet = element("canvas", { width: side, height: Math.round(ratio * plot.bbox.height) })
  const paper = sheet.getContext("2d")
  for (const layer of layersOf(plot)) {
    paper.save()
    if (layer !== primary.el) {
      paper.beginPath()
      paper.rect(ratio * x0, ratio * y0, ratio * (x1 - x0), ratio * (y1 - y0))
      paper.clip()
    }
    paper.drawImage(layer, 0, 0, sheet.width, sheet.height)
    paper.restore()
  }
  return sheet
}

/**
 * Return a picture of a plot with our canvases, laid out as on the page.  The plot is left in the colours of the picture;
 * everything happens in one task, so that nothing of it is seen.
 * @param {PlotView} plot
 * @param {ShotLook} look
 */
export function shootPlot(plot, { edge, ratio: sharpness, text }) {
  const repaint = () => {
    plot.canvas_view.resize()
    plot.invalidate_painters()
    plot.paint()
  }
  const side = Math.round(edge * sharpness)
  const ratio = side / plot.bbox.width
  colourPlot(plot, text, text)
  takeColours(plot)
  const sheet = atRatio(ratio, () => {
    repaint()
    return composed(plot, side, ratio)
  })
  repaint()
  return sheet
}
