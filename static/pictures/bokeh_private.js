// @ts-check
// Undocumented parts of the BokehJS that "pyproject.toml" asks for, with the reason of their use.

// Any font size will do, because no size on this page is relative to it.
const FONT = 13
const UNSEEN = /** @type {const} */ (["selection_glyph", "nonselection_glyph", "muted_glyph", "decimated_glyph"])
const FOLLOWING = /** @type {const} */ (["set_data", "set_visuals", "after_visuals", "after_lazy_visuals", "map_data"])

/**
 * Make Bokeh wait long for a press.
 *
 * After 0.3 s Bokeh takes a resting pointer for a press, and then neither a tap nor a drag follows; users who aim at a point
 * rest longer.  Bokeh's types call the static property `press_threshold` read-only.
 */
export function waitLongForPress() {
  // The longest delay that a timer accepts.
  Bokeh.require("core/ui_gestures").UIGestures.press_threshold = 2 ** 31 - 1
}

/**
 * Keep painting from waiting for the styles of the page, which takes a fifth of a state's time.
 *
 * The elements of layers and axes are empty: they exist to be styled, and Bokeh rewrites a style sheet of each in every painting.
 * It also reads the font size of the plot's element, for sizes in em; all sizes on this page are in pixels.
 * @param {PlotView} plot
 */
export function spareStyles(plot) {
  for (const view of plot.computed_renderer_views) {
    view.el.remove()
    view.update_position = () => {}
  }
  Object.defineProperty(plot, "base_font_size", { value: FONT })
}

/**
 * Keep each layer from preparing parts that only the tools of Bokeh would show, because this page has none: the glyphs for
 * selected, other, muted and decimated points, each of which costs as much as the visible glyph before painting; and the spatial
 * index of its points, with which Bokeh finds those in the frame.
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
 * Apply glyph colours that were changed in this task.  Bokeh itself applies them in a promise, too late for printing.
 * @param {PlotView} plot
 */
export function takeColours(plot) {
  for (const { glyph, model, all_indices: indices } of plot.computed_renderer_views) {
    glyph?.set_visuals(model.data_source, indices)
    glyph?.after_visuals()
  }
}

/**
 * Call `act` with another device pixel ratio, which Bokeh reads from the window.
 * @template Result
 * @param {number} ratio
 * @param {() => Result} act
 */
export function atRatio(ratio, act) {
  const own = Object.getOwnPropertyDescriptor(window, "devicePixelRatio")
  Object.defineProperty(window, "devicePixelRatio", { configurable: true, get: () => ratio })
  try {
    return act()
  } finally {
    Object.defineProperty(window, "devicePixelRatio", own)
  }
}
