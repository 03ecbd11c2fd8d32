// @ts-check
// Fills the pictures of a scene with a state and paints them together.

import { listen, tell } from "../base/bus.js"
import { unpack } from "../base/unpack.js"
import { showAxes } from "../pictures/plot.js"
import { zoomed } from "../pictures/zoom.js"

// Longest wait for a plot in milliseconds: a broken picture must not block the page.
const MOST = 2000

/**
 * Set the axes of plots: those of the state, widened to those of the other page if two states stand side by side, or those of
 * a zoom.
 * @param {Scene} scene
 * @param {Iterable<string>} names
 */
export function setAxes({ plots, ranges, beside, source }, names) {
  for (const name of names) {
    const plot = plots.find((one) => one.model.name === name)
    if (plot === undefined || ranges[name] === undefined) continue
    const whole = /** @type {Axes} */ (
      ranges[name].map((end, i) => (i % 2 === 0 ? Math.min : Math.max)(end, beside[name]?.[i] ?? end)))
    showAxes(plot.model, zoomed(source(`${name}-zoom`), whole))
  }
}

/** Show the axes of the other page too. @param {() => Scene | null} shown returns the scene on show */
export function shareAxes(shown) {
  listen({
    "axes-beside"({ name, ranges }) {
      const scene = shown()
      if (scene?.name !== name) return
      Object.assign(scene.beside, ranges)
      setAxes(scene, Object.keys(ranges))
      tell("paint")
    },
  })
}

/**
 * Set the axes, data and words of a scene from a state.
 * @param {Scene} scene
 * @param {Tree} tree
 * @param {ArrayBuffer} block
 */
export function fill(scene, { ranges, sources, texts, captions }, block) {
  Object.assign(scene.ranges, ranges)
  setAxes(scene, Object.keys(ranges))
  tell("axes", { name: scene.name, ranges: scene.ranges })
  for (const [name, columns] of unpack(sources, block)) scene.source(name).put(columns)
  tell("texts", texts)
  tell("captions", captions)
}

/**
 * Fill the pictures and paint all of them in the same task.
 *
 * Bokeh takes data in promises and paints each plot in the next frame.  Here the plots pause until all data are taken, then
 * paint together: one frame sooner, and no frame shows half of a state.
 * @param {PlotView[]} touched the plots that change
 * @param {() => void} fillAll sets data and axes
 */
export async function paint(touched, fillAll) {
  for (const plot of touched) plot.pause()
  try {
    fillAll()
    const ready = Promise.all(touched.flatMap((plot) => plot.computed_renderer_views.map((part) => part.ready)))
    await Promise.race([ready, new Promise((done) => setTimeout(done, MOST))])
    for (const plot of touched) plot.unpause(true)
    for (const plot of touched) plot.paint()
  } finally {
    for (const plot of touched) if (plot.is_paused) plot.unpause()
  }
  tell("paint")
}
