// The pictures of the scenes: each scene's are built once, then kept, and only filled with new data.

import { listen } from "../page/bus.js"
import { sayDragMe } from "../page/handle.js"
import { element, lifetime } from "../page/mount.js"
import { wear } from "../page/presenting.js"
import { cloudPlane } from "./cloud_plane.js"
import { planeGhost } from "./ghost.js"
import { onDark, setDark } from "./looks.js"
import { buildPlot, colourPlot } from "./plot.js"
import { shootPlot } from "./shots.js"
import { Source } from "./sources.js"
import { sphere } from "./sphere.js"
import { createStage } from "./stage.js"

// Milliseconds until the last colour of a theme has come.
const LATE = 2000
const KINDS = { sphere, cloud: cloudPlane }
// What the mouse does in a picture.
const HINTS = {
  drag: "Drag or click: what you point at is chosen",
  box: "Click: what you point at is chosen. Drag a box: a closer look",
  click: "Click: what you point at is chosen",
}

const built = new Map()
let shelf = null
let shown = null
let signal = null
let stand = null
let stage = null

// For the client; only one page has it.  `standing` resolves when there is a place for pictures.
export const gallery = {
  standing: new Promise((resolve) => { stand = resolve }),
  has: (name) => built.has(name),
  source: (name) => shown?.sources.get(name),
  get shown() { return shown },
  // The picture of the scene on show that was last under the mouse.
  pointed: null,
  build, enter, takeGhost, showGhost, shoot,
}

// [cell, host]: caption, place for the picture, line about what is under the mouse.
function cellOf({ name, folded, hands }) {
  const host = element("div", { className: `host hands-${hands}`, title: HINTS[hands] ?? "" })
  const under = element("output", { className: "text hover", hidden: true })
  const cell = element("section", { className: `picture picture-${name}` },
    element("h2", { className: "text caption" },
      element("span", { className: "title" }), "\n", element("span", { className: "said" })),
    stage.cornerFor(name), host, under)
  cell.dataset.name = name
  cell.classList.toggle("folded", folded !== null)
  // Until it is unfolded the server does not draw it.
  if (folded !== null) cell.dataset.late = ""
  cell.addEventListener("pointerenter", () => { gallery.pointed = name })
  cell.addEventListener("mouseleave", () => { under.hidden = true })
  return [cell, host]
}

// The colours of text and of what is less important, by this theme.
function inks() {
  const style = getComputedStyle(shelf)
  return [style.color, style.getPropertyValue("--mui-palette-text-secondary") || style.color]
}

function colour(scene) {
  const [text, muted] = inks()
  for (const plot of scene.plots) colourPlot(plot, text, muted)
  scene.coloured = [text, muted].join()
}

// The theme turns these colours some time after its name, and not both at once.
function followTheme() {
  const now = inks().join()
  for (const scene of built.values()) if (scene.coloured !== now) colour(scene)
}

let followed = 0

function followThemeForAWhile() {
  const isFollowing = performance.now() < followed
  followed = performance.now() + LATE
  const step = () => {
    followTheme()
    if (performance.now() < followed) requestAnimationFrame(step)
  }
  if (!isFollowing) step()
}

// The pictures of a scene that the server has described, not seen yet: {name, grid, cells, plots, sources, …}.
async function build(description) {
  const grid = element("div", { className: "gallery" })
  const scene = { name: description.name, grid, sources: new Map(), cells: [], plots: [], ghosts: [], shots: new Map(), painted: false }
  const places = description.pictures.map((picture) => {
    const [cell, host] = cellOf(picture)
    grid.append(cell)
    scene.cells.push(cell)
    return [host, picture]
  })
  const source = (name) => {
    if (!scene.sources.has(name)) scene.sources.set(name, new Source())
    return scene.sources.get(name)
  }
  // The player follows the orbit's, whether or not a picture draws it.
  for (const name of [...description.tracks, ...Object.keys(description.dots)]) source(name)
  // In place, for its size, but not to be seen before it is filled.
  grid.classList.add("away")
  shelf.append(grid)
  stage.place(scene)
  for (const [host, picture] of places) {
    const drawn = KINDS[picture.kind]?.(host, picture, source, signal, () => shown === scene)
    if (drawn === undefined) continue
    scene.shots.set(picture.name, drawn.shoot)
    if (drawn.take) scene.ghosts.push(drawn)
  }
  scene.plots = await Promise.all(places.filter(([, { kind }]) => kind === "plot")
    .map(([host, picture]) => buildPlot(host, picture, source, signal)))
  for (const plot of scene.plots) scene.shots.set(plot.model.name, (side) => shootPlot(plot, side))
  scene.ghosts.push(...scene.plots.map(planeGhost))
  colour(scene)
  stage.size(scene)
  while (!scene.plots.every((plot) => plot.has_finished())) await new Promise(requestAnimationFrame)
  built.set(scene.name, scene)
  return scene
}

