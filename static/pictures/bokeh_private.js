// All that this page uses of BokehJS beyond what its documentation names, each with its reason, a test at start, and
// what happens without it.

// A pointer that rests for 0.3 s is to Bokeh a press, after which neither a tap nor a drag comes of it; whoever takes
// aim at a point rests longer.  `press_threshold` is a static property that its types call read-only.
// Without it: such a click must be made within 0.3 s.
export function waitLongForPress() {
  const gestures = Bokeh.require?.("core/ui_gestures")?.UIGestures
  // The longest that timers take.
  if (Number.isFinite(gestures?.press_threshold)) gestures.press_threshold = 2 ** 31 - 1
  else console.warn("Bokeh has no UIGestures.press_threshold: clicks in plots must be short")
}

// The colours of glyphs that were changed in this task: Bokeh itself takes them up in a promise, too late for a print.
// Without it: a page that is dark is printed in the colours of a dark page.
export function takeColours(plot) {
  for (const { glyph, model, all_indices: indices } of plot.computed_renderer_views) {
    if (glyph === undefined) continue
    if (glyph.set_visuals === undefined || indices === undefined) return console.warn("Bokeh has no set_visuals: colours of prints")
    glyph.set_visuals(model.data_source, indices)
    glyph.after_visuals()
  }
}

// act() with so many pixels of a canvas for one of CSS; Bokeh asks the window for that number.
// Without it: what is printed is as sharp as the screen, and no sharper.
export function atRatio(ratio, act) {
  const own = Object.getOwnPropertyDescriptor(window, "devicePixelRatio")
  if (!own?.configurable) {
    console.warn("This browser does not let its devicePixelRatio be replaced: prints are no sharper than the screen")
    return act()
  }
  Object.defineProperty(window, "devicePixelRatio", { configurable: true, get: () => ratio })
  try {
    return act()
  } finally {
    Object.defineProperty(window, "devicePixelRatio", own)
  }
}
