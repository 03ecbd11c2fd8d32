// The request for a chart: starts it on the server, polls for new cells, stops it.  It goes on whatever is on the screen.

import { listen, tell } from "../page/bus.js"

// Milliseconds between two questions how far it is: what came meanwhile is painted at once.
const PAUSE = 200

const sideOf = ({ name, low, high, count }) => [name, low, high, count]
// What the server is asked, see "sweep/chart.py".
const asked = ({ state, quantity, part, x, y }) => ({ state, quantity, part, x: sideOf(x), y: sideOf(y) })
const ask = (what) => tell("ask-chart", what)

/**
 * Return {running: the chart that is computed or null, start(chart), stop(), why(chart, [x, y])}.
 * @param {(chart: any) => void} changed is called when cells have come, and at the end
 * @param {(sentence: string, place: [number, number]) => void} explained is told how a cell ends
 */
export function chartJob(changed, explained) {
  let chart = null
  let timer = null
  let number = 0

  // Cells that follow those which are known.
  function take({ cells, first, done, of, left, level, error, version, x, y }, block) {
    if (chart.values === null) {
      // As they were clamped.
      for (const [side, [, low, high, count]] of [[chart.x, x], [chart.y, y]]) Object.assign(side, { low, high, count })
      Object.assign(chart, { level, values: new Float64Array(of).fill(NaN), status: new Uint8Array(of) })
    }
    Object.assign(chart, { share: done / of, left, error, version })
    if (first !== chart.known) return
    const numbers = new Float64Array(block.slice(0, 8 * cells))
    const places = new Int32Array(block.slice(8 * cells, 12 * cells))
    const status = new Uint8Array(block, 12 * cells, cells)
    places.forEach((place, i) => {
      chart.values[place] = numbers[i]
      chart.status[place] = status[i]
    })
    chart.known += cells
  }

  function end(said) {
    const ended = chart
    clearTimeout(timer)
    chart = null
    ended.said = said
    tell("charting", null)
    changed(ended)
  }

  listen({
    charted({ head, cells }) {
      if (head.why !== undefined) return explained(head.why, head.at)
      if (chart === null || head.id !== chart.id) return
      if (head.of === undefined) return end(head.said)
      take(head, cells)
      if (!head.running && head.cells === 0) return end(head.said)
      tell("charting", chart.share)
      changed(chart)
      timer = setTimeout(() => ask({ more: chart.known, id: chart.id }), head.running ? PAUSE : 0)
    },
  })

  return {
    get running() { return chart },
    start(next) {
      if (chart !== null) end("Stopped.")
      number += 1
      chart = Object.assign(next, { id: number })
      ask({ start: asked(chart), id: number })
      tell("charting", 0)
    },
    stop() { if (chart !== null) ask({ stop: true }) },
    why: (which, place) => ask({ why: asked(which), at: place }),
  }
}
