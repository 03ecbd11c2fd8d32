// A picture that Bokeh draws: axes, lines and markers, from the description that "bokeh_figure.py" makes of it.

import { listen } from "../page/bus.js"
import { element } from "../page/elements.js"
import { isPresenting } from "../page/presenting.js"
import { checkBokeh, waitLongForPress } from "./bokeh_private.js"
import { frameCanvas } from "./canvas.js"
import { cellsPainter } from "./cells.js"
import { dotsPainter } from "./dots.js"
import { connectPicks } from "./picks.js"
import { tickFormatter } from "./ticks.js"

// The width of the frame in which a scene's axes have room for so many letters, in pixels.
const USUAL = 240
const TICKS_HERE = 12
// From afar labels must stand further apart.
const APART = 1.3

// Moving layers lie on a canvas of their own, which Bokeh does not clip to the frame.
function clipOverlays(plot) {
  const { x0, y0, x1, y1 } = plot.frame.bbox
  const { width, height } = plot.bbox
  const clip = `inset(${y0}px ${width - x1 - 1}px ${height - y1 - 1}px ${x0}px)`
  const { style } = plot.canvas_view.overlays.el
  if (style.clipPath !== clip) style.clipPath = clip
}

// Bokeh has a cursor of its own over the frame: here the picture says which one.
function inheritCursor(plot) {
  plot.canvas_view.overlays.el.parentNode.append(element("style", "div { cursor: inherit !important }"))
}

// Canvases for what Bokeh would draw slowly: cells under everything else, dots under the moving layers.
function addCanvases(plot, { cells, dots }, source) {
  const { primary, overlays } = plot.canvas_view
  const add = (layers, before, painter) => {
    if (layers.length === 0) return
    const canvas = frameCanvas(plot, before, painter(layers, source))
    for (const layer of layers) source(layer.source).watch(canvas.request)
    listen({ paint: canvas.draw })
  }
  add(cells, primary.el, cellsPainter)
  add(dots, overlays.el, dotsPainter)
}

// The names of the axes, where they depend on the state.
function nameAxes({ below: [x], left: [y] }, names) {
  names.watch(() => {
    for (const [i, axis] of [x, y].entries()) {
      const name = names.data.text?.[i]
      if (name !== undefined && axis.axis_label !== name) axis.axis_label = name
    }
  })
}

/**
 * Draw a picture in an element, and return Bokeh's view of the plot.
 * @param {HTMLElement} host
 * @param {any} picture from the description of the scene
 * @param {(name: string) => import("./sources.js").Source} source makes a new one where there is none of that name
 */
export async function buildPlot(host, picture, source) {
  waitLongForPress()
  const views = await Bokeh.embed.embed_item(picture.item, host)
  const [plot] = views.roots
  checkBokeh(plot)
  const { model } = plot
  for (const one of model.document.all_models) {
    if (one.data !== undefined && one.name !== null) source(one.name).add(one, plot)
  }
  addCanvases(plot, picture, source)
  inheritCursor(plot)
  plot.repainted.connect(() => clipOverlays(plot))
  picture.letters.forEach((letters, i) => {
    if (letters === null) return
    const [axis] = i === 0 ? model.below : model.left
    axis.formatter = tickFormatter(() => {
      const size = Number.parseFloat(axis.major_label_text_font_size)
      return (letters * ((plot.frame.bbox.width || USUAL) / USUAL) * (TICKS_HERE / size)) / (isPresenting() ? APART : 1)
    })
  })
  if (picture.renamed) nameAxes(model, source(`${picture.name}-axes`))
  connectPicks(model, picture.picks, source(`${picture.name}-box`))
  return plot
}
