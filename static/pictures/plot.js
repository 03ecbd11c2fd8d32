// A picture that Bokeh draws: axes, lines and markers, from the description that "figure.py" makes of it.

import { listen } from "../page/bus.js"
import { element } from "../page/mount.js"
import { isPresenting, zoom } from "../page/presenting.js"
import { checkBokeh, waitLongForPress } from "./bokeh_private.js"
import { cellsPainter } from "./cells.js"
import { dotsPainter } from "./dots.js"
import { frameCanvas } from "./frame_canvas.js"
import { isDark, setDark, shade } from "./looks.js"
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
  plot.canvas_view.overlays.el.parentNode.append(element("style", { textContent: "div { cursor: inherit !important }" }))
}

// Canvases for what Bokeh would draw slowly: cells under everything else, dots under the moving layers.
function addCanvases(plot, { cells, dots }, source, signal) {
  const { primary, overlays } = plot.canvas_view
  const add = (layers, before, painter) => {
    if (layers.length === 0) return
    const canvas = frameCanvas(plot, before, painter(layers, source))
    for (const layer of layers) source(layer.source).watch(canvas.request, signal)
    listen("paint", canvas.draw, signal)
  }
  add(cells, primary.el, cellsPainter)
  add(dots, overlays.el, dotsPainter)
}

// The names of the axes, where they depend on the state.
function nameAxes({ below: [x], left: [y] }, names, signal) {
  names.watch(() => {
    for (const [i, axis] of [x, y].entries()) {
      const name = names.data.text?.[i]
      if (name !== undefined && axis.axis_label !== name) axis.axis_label = name
    }
  }, signal)
}

/**
 * Draw a picture in an element, and return Bokeh's view of the plot.
 * @param {HTMLElement} host
 * @param {any} picture from the description of the scene
 * @param {(name: string) => import("./sources.js").Source} source makes a new one where there is none of that name
 * @param {AbortSignal} signal
 */
export async function buildPlot(host, picture, source, signal) {
  waitLongForPress()
  const views = await Bokeh.embed.embed_item(picture.item, host)
  const [plot] = views.roots
  checkBokeh(plot)
  const { model } = plot
  for (const one of model.document.all_models) {
    if (one.data !== undefined && one.name !== null) source(one.name).add(one, plot)
  }
  addCanvases(plot, picture, source, signal)
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
  if (picture.renamed) nameAxes(model, source(`${picture.name}-axes`), signal)
  connectPicks(model, picture.picks, source(`${picture.name}-box`))
  return plot
}

const TICKS = 0.86

const WEIGHTS = ["line_width", "axis_line_width", "major_tick_line_width", "outline_line_width", "size", "text_font_size"]

const times = (factor, value) => (typeof value === "number" ? factor * value
  : typeof value === "string" ? `${factor * Number.parseFloat(value)}px` : value)

// What Bokeh draws with as it was made; those of columns are no numbers.
const weightsOf = (part) => Object.fromEntries(WEIGHTS.filter((name) => part[name] != null)
  .map((name) => [name, part[name].value ?? part[name]]).filter(([, value]) => typeof value !== "object"))
const made = new WeakMap()

/** Give a plot sizes of texts for type of this size, in pixels, and lines and dots for the mode that is on. */
export function sizePlot(plot, type) {
  for (const part of plot.model.references()) {
    if (!made.has(part)) made.set(part, weightsOf(part))
    const wide = Object.entries(made.get(part)).map(([name, value]) => [name, times(zoom(), value)])
    part.setv(Object.fromEntries(wide))
    if (part.axis_label_text_font_size !== undefined) {
      part.setv({ axis_label_text_font_size: `${type}px`, major_label_text_font_size: `${Math.round(TICKS * type)}px` })
    }
  }
}

// Of each glyph, its colours as "theme.py" has them.
const given = new WeakMap()

// The shades of a glyph's colours for this page.
function shadeGlyph(glyph) {
  if (!given.has(glyph)) {
    const colours = {}
    for (const name of ["line_color", "fill_color"]) {
      const value = glyph[name]?.value ?? glyph[name]
      if (typeof value === "string" && value.startsWith("#")) colours[name] = value
    }
    given.set(glyph, colours)
  }
  const changed = Object.entries(given.get(glyph)).map(([name, colour]) => [name, shade(colour)])
    .filter(([name, colour]) => (glyph[name].value ?? glyph[name]) !== colour)
  if (changed.length > 0) glyph.setv(Object.fromEntries(changed))
}

/** Give whatever Bokeh itself draws the colours of the page's theme: of text, and of what is less important. */
export function colourPlot(plot, text, muted) {
  setDark(isDark(text))
  for (const part of plot.model.references()) {
    if (part.axis_label_text_color !== undefined) {
      part.setv({
        axis_label_text_color: text, axis_label_text_font_style: "normal", axis_label_text_font: "system-ui, sans-serif",
        major_label_text_color: muted, major_label_text_font: "system-ui, sans-serif",
        axis_line_color: muted, axis_line_alpha: 0.4, major_tick_line_color: muted, major_tick_line_alpha: 0.4,
        minor_tick_line_alpha: 0,
      })
    } else if (part.text_color !== undefined && part.text_baseline !== undefined) {
      part.setv({ text_color: text })
    } else if (part.line_color !== undefined && part.type !== "Plot") {
      shadeGlyph(part)
    }
  }
  plot.model.setv({ outline_line_color: muted, outline_line_alpha: 0.4 })
}
