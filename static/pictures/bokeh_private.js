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
