// @ts-check
// A picture drawn by Bokeh from the description that "bokeh_figure.py" makes.

import { listen } from "../base/bus.js"
import { element } from "../base/elements.js"
import { isPresenting } from "../base/modes.js"
import { spareStyles, spareUnseen, waitLongForPress } from "./bokeh_private.js"
import { frameCanvas } from "./canvas.js"
import { cellsPainter } from "./cells.js"
import { dotsPainter, movingPointsPainter } from "./dots.js"
import { toPixels, toValues } from "./frame.js"
import { connectPicks } from "./picks.js"
import { connectKeys } from "./plot_keys.js"
import { tickFormatter } from "./ticks.js"
import { connectTouch } from "./touch.js"
import { connectZoom } from "./zoom.js"

/** Run BokehJS if the page is a file, which holds it as text: it takes longer to start than everything else. */
function startBokeh() {
  const held = document.getElementById("bokeh")
  if (held === null) return
  held.remove()
  document.head.append(Object.assign(document.createElement("script"), { textContent: held.textContent }))
}

// Width of the frame, in pixels, for which the numbers of letters on the axes are given.
const USUAL = 240
const TICKS_HERE = 12
// Factor by which labels are further apart in present mode.
const APART = 1.3

// Moving layers lie on an overlay canvas, which Bokeh does not clip to the frame.
/** @param {PlotView} plot */
function clipOverlays(plot) {
  const { x0, y0, x1, y1 } = plot.frame.bbox
  const { width, height } = plot.bbox
  const clip = `inset(${y0}px ${width - x1 - 1}px ${height - y1 - 1}px ${x0}px)`
  const { style } = plot.canvas_view.overlays.el
  if (style.clipPath !== clip) style.clipPath = clip
}

// The host of a plot takes the keys, see "plot_keys.js": Bokeh's own layer for them has no name.
/** @param {PlotView} plot */
function leaveKeysToHost(plot) {
  const layers = /** @type {Element} */ (plot.canvas_view.overlays.el.parentNode)
  for (const layer of /** @type {NodeListOf<HTMLElement>} */ (layers.querySelectorAll("[tabindex]"))) layer.tabIndex = -1
}

// Bokeh sets a cursor over the frame; show that of the picture instead.
/** @param {PlotView} plot */
function inheritCursor(plot) {
  plot.canvas_view.overlays.el.parentNode.append(element("style", "div { cursor: inherit !important }"))
}

// Canvases for layers that Bokeh would draw slowly: cells below everything else, dots below the moving layers, and above them
// the points that move in time.
/** @param {PlotView} plot @param {PictureDescription} picture @param {FindSource} source */
function addCanvases(plot, { cells, dots, points }, source) {
  const { primary, overlays } = plot.canvas_view
  /**
   * @template {{source: string}} Layer
   * @param {Layer[]} layers
   * @param {[Element, "before" | "after"]} where
   * @param {(layers: Layer[], source: FindSource) => PaintFrame} painter
   */
  const add = (layers, where, painter, isMoving = false) => {
    if (layers.length === 0) return
    const canvas = frameCanvas(plot, ...where, painter(layers, source))
    for (const layer of layers) {
      source(layer.source).watch(canvas.request)
      // Nothing else needs painting then.
      if (isMoving) source(layer.source).watch(canvas.draw)
    }
    if (isMoving) source("data-swarm").watch(canvas.request)
    listen({ paint: canvas.draw })
  }
  add(cells, [primary.el, "before"], cellsPainter)
  add(dots, [overlays.el, "before"], dotsPainter)
  add(points, [overlays.el, "after"], movingPointsPainter, true)
}

// Set axis names that depend on the state.
/** @param {PlotModel} model @param {Source} names */
function nameAxes({ below: [x], left: [y] }, names) {
  const rename = () => {
    for (const [i, axis] of [x, y].entries()) {
      const name = names.data.text?.[i]
      if (name !== undefined && axis.axis_label !== name) axis.axis_label = name
    }
  }
  names.watch(rename)
  // The first state may come before the plot is built.
  rename()
}

