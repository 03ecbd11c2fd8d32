// @ts-check
// Sizes and colours of Bokeh plots, for the font size beside the pictures, present mode and the theme.

import { zoom } from "../base/modes.js"
import { shade } from "./looks.js"
import { atFirst } from "./sources.js"

// Font size of ticks relative to that of axis labels.
const TICKS = 0.86
// Width of a frame whose labels have the room that "tags.py" gives them, that of its axes in font sizes, and the edge of a picture
// without labels.
const [LABELLED, AXES, UNLABELLED] = [270, 5, 240]
const COLOURS = ["line_color", "fill_color", "text_color", "background_fill_color"]
const SIZES = ["line_width", "axis_line_width", "major_tick_line_width", "outline_line_width", "size", "text_font_size"]

// The sizes of a model before any change; those that are columns are left alone.
const sizesOf = atFirst((/** @type {BokehModel} */ part) => SIZES.filter((name) => part[name] != null)
  .map((name) => [name, part[name].value ?? part[name]]).filter(([, value]) => typeof value !== "object"))

/** @param {number} factor @param {unknown} value */
const times = (factor, value) => (typeof value === "number" ? factor * value
  : typeof value === "string" ? `${factor * Number.parseFloat(value)}px` : value)

/** @type {WeakMap<PlotView, number>} */
const factors = new WeakMap()

/** Return the factor of the sizes of lines and dots in a plot. @param {PlotView} plot */
export const largerOf = (plot) => factors.get(plot) ?? 1

/**
 * Set the font sizes of a plot, and the sizes of lines and dots for the current mode.
 * @param {PlotView} plot
 * @param {number} type font size in pixels
 * @param {boolean} isAside whether it stands in the strip, without axes and labels
 * @param {number} edge of the picture in pixels
 */
export function sizePlot(plot, type, isAside, edge) {
  const larger = zoom(edge)
  factors.set(plot, larger)
  const labelled = isAside || edge < UNLABELLED ? 0 : Math.min(larger, (edge - AXES * type) / LABELLED)
  for (const part of plot.model.references()) {
    const isLabel = (part.text_font_style?.value ?? part.text_font_style) === "bold"
    const factor = isLabel ? labelled : larger
    part.setv(Object.fromEntries(sizesOf(part).map(([name, value]) => [name, times(factor, value)])))
    if (part.axis_label_text_font_size !== undefined) {
      part.setv({
        visible: !isAside, axis_label_text_font_size: `${type}px`, major_label_text_font_size: `${Math.round(TICKS * type)}px`,
      })
    }
  }
}

/** @param {BokehModel} glyph @param {string} name */
const colourOf = (glyph, name) => glyph[name]?.value ?? glyph[name]

// The colours of a glyph before any change, as in "theme.py".
const coloursOf = atFirst((/** @type {BokehModel} */ glyph) => COLOURS.map((name) => [name, colourOf(glyph, name)])
  .filter(([, colour]) => typeof colour === "string" && colour.startsWith("#")))

/** Give a glyph the colours of this page. @param {BokehModel} glyph */
function shadeGlyph(glyph) {
  const changed = coloursOf(glyph).map(([name, colour]) => [name, shade(colour)])
    .filter(([name, colour]) => colourOf(glyph, name) !== colour)
  if (changed.length > 0) glyph.setv(Object.fromEntries(changed))
}

/**
 * Give a plot the colours of the theme.
 * @param {PlotView} plot
 * @param {string} text colour of text
 * @param {string} muted colour of secondary text
 */
export function colourPlot(plot, text, muted) {
  for (const part of plot.model.references()) {
    if (part.axis_label_text_color !== undefined) {
      part.setv({
        axis_label_text_color: text, axis_label_text_font_style: "normal", axis_label_text_font: "system-ui, sans-serif",
        major_label_text_color: muted, major_label_text_font: "system-ui, sans-serif",
        axis_line_color: muted, axis_line_alpha: 0.4, major_tick_line_color: muted, major_tick_line_alpha: 0.4,
        minor_tick_line_alpha: 0,
      })
    } else if ((part.line_color ?? part.text_color) !== undefined && part.type !== "Plot") {
      shadeGlyph(part)
    }
  }
  plot.model.setv({ outline_line_color: muted, outline_line_alpha: 0.4 })
}
