// @ts-check
// The job of a chart on the server: it is started, polled for new cells, and stopped, whatever is on the screen.

import { listen, tell } from "../page/bus.js"

// Milliseconds between polls; the answer brings all new cells.
const PAUSE = 200

/** @param {ChartAxis} axis @returns {ChartSide} */
const sideOf = ({ name, low, high, count }) => [name, low, high, count]
/** Return what the server needs of a chart, see "sweep/chart.py". @param {Chart} chart @returns {ChartAsked} */
const asked = ({ state, quantity, part, x, y }) => ({ state, quantity, part, x: sideOf(x), y: sideOf(y) })
/** @param {ChartRequest} what */
const ask = (what) => tell("ask-chart", what)

/**
 * Return the job: the chart that is running, and the functions that start and stop it and explain a cell.
 * @param {(chart: Chart) => void} changed is called when cells have come, and at the end
 * @param {(sentence: string, place: [number, number]) => void} explained gets the reason that a cell has no number
 */
export function chartJob(changed, explained) {
  /** @type {Chart | null} */
  let chart = null
  /** @type {ReturnType<typeof setTimeout>} */
  let timer = null
  let number = 0

  /** Add the cells that follow the known ones. @param {ChartAnswer} head @param {ArrayBuffer} block */
  function take({ cells, first, done, of, left, level, error, version, x, y }, block) {
    if (chart.values === null) {
      // The server may have clamped the sides.
      for (const [side, [, low, high, count]] of /** @type {[ChartAxis, ChartSide][]} */ ([[chart.x, x], [chart.y, y]])) {
        Object.assign(side, { low, high, count })
      }
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

  /** @param {string} reason */
  function end(reason) {
    const ended = chart
    clearTimeout(timer)
    chart = null
    ended.reason = reason
    tell("charting", null)
    changed(ended)
  }

  listen({
    charted({ head, cells }) {
      if (head.why !== undefined) return explained(head.why, head.at)
      if (chart === null || head.id !== chart.id) return
      if (head.of === undefined) return end(head.reason)
      take(head, cells)
      if (!head.running && head.cells === 0) return end(head.reason)
      tell("charting", chart.share)
      changed(chart)
      timer = setTimeout(() => ask({ more: chart.known, id: chart.id }), head.running ? PAUSE : 0)
    },
  })

  return {
    get running() { return chart },
    /** @param {Chart} next */
    start(next) {
      if (chart !== null) end("Stopped.")
      number += 1
      chart = Object.assign(next, { id: number })
      ask({ start: asked(chart), id: number })
      tell("charting", 0)
    },
    stop() { if (chart !== null) ask({ stop: true }) },
    /** @param {Chart} which @param {number[]} place */
    why: (which, place) => ask({ why: asked(which), at: place }),
  }
}
