// Fills the pictures of a scene with a state and paints all of them at once.

import { tell } from "./bus.js"
import { unpack } from "./unpack.js"

const MOST = 2000

// A broken picture must not hold up the page for ever.
function within(promise, most) {
  return new Promise((resolve, reject) => {
    const timer = setTimeout(resolve, most)
    promise.then(resolve, reject).finally(() => clearTimeout(timer))
  })
}

// Axes and data of a state, of its tree and its block, into the pictures of a scene.
export function fill(scene, { ranges, sources }, block) {
  for (const [name, [x0, x1, y0, y1]] of Object.entries(ranges)) {
    const plot = scene.plots.find((one) => one.model.name === name)
    if (plot === undefined) continue
    const { x_range: x, y_range: y } = plot.model
    x.setv({ start: x0, end: x1 })
    y.setv({ start: y0, end: y1 })
  }
  scene.painted = true
  for (const [name, columns] of unpack(sources, block)) scene.sources.get(name)?.put(columns)
}

// fillAll() puts new data into the sources, and axes into the plots; `touched`: the plots that change.
//
// Bokeh takes data in promises and paints in the next frame, each plot by itself.  Here the plots pause until all of
// the data are taken, and are painted in the same task: a frame sooner, and no frame shows half of a state.
export async function paint(touched, fillAll) {
  for (const plot of touched) plot.pause()
  try {
    fillAll()
    const ready = Promise.all(touched.flatMap((plot) => plot.computed_renderer_views.map((part) => part.ready)))
    await within(ready, MOST)
    for (const plot of touched) plot.unpause(true)
    for (const plot of touched) plot.paint()
  } finally {
    for (const plot of touched) if (plot.is_paused) plot.unpause()
  }
  tell("paint")
}
