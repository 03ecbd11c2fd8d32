// What a cell of a chart means: its place in numbers and words, the state it stands for, and the words on its number.

// From this status on a cell has no number, see "sweep/quantity.py".
const NO_NUMBER = 10
const DIGITS = 6

const short = (value) => String(Number(value.toPrecision(DIGITS))).replaceAll("-", "−")
const placeOn = ({ low, high, count }, i) => (i === count - 1 ? high : low + (high - low) / (count - 1) * i)
const sidesOf = ({ x, y }) => [x, y]

/** Return the numbers of the parameters in a cell, [column, row]. */
export const placeOf = (chart, cell) => sidesOf(chart).map((side, k) => placeOn(side, cell[k]))

const where = (chart, cell) => {
  const place = placeOf(chart, cell)
  return sidesOf(chart).map(({ symbol }, k) => `${symbol} = ${short(place[k])}`).join(", ")
}

/** Return the words on a cell: where it is, and why it has no number; or its number. */
export function reading(chart, cell, why = "no number") {
  const at = cell[1] * chart.x.count + cell[0]
  const status = chart.status[at]
  const units = chart.units === "1" ? "" : ` ${chart.units}`
  const said = status === 0 ? "not computed yet"
    : status < NO_NUMBER ? `${chart.symbol} = ${short(chart.values[at])}${units}` : why
  return `${where(chart, cell)}: ${said}`
}

/** Return whether a cell was computed, and has no number. */
export const isWithoutNumber = (chart, [column, row]) => chart.status[row * chart.x.count + column] >= NO_NUMBER

// "name:coordinate" is a coordinate of the last place of a parameter, which is a list of places.
const lastPlace = (query, key) => query.get(key).split(";").at(-1).split(",")

/** Return the number of a parameter, or of a coordinate, in a query. */
export function numberIn(query, name) {
  const [key, coordinate] = name.split(":")
  return Number(coordinate === undefined ? query.get(key) : lastPlace(query, key)[coordinate])
}

/** Return the query of the state that a cell stands for, in its scene; of a list of places the last one alone is left. */
export function stateOf(chart, cell) {
  const query = new URLSearchParams(chart.state)
  const values = placeOf(chart, cell)
  sidesOf(chart).forEach(({ name }, k) => {
    const [key, coordinate] = name.split(":")
    const place = coordinate === undefined ? [] : lastPlace(query, key)
    place[coordinate ?? 0] = values[k]
    query.set(key, place.join(","))
  })
  return query.toString()
}

/** Return the part of both sides that is so many times smaller, around a cell. */
export function around(chart, cell, share) {
  const middle = placeOf(chart, cell)
  const [x, y] = sidesOf(chart).map(({ low, high }, k) => {
    const half = share * (high - low) / 2
    return [Math.max(low, middle[k] - half), Math.min(high, middle[k] + half)]
  })
  return { x, y }
}