/**
 * Return the points of the handle of a picture, in pixels of the plot.
 * @param {PlotView} plot
 * @param {[source: string, x: string, y: string] | null} handle
 * @param {FindSource} source
 * @returns {number[][]}
 */
function pointsOf(plot, handle, source) {
  if (handle === null) return []
  const [name, x, y] = handle
  const { [x]: xs = [], [y]: ys = [] } = source(name).data
  return Array.from(xs, (value, i) => toPixels(plot, [value, ys[i]]))
}

/**
 * Hide the labels that a zoom would cut, see "tags.py" for their places in the whole picture.
 * @param {PlotView} plot
 * @param {boolean} isZoomed
 */
function hideCut(plot, isZoomed) {
  const { x0, x1, y0, y1 } = plot.frame.bbox
  const ctx = element("canvas").getContext("2d")
  for (const renderer of plot.model.renderers) {
    const { glyph, data_source: source } = renderer
    if (!source.name?.endsWith("-label")) continue
    const { x: [x] = [], y: [y] = [], text: [text] = [] } = source.data
    const size = Number.parseFloat(glyph.text_font_size.value ?? glyph.text_font_size)
    ctx.font = `bold ${size}px helvetica`
    const half = ctx.measureText(text).width / 2
    const [left, top] = toPixels(plot, [x, y])
    const isInside = x0 <= left - half && left + half <= x1 && y0 <= top - size / 2 && top + size / 2 <= y1
    renderer.setv({ visible: !isZoomed || isInside })
  }
}

/** Set the axes of a plot. @param {PlotModel} model @param {Axes} axes */
export function showAxes({ x_range: x, y_range: y }, [x0, x1, y0, y1]) {
  x.setv({ start: x0, end: x1 })
  y.setv({ start: y0, end: y1 })
}

/**
 * Draw a picture in an element, and return Bokeh's view of the plot.
 * @param {HTMLElement} host
 * @param {PictureDescription} picture
 * @param {FindSource} source
 * @returns {Promise<PlotView>}
 */
export async function buildPlot(host, picture, source) {
  startBokeh()
  waitLongForPress()
  const views = await Bokeh.embed.embed_item(picture.item, host)
  /** @type {PlotView} */
  const plot = views.roots[0]
  const { model } = plot
  for (const one of model.document.all_models) {
    if (one.data !== undefined && one.name !== null) source(one.name).add(one, plot)
  }
  addCanvases(plot, picture, source)
  inheritCursor(plot)
  leaveKeysToHost(plot)
  spareStyles(plot)
  spareUnseen(plot)
  plot.repainted.connect(() => clipOverlays(plot))
  picture.letters.forEach((/** @type {number | null} */ letters, /** @type {number} */ i) => {
    if (letters === null) return
    const [axis] = i === 0 ? model.below : model.left
    axis.formatter = tickFormatter(() => {
      const size = Number.parseFloat(axis.major_label_text_font_size)
      return (letters * ((plot.frame.bbox.width || USUAL) / USUAL) * (TICKS_HERE / size)) / (isPresenting() ? APART : 1)
    })
  })
  if (picture.renamed) nameAxes(model, source(`${picture.name}-axes`))
  const { picks } = picture
  const { x_range: xRange, y_range: yRange } = model
  const boxes = picks.includes("box")
  const zoomSource = source(`${picture.name}-zoom`)
  zoomSource.watch(() => hideCut(plot, zoomSource.data.axes !== undefined))
  const zoom = connectZoom(host, zoomSource, {
    name: picture.name, isComputed: boxes,
    frame: () => plot.frame.bbox,
    axes: () => [xRange.start, xRange.end, yRange.start, yRange.end],
    invert: (x, y) => toValues(plot, [x, y]),
    show: (axes) => showAxes(model, axes),
  })
  const touch = connectTouch(host, plot, { points: () => pointsOf(plot, picture.handle, source), boxes, isAlone: zoom.isAlone })
  connectPicks(model, picks, source(`${picture.name}-box`), { ...touch, ...zoom })
  if (picture.hands !== "") {
    connectKeys(host, plot, { picks, zoom, points: picture.handle === null ? null : () => pointsOf(plot, picture.handle, source) })
  }
  return plot
}
