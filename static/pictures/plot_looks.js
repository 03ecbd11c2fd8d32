// Sizes and colours of what Bokeh draws: for the type beside the pictures, for present mode, and for the page's theme.

import { zoom } from "../page/presenting.js"
import { isDark, setDark, shade } from "./looks.js"

// Of the type of an axis: that of its ticks.
const TICKS = 0.86
const SIZES = ["line_width", "axis_line_width", "major_tick_line_width", "outline_line_width", "size", "text_font_size"]

// What `read` finds in a model of Bokeh when that is seen for the first time, before anything is changed here.
function atFirst(read) {
  const found = new WeakMap()
  return (part) => {
    if (!found.has(part)) found.set(part, read(part))
    return found.get(part)
  }
}

// Those of columns are no numbers.
const sizesOf = atFirst((part) => SIZES.filter((name) => part[name] != null)
  .map((name) => [name, part[name].value ?? part[name]]).filter(([, value]) => typeof value !== "object"))

const times = (factor, value) => (typeof value === "number" ? factor * value
  : typeof value === "string" ? `${factor * Number.parseFloat(value)}px` : value)

/** Give a plot sizes of texts for type of this size, in pixels, and lines and dots for the mode that is on. */
export function sizePlot(plot, type) {
  for (const part of plot.model.references()) {
    part.setv(Object.fromEntries(sizesOf(part).map(([name, value]) => [name, times(zoom(), value)])))
    if (part.axis_label_text_font_size !== undefined) {
      part.setv({ axis_label_text_font_size: `${type}px`, major_label_text_font_size: `${Math.round(TICKS * type)}px` })
    }
  }
}

const colourOf = (glyph, name) => glyph[name]?.value ?? glyph[name]

// The colours of a glyph as "theme.py" has them.
const coloursOf = atFirst((glyph) => ["line_color", "fill_color"].map((name) => [name, colourOf(glyph, name)])
  .filter(([, colour]) => typeof colour === "string" && colour.startsWith("#")))

// Gives a glyph the shades of its colours for this page.
function shadeGlyph(glyph) {
  const changed = coloursOf(glyph).map(([name, colour]) => [name, shade(colour)])
    .filter(([name, colour]) => colourOf(glyph, name) !== colour)
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
