// @ts-check
// Cells of a chart: their parameters, the states that they stand for, and their readings.

import { NO_NUMBER } from "../pictures/chart_colours.js"

const DIGITS = 6

/** @param {number} value */
const short = (value) => String(Number(value.toPrecision(DIGITS))).replaceAll("-", "−")
/** @param {ChartAxis} axis @param {number} i */
const placeOn = ({ low, high, count }, i) => (i === count - 1 ? high : low + (high - low) / (count - 1) * i)
/** @param {Chart} chart */
const sidesOf = ({ x, y }) => [x, y]

/**
 * Return the parameters of a cell.
 * @param {Chart} chart
 * @param {Cell} cell
 */
export const placeOf = (chart, cell) => sidesOf(chart).map((side, k) => placeOn(side, cell[k]))

/** @param {Chart} chart @param {Cell} cell */
const where = (chart, cell) => {
  const place = placeOf(chart, cell)
  return sidesOf(chart).map(({ symbol }, k) => `${symbol} = ${short(place[k])}`).join(", ")
}

/**
 * Return the place of a cell and its number, or the reason that it has no number.
 * @param {Chart} chart
 * @param {Cell} cell
 * @param {string} why
 */
export function reading(chart, cell, why = "no number") {
  const at = cell[1] * chart.x.count + cell[0]
  const status = chart.status[at]
  const units = chart.units === "1" ? "" : ` ${chart.units}`
  const [, name] = chart.names.find(([value]) => value === chart.values[at]) ?? []
  const said = status === 0 ? "not computed yet"
    : status >= NO_NUMBER ? why
    : name ?? `${chart.symbol} = ${short(chart.values[at])}${units}`
  return `${where(chart, cell)}: ${said}`
}

/**
 * Return whether a cell was computed and has no number.
 * @param {Chart} chart
 * @param {Cell} cell
 */
export const isWithoutNumber = (chart, [column, row]) => chart.status[row * chart.x.count + column] >= NO_NUMBER

// "name:coordinate" is a coordinate of the last place in a parameter that holds a list of places.
/** @param {URLSearchParams} query @param {string} key @returns {(string | number)[]} */
const lastPlace = (query, key) => query.get(key).split(";").at(-1).split(",")

/**
 * Return the value of a parameter, or of a coordinate, in a query.
 * @param {URLSearchParams} query
 * @param {string} name
 */
export function numberIn(query, name) {
  const [key, coordinate] = name.split(":")
  return Number(coordinate === undefined ? query.get(key) : lastPlace(query, key)[Number(coordinate)])
}

/**
 * Return the query of the state that a cell stands for; a list of places is reduced to its last one.
 * @param {Chart} chart
 * @param {Cell} cell
 */
export function stateOf(chart, cell) {
  const query = new URLSearchParams(chart.state)
  const values = placeOf(chart, cell)
  sidesOf(chart).forEach(({ name }, k) => {
    const [key, coordinate] = name.split(":")
    const place = coordinate === undefined ? [] : lastPlace(query, key)
    place[Number(coordinate ?? 0)] = values[k]
    query.set(key, place.join(","))
  })
  return query.toString()
}

/**
 * Return the box around a cell that covers `share` of each side.
 * @param {Chart} chart
 * @param {Cell} cell
 * @param {number} share
 * @returns {ChartBox}
 */
export function around(chart, cell, share) {
  const middle = placeOf(chart, cell)
  const [x, y] = sidesOf(chart).map(({ low, high }, k) => {
    const half = share * (high - low) / 2
    return [Math.max(low, middle[k] - half), Math.min(high, middle[k] + half)]
  })
  return { x, y }
}
