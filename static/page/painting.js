// Fills the pictures of a scene with a state and paints all of them at once.

import { tell } from "./bus.js"

const MOST = 2000

// A broken picture must not hold up the page for ever.
function within(promise, most) {
  return new Promise((resolve, reject) => {
    const timer = setTimeout(resolve, most)
    promise.then(resolve, reject).finally(() => clearTimeout(timer))
  })
}

// fill() puts new data into the sources, and axes into the plots; `touched`: the plots that change.
//
// Bokeh takes data in promises and paints in the next frame, each plot by itself.  Here the plots pause until all of
// the data are taken, and are painted in the same task: a frame sooner, and no frame shows half of a state.
export async function paint(touched, fill) {
  for (const plot of touched) plot.pause()
  try {
    fill()
    const ready = Promise.all(touched.flatMap((plot) => plot.computed_renderer_views.map((part) => part.ready)))
    await within(ready, MOST)
    for (const plot of touched) plot.unpause(true)
    for (const plot of touched) plot.paint()
  } finally {
    for (const plot of touched) if (plot.is_paused) plot.unpause()
  }
  tell("paint")
}
