// The chart that the server computes for this page: asked for, heard of, stopped.  It goes on whatever is on the screen.

import { listen, tell } from "../page/bus.js"

// Milliseconds between two questions how far it is: what came meanwhile is painted at once.
const PAUSE = 200

const sideOf = ({ name, low, high, count }) => [name, low, high, count]
// What the server is asked, see "sweep/chart.py".
const asked = ({ state, quantity, part, x, y }) => ({ state, quantity, part, x: sideOf(x), y: sideOf(y) })

// changed(chart, said) is called when cells have come, and at the end; explained(sentence, [x, y]) with how a cell ends.
export function chartJob(changed, explained, signal) {
  let chart = null
  let timer = null
  let number = 0

  const ask = (what) => tell("ask-chart", what)

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
    const status = new Uint8Array(block.slice(12 * cells, 13 * cells))
    for (let i = 0; i < cells; i++) {
      chart.values[places[i]] = numbers[i]
      chart.status[places[i]] = status[i]
    }
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

  listen("charted", ({ head, cells }) => {
    if (head.why !== undefined) return explained(head.why, head.at)
    if (chart === null || head.id !== chart.id) return
    if (head.of === undefined) return end(head.said)
    take(head, cells)
    if (!head.running && head.cells === 0) return end(head.said)
    tell("charting", chart.share)
    changed(chart)
    timer = setTimeout(() => ask({ more: chart.known, id: chart.id }), head.running ? PAUSE : 0)
  }, signal)

  return {
    get running() { return chart },
    start(next) {
      if (chart !== null) end("Stopped.")
      number += 1
      chart = Object.assign(next, { id: number, known: 0, share: 0, left: null, said: "" })
      ask({ start: asked(chart), id: number })
      tell("charting", 0)
    },
    stop() { if (chart !== null) ask({ stop: true }) },
    why: (which, place) => ask({ why: asked(which), at: place }),
  }
}
