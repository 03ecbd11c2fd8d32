// @ts-check
// Undocumented parts of BokehJS that this page uses, with the reason and the effect if they are missing.

const gestures = () => Bokeh.require?.("core/ui_gestures")?.UIGestures
/** @param {unknown} value */
const isMethod = (value) => typeof value === "function"

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
  "RendererView.el": (plot) => plot.computed_renderer_views.every(({ el }) => el instanceof Element),
  "window.devicePixelRatio that can be replaced": () => (
    Object.getOwnPropertyDescriptor(window, "devicePixelRatio")?.configurable === true),
}

/**
 * Return the names of missing parts.
 * @param {PlotView} plot
 */
export const missing = (plot) => Object.keys(NEEDED).filter((name) => !NEEDED[name](plot))

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
 * Remove the elements of layers and axes, which are empty: they exist to be styled.  Bokeh rewrites a style sheet of each in
 * every painting, and the next plot that sets a font then waits for all styles of the page: a fifth of a state's time.
 * Without `el` they stay, and painting is slower.
 * @param {PlotView} plot
 */
export function removeStyled(plot) {
  for (const { el } of plot.computed_renderer_views) el?.remove()
}

/**
 * Keep the glyphs for selected, other, muted and decimated points of each layer from following its data: no tool of Bokeh is
 * on this page, so nobody sees them, and each costs as much as the glyph that is painted, except for its painting.
 * @param {PlotView} plot
 */
export function spareUnseen(plot) {
  for (const view of plot.computed_renderer_views) {
    for (const name of UNSEEN) {
      const glyph = view[name]
      if (glyph) for (const step of FOLLOWING) glyph[step] = () => {}
    }
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
