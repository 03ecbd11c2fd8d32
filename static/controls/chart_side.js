// @ts-check
// One side of a chart in its form: parameter, range, and number of cells.

import { element } from "../page/elements.js"
import { optionsOf } from "./dialog.js"

const CELLS = 192
const MOST_SIDE = 256
const DIGITS = 6

/**
 * Return the form of a side.
 * @param {"x" | "y"} label
 * @param {(name: string) => [number, number]} ends returns the range of a parameter
 * @param {() => void} chosen is called when the user has chosen another parameter
 */
export function sideForm(label, ends, chosen) {
  const name = element(`select.param-${label}`, {
    ariaLabel: `Parameter ${label}`,
    onchange: () => {
      put(...ends(name.value))
      chosen()
    },
  })
  /** @param {string} what @param {object} properties */
  const box = (what, properties) => element(`input.param-${label}-${what}`, {
    type: "number", ariaLabel: `${label} ${what}`, ...properties,
  })
  const [low, high] = ["from", "to"].map((what) => box(what, { step: "any" }))
  const count = box("cells", { min: 2, max: MOST_SIDE, step: 1, value: CELLS })
  /** @param {number} from @param {number} to */
  const put = (from, to) => {
    ;[low.valueAsNumber, high.valueAsNumber] = [from, to].map((end) => Number(end.toPrecision(DIGITS)))
  }
  return {
    frame: element("div.side", name, element("label", "from ", low), element("label", "to ", high),
      element("label", "cells ", count)),
    /** @param {{name: string, symbol?: string}[]} controls */
    offer(controls) { name.replaceChildren(...optionsOf(controls.map((one) => [one.name, one.symbol]))) },
    get name() { return name.value },
    /** @param {string} wanted @param {number} from @param {number} to @param {number} [cells] */
    choose(wanted, from, to, cells = count.valueAsNumber) {
      name.value = wanted
      count.valueAsNumber = cells
      put(from, to)
    },
    /** @returns {ChartAxis} */
    value: () => ({
      name: name.value, symbol: name.selectedOptions[0]?.textContent ?? "", low: low.valueAsNumber, high: high.valueAsNumber,
      count: count.valueAsNumber,
    }),
  }
}
