// A chart as a file: all that is needed to show it again, and to compute on from it.

import { linkTo } from "../page/embedding.js"

const PROGRAM = "hess-explorer chart"
const MOST_SIDE = 256
const NUMBERS = "A part of this chart is missing or is no number: save it once more."

const isText = (most) => (value) => typeof value === "string" && value.length <= most
const isCount = (value) => Number.isInteger(value) && value >= 2 && value <= MOST_SIDE
const isWhole = (fields, value) => Object.entries(fields).every(([name, isRight]) => isRight(value[name]))
const picked = (fields, value) => Object.fromEntries(Object.keys(fields).map((name) => [name, value[name]]))

// What a file may hold, by name.
const SIDE = { name: isText(40), symbol: isText(40), low: Number.isFinite, high: Number.isFinite, count: isCount }
const isSide = (side) => side !== null && typeof side === "object" && isWhole(SIDE, side) && side.low < side.high
const CHART = {
  scene: isText(200), state: isText(2000), quantity: isText(200), part: Number.isInteger, symbol: isText(200), units: isText(200),
  turn: (value) => Number.isFinite(value) && value >= 0, level: isText(200),
  error: (value) => value === null || Number.isFinite(value), version: isText(200), x: isSide, y: isSide, title: isText(200),
}
const USUAL = { turn: 0, error: null, version: "" }

/** Return the text of the file; numbers that are none are null, which JSON has. */
export function toFile(chart) {
  const link = linkTo().replace(/\?.*$/, `?${chart.state}`)
  return JSON.stringify({
    program: PROGRAM, title: chart.title, link, ...picked(CHART, chart),
    values: Array.from(chart.values, (value) => (Number.isFinite(value) ? value : null)), status: Array.from(chart.status),
  })
}

/** Return the chart in the text of a file: {chart}, or {why} there is none. */
export function fromFile(text) {
  let found = null
  try {
    found = JSON.parse(text)
  } catch {
    return { why: "This file is no JSON: choose one that Save has written." }
  }
  if (found?.program !== PROGRAM) return { why: "This file holds no chart: choose one that Save has written." }
  const chart = { ...USUAL, ...found }
  if (!isWhole(CHART, chart)) return { why: NUMBERS }
  const { x, y, values, status } = chart
  const isFull = (list, isRight) => Array.isArray(list) && list.length === x.count * y.count && list.every(isRight)
  if (!isFull(values, (value) => value === null || Number.isFinite(value)) ||
      !isFull(status, (one) => Number.isInteger(one) && one >= 0 && one < 256)) return { why: NUMBERS }
  const known = status.filter(Boolean).length
  return {
    chart: {
      ...picked(CHART, chart), x: picked(SIDE, x), y: picked(SIDE, y), said: "", left: null, known, share: known / status.length,
      values: Float64Array.from(values, (value) => value ?? NaN), status: Uint8Array.from(status),
    },
  }
}
