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

// fill() puts new data into the sources; `reframed`: the plots that have other axes by then.
//
// Bokeh takes data in promises and paints in the next frame, each plot by itself.  Here the plots pause until all of
// the data are taken, and are painted in the same task: a frame sooner, and no frame shows half of a state.
export async function paint(plots, fill) {
  for (const plot of plots) plot.pause()
  try {
    const reframed = fill()
    const ready = Promise.all(plots.flatMap((plot) => plot.computed_renderer_views.map((part) => part.ready)))
    await within(ready, MOST)
    for (const plot of plots) plot.unpause(true)
    for (const plot of plots) {
      // Other axes may need other room for their labels.
      if (reframed.has(plot)) plot.repaint()
      else plot.paint()
    }
  } finally {
    for (const plot of plots) if (plot.is_paused) plot.unpause()
  }
  tell("paint")
}
