// A chart as a file: all that is needed to show it again, and to compute on from it.

import { linkTo } from "../page/embedding.js"

const PROGRAM = "hess-explorer chart"
const MOST_SIDE = 256
const MOST_LINK = 2000

// Numbers that are none as null, which JSON has.
export function toFile(chart) {
  const { scene, state, quantity, part, title, symbol, units, turn, level, error, version, x, y, values, status } = chart
  const link = linkTo().replace(/\?.*$/, `?${state}`)
  return JSON.stringify({
    program: PROGRAM, title, link, scene, state, quantity, part, symbol, units, turn, level, error, version, x, y,
    values: Array.from(values, (value) => (Number.isFinite(value) ? value : null)), status: Array.from(status),
  })
}

const isText = (most) => (value) => typeof value === "string" && value.length <= most
const isCount = (value) => Number.isInteger(value) && value >= 2 && value <= MOST_SIDE
const isSide = (side) => side !== null && typeof side === "object" && isText(40)(side.name) && isText(40)(side.symbol)
  && Number.isFinite(side.low) && Number.isFinite(side.high) && side.low < side.high && isCount(side.count)

// The chart in a file: {chart}, or {why} there is none.
export function fromFile(text) {
  let found = null
  try {
    found = JSON.parse(text)
  } catch {
    return { why: "This file is no JSON: choose one that Save has written." }
  }
  if (found?.program !== PROGRAM) return { why: "This file holds no chart: choose one that Save has written." }
  const { scene, state, quantity, part, title, symbol, units, turn = 0, level, error = null, version = "", x, y, values, status } = found
  const texts = [scene, quantity, title, symbol, units, level, version]
  const isWhole = texts.every(isText(200)) && isText(MOST_LINK)(state) && Number.isInteger(part) && turn >= 0 && Number.isFinite(turn)
    && (error === null || Number.isFinite(error))
    && isSide(x) && isSide(y)
  const cells = isWhole ? x.count * y.count : 0
  const isFull = isWhole && Array.isArray(values) && Array.isArray(status) && values.length === cells && status.length === cells
    && values.every((value) => value === null || Number.isFinite(value))
    && status.every((one) => Number.isInteger(one) && one >= 0 && one < 256)
  if (!isFull) return { why: "A part of this chart is missing or is no number: save it once more." }
  return {
    chart: {
      scene, state, quantity, part, title, symbol, units, turn, level, error, version, said: "", left: null, known: status.filter(Boolean).length,
      share: status.filter(Boolean).length / cells,
      x: { name: x.name, symbol: x.symbol, low: x.low, high: x.high, count: x.count },
      y: { name: y.name, symbol: y.symbol, low: y.low, high: y.high, count: y.count },
      values: Float64Array.from(values, (value) => value ?? NaN), status: Uint8Array.from(status),
    },
  }
}
