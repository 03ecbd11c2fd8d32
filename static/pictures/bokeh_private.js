// All that this page uses of BokehJS beyond its documentation, each with its reason and what happens without it.

const gestures = () => Bokeh.require?.("core/ui_gestures")?.UIGestures
const isMethod = (value) => typeof value === "function"

// Name → whether it is there, for a plot that was built.
const NEEDED = {
  "UIGestures.press_threshold": () => Number.isFinite(gestures()?.press_threshold),
  "GlyphRendererView.all_indices, GlyphView.set_visuals and after_visuals": (plot) => plot.computed_renderer_views
    .every(({ glyph, all_indices: indices }) => glyph === undefined
      || (indices !== undefined && isMethod(glyph.set_visuals) && isMethod(glyph.after_visuals))),
  "window.devicePixelRatio that can be replaced": () => (
    Object.getOwnPropertyDescriptor(window, "devicePixelRatio")?.configurable === true),
}

export const missing = (plot) => Object.keys(NEEDED).filter((name) => !NEEDED[name](plot))

let isChecked = false

// Says once, when the first plot is built, what is not there.
export function checkBokeh(plot) {
  if (isChecked) return
  isChecked = true
  const names = missing(plot)
  if (names.length > 0) console.error(`BokehJS ${Bokeh.version} is none that this page knows: there is no ${names.join(", no ")}.`)
}

// A pointer that rests for 0.3 s is to Bokeh a press, after which neither a tap nor a drag comes of it; whoever takes
// aim at a point rests longer.  `press_threshold` is a static property that its types call read-only.
// Without it: such a click must be made within 0.3 s.
export function waitLongForPress() {
  const found = gestures()
  // The longest that timers take.
  if (found) found.press_threshold = 2 ** 31 - 1
}

// The colours of glyphs that were changed in this task: Bokeh itself takes them up in a promise, too late for a print.
// Without it: a page that is dark is printed in the colours of a dark page.
export function takeColours(plot) {
  for (const { glyph, model, all_indices: indices } of plot.computed_renderer_views) {
    glyph?.set_visuals?.(model.data_source, indices)
    glyph?.after_visuals?.()
  }
}

// act() with so many pixels of a canvas for one of CSS; Bokeh asks the window for that number.
// Without it: what is printed is as sharp as the screen, and no sharper.
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
