// @ts-check
// A chart as a JSON file that can be shown again.

import { linkTo } from "../page/embedding.js"

const PROGRAM = "hess-explorer chart"
const MOST_SIDE = 256
const NUMBERS = "Part of this chart is missing or not a number: save it again."

/** @typedef {Record<string, (value: any) => boolean>} Fields name → test of the value */
/** @type {(most: number) => (value: unknown) => boolean} */
const isText = (most) => (value) => typeof value === "string" && value.length <= most
/** @param {number} value */
const isCount = (value) => Number.isInteger(value) && value >= 2 && value <= MOST_SIDE
/** @param {Fields} fields @param {any} value */
const isWhole = (fields, value) => Object.entries(fields).every(([name, isRight]) => isRight(value[name]))
/** @param {Fields} fields @param {any} value */
const picked = (fields, value) => Object.fromEntries(Object.keys(fields).map((name) => [name, value[name]]))

// Fields of a file.
/** @type {Fields} */
const SIDE = { name: isText(40), symbol: isText(40), low: Number.isFinite, high: Number.isFinite, count: isCount }
/** @param {ChartAxis | null} side */
const isSide = (side) => side !== null && typeof side === "object" && isWhole(SIDE, side) && side.low < side.high
const MOST_NAMES = 16
/** @param {unknown} one */
const isNamed = (one) => Array.isArray(one) && one.length === 2 && Number.isInteger(one[0]) && Math.abs(one[0]) < 100 && isText(60)(one[1])
/** @param {unknown} value */
const areNames = (value) => Array.isArray(value) && value.length <= MOST_NAMES && value.every(isNamed)
/** @type {Fields} */
const CHART = {
  scene: isText(200), state: isText(2000), quantity: isText(200), part: Number.isInteger, symbol: isText(200), units: isText(200),
  turn: (value) => Number.isFinite(value) && value >= 0, level: isText(200),
  error: (value) => value === null || Number.isFinite(value), version: isText(200), x: isSide, y: isSide, title: isText(200),
  names: areNames,
}
/** @type {Partial<Chart>} */
const USUAL = { turn: 0, error: null, version: "", names: [] }

/** Return the text of the file; NaN and infinities become null. @param {Chart} chart */
export function toFile(chart) {
  const link = linkTo().replace(/\?.*$/, `?${chart.state}`)
  return JSON.stringify({
    program: PROGRAM, title: chart.title, link, ...picked(CHART, chart),
    values: Array.from(chart.values, (value) => (Number.isFinite(value) ? value : null)), status: Array.from(chart.status),
  })
}

/**
 * Return the chart in the text of a file, or {why}: the reason that there is none.
 * @param {string} text
 * @returns {{chart?: Chart, why?: string}}
 */
export function fromFile(text) {
  let found = null
  try {
    found = JSON.parse(text)
  } catch {
    return { why: "This file is not JSON: choose one written by Save." }
  }
  if (found?.program !== PROGRAM) return { why: "This file is not a chart: choose one written by Save." }
  const chart = { ...USUAL, ...found }
  if (!isWhole(CHART, chart)) return { why: NUMBERS }
  const { x, y, values, status } = chart
  /** @param {unknown[]} list @param {(value: any) => boolean} isRight */
  const isFull = (list, isRight) => Array.isArray(list) && list.length === x.count * y.count && list.every(isRight)
  if (!isFull(values, (/** @type {number | null} */ value) => value === null || Number.isFinite(value)) ||
      !isFull(status, (/** @type {number} */ one) => Number.isInteger(one) && one >= 0 && one < 256)) return { why: NUMBERS }
  const known = status.filter(Boolean).length
  return {
    chart: /** @type {Chart} */ ({
      ...picked(CHART, chart), x: picked(SIDE, x), y: picked(SIDE, y), reason: "", left: null, known, share: known / status.length,
      values: Float64Array.from(values, (/** @type {number | null} */ value) => value ?? NaN), status: Uint8Array.from(status),
    }),
  }
}