// What is painted, as a faint copy: to be shown later, beside another state.
function takeGhost() {
  const scene = shown
  return { scene, parts: scene.ghosts.map((ghost) => ghost.take()) }
}

// Of another scene there is nothing to be seen; null: of none.
function showGhost(taken) {
  shown.ghosts.forEach((ghost, i) => ghost.show(taken?.scene === shown ? taken.parts[i] : null))
}

// Those in sight as they are printed, so many pixels wide: [[title, caption, canvas], …].
function shoot(side) {
  const wasDark = onDark()
  setDark(false)
  const shots = shown.cells.filter((cell) => cell.checkVisibility()).map((cell) => [
    cell.querySelector(".title").textContent, cell.querySelector(".said").textContent, shown.shots.get(cell.dataset.name)(side)])
  setDark(wasDark)
  colour(shown)
  return shots
}

// Show the pictures of this scene in place of those on show.
function enter(name) {
  shown?.grid.classList.add("away")
  shown = built.get(name)
  gallery.pointed = null
  shown.grid.classList.remove("away")
  stage.enter(shown)
  return shown
}

// Beside the first of what a layer draws.
function besideLayer({ picture, source, columns }) {
  const plot = shown.plots.find(({ model }) => model.name === picture)
  const place = columns?.map((column) => shown.sources.get(source).data[column]?.[0])
  const cell = shown.cells.find(({ dataset }) => dataset.name === picture)
  if (place?.[0] === undefined || !cell.checkVisibility()) return null
  return {
    host: cell.querySelector(".host"), moved: plot.repainted,
    place: () => ({
      left: `calc(${plot.frame.x_scale.compute(place[0])}px + 1.2em)`, top: `${plot.frame.y_scale.compute(place[1])}px`,
    }),
  }
}

function showTexts(texts) {
  for (const cell of shown?.cells ?? []) {
    const { [cell.dataset.name]: text, [`hover-${cell.dataset.name}`]: hover } = texts
    if (text !== undefined) {
      const [title, ...said] = text.split("\n")
      cell.querySelector(".title").textContent = title
      cell.querySelector(".said").textContent = said.join(" ")
    }
    if (hover !== undefined) {
      const under = cell.querySelector(".hover")
      under.textContent = hover
      under.hidden = hover === "" || !cell.matches(":hover")
    }
  }
}

export function render({ model, view, el }) {
  // Rendered once more: the same pictures in the new place.
  if (shelf !== null) return void el.append(shelf)
  signal = lifetime({ model, view })
  shelf = element("div", { className: "shelf" })
  el.append(shelf)
  wear(el, signal)
  stage = createStage(shelf, () => shown, signal)
  sayDragMe(besideLayer, signal)
  listen("texts", showTexts, signal)
  const theme = new MutationObserver(followThemeForAWhile)
  for (const item of [document.documentElement, document.body]) {
    theme.observe(item, { attributes: true, attributeFilter: ["data-theme", "class", "style"] })
  }
  // In the frame after a state: the browser looks up styles then in any case.
  listen("painted", () => requestAnimationFrame(followTheme), signal)
  signal.addEventListener("abort", () => theme.disconnect())
  stand()
}
