// @ts-check
// Undocumented parts of BokehJS that this page uses, with the reason and the effect if they are missing.

const gestures = () => Bokeh.require?.("core/ui_gestures")?.UIGestures
/** @param {unknown} value */
const isMethod = (value) => typeof value === "function"

// Any font size: no size on this page is relative to it.
const FONT = 13
const UNSEEN = /** @type {const} */ (["selection_glyph", "nonselection_glyph", "muted_glyph", "decimated_glyph"])
const FOLLOWING = /** @type {const} */ (["set_data", "set_visuals", "after_visuals", "after_lazy_visuals", "map_data"])

// Name → test for its presence in a plot.
/** @type {Record<string, (plot: PlotView) => boolean>} */
const NEEDED = {
  "UIGestures.press_threshold": () => Number.isFinite(gestures()?.press_threshold),
  "GlyphRendererView.all_indices, GlyphView.set_visuals and after_visuals": (plot) => plot.computed_renderer_views
    .every(({ glyph, all_indices: indices }) => glyph === undefined
      || (indices !== undefined && isMethod(glyph.set_visuals) && isMethod(glyph.after_visuals))),
  "GlyphRendererView.selection_glyph, nonselection_glyph, muted_glyph and decimated_glyph": (plot) => plot.computed_renderer_views
    .every((view) => view.glyph === undefined || UNSEEN.every((name) => FOLLOWING.every((step) => isMethod(view[name]?.[step])))),
  "GlyphView.mask_data": (plot) => plot.computed_renderer_views.every(({ glyph }) => glyph === undefined || isMethod(glyph.mask_data)),
  "RendererView.el and update_position": (plot) => plot.computed_renderer_views
    .every(({ el, update_position: place }) => el instanceof Element && isMethod(place)),
  "PlotView.base_font_size": (plot) => "base_font_size" in plot,
  "window.devicePixelRatio that can be replaced": () => (
    Object.getOwnPropertyDescriptor(window, "devicePixelRatio")?.configurable === true),
}

/**
 * Return the names of missing parts.
 * @param {PlotView} plot
 */
const missing = (plot) => Object.keys(NEEDED).filter((name) => !NEEDED[name](plot))

let isChecked = false

/**
 * Log the missing parts, once, when the first plot is built.
 * @param {PlotView} plot
 */
export function checkBokeh(plot) {
  if (isChecked) return
  isChecked = true
  const names = missing(plot)
  if (names.length > 0) console.error(`BokehJS ${Bokeh.version} is none that this page knows: there is no ${names.join(", no ")}.`)
}

/**
 * Make Bokeh wait long for a press.
 *
 * After 0.3 s Bokeh takes a resting pointer for a press, and then neither a tap nor a drag follows; users who aim at a point
 * rest longer.  Bokeh's types call the static property `press_threshold` read-only.  If it is missing, a click must be made
 * within 0.3 s.
 */
export function waitLongForPress() {
  const found = gestures()
  // The longest delay of a timer.
  if (found) found.press_threshold = 2 ** 31 - 1
}

/**
 * Keep painting from waiting for the styles of the page, which takes a fifth of a state's time.
 *
 * The elements of layers and axes are empty: they exist to be styled, and Bokeh rewrites a style sheet of each in every painting.
 * It also reads the font size of the plot's element, for sizes in em; all sizes on this page are in pixels.
 * Without these members painting is slower.
 * @param {PlotView} plot
 */
export function spareStyles(plot) {
  for (const view of plot.computed_renderer_views) {
    view.el?.remove()
    view.update_position = () => {}
  }
  Object.defineProperty(plot, "base_font_size", { value: FONT })
}

/**
 * Keep each layer from preparing what nobody sees, as no tool of Bokeh is on this page: the glyphs for selected, other, muted
 * and decimated points, each of which costs as much as the glyph that is painted, except for its painting; and the spatial
 * index of its points, by which Bokeh finds those in the frame.
 * @param {PlotView} plot
 */
export function spareUnseen(plot) {
  for (const view of plot.computed_renderer_views) {
    for (const name of UNSEEN) {
      const glyph = view[name]
      if (glyph) for (const step of FOLLOWING) glyph[step] = () => {}
    }
    if (view.glyph) view.glyph.mask_data = () => view.all_indices
  }
}

/**
 * Apply glyph colours that were changed in this task.  Bokeh itself applies them in a promise, too late for printing; without
 * these methods a dark page is printed in dark colours.
 * @param {PlotView} plot
 */
export function takeColours(plot) {
  for (const { glyph, model, all_indices: indices } of plot.computed_renderer_views) {
    glyph?.set_visuals?.(model.data_source, indices)
    glyph?.after_visuals?.()
  }
}

/**
 * Call `act` with another device pixel ratio, which Bokeh reads from the window.  If it cannot be replaced, prints have the
 * resolution of the screen.
 * @template Result
 * @param {number} ratio
 * @param {() => Result} act
 */
export function atRatio(ratio, act) {
  const own = Object.getOwnPropertyDescriptor(window, "devicePixelRatio")
  if (!own?.configurable) return act()
  Object.defineProperty(window, "devicePixelRatio", { configurable: true, get: () => ratio })
  try {
    return act()
  } finally {
    Object.defineProperty(window, "devicePixelRatio", own)
  }
}
