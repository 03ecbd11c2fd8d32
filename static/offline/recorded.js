// @ts-check
// Answers the requests of the page from the states that its file holds: the place of the server.

/**
 * The states among which sliders move; the first one is where they begin.
 * @typedef {{scene: string, names: string[], points: number[][], states: [strip: number, at: number][], queries: string[],
 *   fixed: string}} Family
 */
/**
 * What a file holds.  picks: scene → plot → the parameters of its axes; sources: scene → source → its columns; steps:
 * "lesson/number/revealed" → family; lessons: descriptions by name.
 * @typedef {{families: Family[], picks: Record<string, Record<string, string[]>>,
 *   sources: Record<string, Record<string, string[]>>, steps: Record<string, number>,
 *   scenes: Record<string, SceneDescription>, lessons: Record<string, Lesson>}} Recording
 */

import { written } from "../base/numbers.js"

const ABSENT = "This file does not contain that state: open the explorer by the link at the top."
const PLAIN = "Type a plain number: expressions need the explorer."
const NEAREST = "This file contains only some states: the nearest one is shown."

const DIGITS = 6
// A slider whose steps reach a little beyond its end could not reach the end.
const BELOW = 1 - 1e-9

/**
 * Return the point of a family that is nearest to a change: first in the changed parameters, then in the others.
 * @param {Family} family
 * @param {number} at the point on show
 * @param {Record<string, number>} changes
 * @param {Record<string, number>} [scales] the range of each parameter in the picture where the change was made
 */
export function nearestPoint({ names, points }, at, changes, scales = {}) {
  const here = points[at]
  const spans = names.map((name, i) => {
    const values = points.map((point) => point[i])
    return scales[name] ?? (Math.max(...values) - Math.min(...values) || 1)
  })
  /** @param {number[]} point @returns {[number, number, number]} */
  const distance = (point) => {
    let [asked, moved, away] = [0, 0, 0]
    names.forEach((name, i) => {
      if (name in changes) asked += ((point[i] - changes[name]) / spans[i]) ** 2
      else {
        moved += Number(point[i] !== here[i])
        away += ((point[i] - here[i]) / spans[i]) ** 2
      }
    })
    return [asked, moved, away]
  }
  // Among equally near points, prefer the current one.
  const [[nearest]] = [at, ...points.keys()].map((k) => [k, ...distance(points[k])])
    .toSorted(([, a, b, c], [, x, y, z]) => a - x || b - y || c - z)
  return nearest
}

/**
 * Return the function that answers requests.
 * @param {Recording} recording
 * @param {(number: number) => Promise<import("./strip.js").Strip>} stripAt
 * @param {string} query the query of the first state; "" for the first one of the file
 */
