// @ts-check
// Copies of Bokeh plots.  Ghosts: faint ones of an earlier state, redrawn only when axes or sizes change.  Shots, for print and for
// films: in the colours of any theme, and sharper than on the screen.

import { element } from "../base/elements.js"
import { atRatio, takeColours } from "./bokeh_private.js"
import { frameCanvas } from "./canvas.js"
import { clipTo } from "./frame.js"
import { colourPlot } from "./plot_looks.js"

export const FAINT = 0.4

/**
 * Return the canvases of a plot from back to front, Bokeh's and ours, without the ghost and guesses.
 * @param {PlotView} plot
 * @returns {HTMLCanvasElement[]}
 */
function layersOf(plot) {
  const layers = /** @type {HTMLCanvasElement[]} */ ([...plot.canvas_view.primary.el.parentNode.children])
  return layers.filter((layer) => (
    layer instanceof HTMLCanvasElement && layer.width > 0 && !layer.matches(".ghost, .guess, .audience")))
}

/**
 * Return the ghost of a Bokeh plot.
 * @param {PlotView} plot
 * @returns {Ghost}
 */
export function planeGhost(plot) {
  /** @type {ReturnType<typeof frameCanvas> | null} */
  let canvas = null
  /** @type {{sheet: HTMLCanvasElement, x: [number, number], y: [number, number]} | null} */
  let kept = null

  /** @type {PaintFrame} */
  function paint(ctx, xScale, yScale) {
    if (kept === null) return
    const { sheet, x: [x0, x1], y: [y0, y1] } = kept
    const [left, right, bottom, top] = [xScale.compute(x0), xScale.compute(x1), yScale.compute(y0), yScale.compute(y1)]
    ctx.globalAlpha = FAINT
    ctx.drawImage(sheet, left - 0.5, top - 0.5, right - left, bottom - top)
  }

  return {
    take() {
      const { primary: { el } } = plot.canvas_view
      const { x_range: x, y_range: y } = plot.model
      const { x0, y0, x1, y1 } = plot.frame.bbox
      // A folded plot has no size, nor has a plot in a window without room.
      if (!(x1 > x0 && y1 > y0 && el.width > 0)) return null
      const ratio = el.width / plot.bbox.width
      const [width, height] = [x1 - x0, y1 - y0].map((side) => Math.ceil(ratio * side))
      const sheet = element("canvas", { width, height })
      const paper = sheet.getContext("2d")
      // Layers that fill the frame below Bokeh's own would hide the state on show.
      const layers = layersOf(plot)
      for (const layer of layers.slice(layers.indexOf(el))) {
        paper.drawImage(layer, ratio * x0, ratio * y0, width, height, 0, 0, width, height)
      }
      return { sheet, x: [x.start, x.end], y: [y.start, y.end] }
    },
    show(what) {
      if (what === kept) return
      kept = what
      if (canvas === null) {
        // Place the ghost above filled areas and below the moving layers.
        canvas = frameCanvas(plot, plot.canvas_view.overlays.el, "before", paint)
        canvas.element.classList.add("ghost")
      }
      canvas.request()
      canvas.draw()
    },
  }
}

/** @param {PlotView} plot @param {number} side @param {number} ratio */
function composed(plot, side, ratio) {
  const { primary } = plot.canvas_view
  const sheet = element("canvas", { width: side, height: Math.round(ratio * plot.bbox.height) })
  const paper = sheet.getContext("2d")
  for (const layer of layersOf(plot)) {
    paper.save()
    if (layer !== primary.el) {
      paper.scale(ratio, ratio)
      clipTo(paper, plot.frame.bbox)
      paper.resetTransform()
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