export function createRecorded({ families, picks, sources, steps, scenes, lessons }, stripAt, query) {
  /** @type {Map<string, [family: number, at: number]>} */
  const known = new Map()
  // A state belongs to the family that begins with this state, if there is one.
  families.forEach(({ queries: [first] }, i) => { if (!known.has(first)) known.set(first, [i, 0]) })
  families.forEach(({ queries }, i) => queries.forEach((one, k) => { if (!known.has(one)) known.set(one, [i, k]) }))
  let [here, at] = find(query) ?? [0, 0]
  const symbolOf = (/** @type {string} */ name) => (
    scenes[families[here].scene].controls.find((one) => one.name === name)?.symbol ?? name)
  let count = 0
  let note = ""
  /** @type {Texts} */
  let refused = {}
  const described = new Set()
  /** @type {Tree["ranges"]} */
  let ranges = {}
  // Maps scene → source → visible columns, so that unchanged columns are omitted.
  /** @type {Map<string, Map<string, string>>} */
  const filled = new Map()

  /** Return the place of a query, which may have further keys. @param {string} wanted @returns {[number, number] | null} */
  function find(wanted) {
    if (known.has(wanted)) return known.get(wanted)
    const given = new URLSearchParams(wanted)
    if (!given.has("scene")) return null
    return [...known].find(([one]) => [...new URLSearchParams(one)].every(([key, value]) => given.get(key) === value))?.[1] ?? null
  }

  /** @param {[number, number] | null} place */
  function go(place) {
    if (place === null) note = ABSENT
    else [here, at] = place
  }

  /** @param {Record<string, number | string>} values */
  function change(values) {
    const family = families[here]
    const changes = /** @type {Record<string, number>} */ (
      Object.fromEntries(Object.entries(values).filter(([name, value]) => family.names.includes(name) && typeof value === "number")))
    if (Object.keys(changes).length === 0) return
    const before = family.points[at]
    at = nearestPoint(family, at, changes)
    const back = family.names.filter((name, i) => !(name in changes) && family.points[at][i] !== before[i])
    if (back.length > 0) {
      const values = back.map((name) => `${symbolOf(name)} is ${written(family.points[at][family.names.indexOf(name)], DIGITS)} again`)
      note = `${values.join(", ")}: this file moves one slider at a time.`
    }
  }

  /** @param {Picked} picked */
  function pick([picture, x, y]) {
    const family = families[here]
    const axes = picks[family.scene]?.[picture]
    if (axes === undefined) return
    const [x0, x1, y0, y1] = ranges[picture]
    /** @param {number[]} values @returns {Record<string, number>} */
    const named = (values) => (
      Object.fromEntries(axes.map((name, i) => /** @type {[string, number]} */ ([name, values[i]])).filter(([name]) => family.names.includes(name))))
    at = nearestPoint(family, at, named([x, y]), named([x1 - x0, y1 - y0]))
    note = NEAREST
  }

  /** @param {StateRequest} request */
  function apply({ values, expressions = {}, picked, step, restore, reset, scene }) {
    note = ""
    if (restore !== undefined) {
      const inside = families[here].queries.indexOf(restore)
      go(inside < 0 ? find(restore) : [here, inside])
    }
    if (reset) go([here, 0])
    if (step !== undefined) go(step.join("/") in steps ? [steps[step.join("/")], 0] : null)
    else if (scene !== null && scene !== families[here].scene) {
      const found = families.findIndex((family) => family.scene === scene)
      go(found < 0 ? null : [found, 0])
    }
    if (picked !== undefined) pick(picked)
    change(values)
    refused = Object.fromEntries(Object.keys(expressions).map((name) => [`error-${name}`, PLAIN]))
  }

  /**
   * Return the controls of the sliders: the values of the state, which may be limited, over the range of the file.
   * @param {Tree["controls"]} own the controls of the state
   * @returns {Record<string, ControlValue>}
   */
  function controlsHere(own) {
    const { names, points } = families[here]
    /** @type {[string, ControlValue][]} */
    const sliders = names.map((name, i) => {
      const values = points.map((point) => point[i])
      const [low, high] = [Math.min(...values), Math.max(...values)]
      const [value = points[at][i], , , , idle = false] = /** @type {number[] & [any, any, any, any, boolean?]} */ (own[name] ?? [])
      return [name, [value, low, high, BELOW * (high - low) / Math.max(1, new Set(values).size - 1), idle]]
    })
    return Object.fromEntries(sliders)
  }

  /** Return the text about what moves in this file and what does not. */
  function fixedHere() {
    const { points, fixed } = families[here]
    const count = points.length === 1 ? "one computed state" : `${points.length} computed states here`
    return `This file contains ${count}.${fixed === "" ? "" : ` Fixed: ${fixed}.`} Everything moves in the explorer.`
  }

  /**
   * Return the sources that change, with all their columns: those that a state does not fill are empty.
   * @param {string} scene
   * @param {Tree} tree
   * @param {number} number of the strip
   */
  function changed(scene, tree, number) {
    const before = filled.get(scene) ?? new Map()
    filled.set(scene, before)
    /** @type {Record<string, Record<string, any>>} */
    const found = {}
    for (const [source, columns] of Object.entries(sources[scene])) {
      const whole = { ...Object.fromEntries(columns.map((column) => /** @type {[string, any[]]} */ ([column, []]))), ...tree.sources[source] }
      const text = JSON.stringify([number, whole])
      if (before.get(source) === text) continue
      before.set(source, text)
      found[source] = whole
    }
    return found
  }

  /**
   * Return the answer to a request, or to none: the first state.
   * @param {StateRequest | null} request
   * @returns {Promise<{head: Answer, block: ArrayBuffer}>}
   */
  return async (request) => {
    if (request !== null) apply(request)
    const { scene, states, queries } = families[here]
    const [number, index] = states[at]
    const [place, said, errors] = [queries[at], note, refused]
    const { trees, block } = await stripAt(number)
    const tree = trees[index]
    ranges = tree.ranges
    // Load the strips of the neighbours for the next move.
    for (const near of [at - 1, at + 1]) if (states[near] !== undefined && states[near][0] !== number) stripAt(states[near][0])
    count += 1
    const lesson = lessons[request?.lesson ?? ""]
    const fixed = fixedHere()
    const isNew = !described.has(scene)
    described.add(scene)
    const { notes } = tree.texts
    /** @type {StateAnswer} */
    const state = {
      number: count, answers: request?.requested ?? 0, query: place, scene, progress: null,
      tree: {
        ...tree, sources: changed(scene, tree, number), controls: controlsHere(tree.controls), ranges: request?.held ? {} : tree.ranges,
        texts: { ...tree.texts, ...errors, fixed, notes: [said, notes].filter(Boolean).join("\n") },
      },
    }
    return { head: { state, ...(isNew && { scene: scenes[scene] }), ...(lesson && { lesson }) }, block }
  }
}
