// The pictures of the scenes: each scene's are built once, then kept, and only filled with new data.

import { listen } from "../page/bus.js"
import { sayDragMe } from "../page/handle.js"
import { element } from "../page/elements.js"
import { cloudPlane } from "./cloud_plane.js"
import { planeGhost } from "./ghost.js"
import { onDark, setDark, setShades, watchTheme } from "./looks.js"
import { captionOf, createCell, fillTexts, isFolded, isInSight, nameOf, titleOf } from "./picture.js"
import { buildPlot } from "./plot.js"
import { colourPlot } from "./plot_looks.js"
import { shootPlot } from "./shots.js"
import { Source } from "./sources.js"
import { sphere } from "./sphere.js"
import { createStage } from "./stage.js"

// Milliseconds until the last colour of a theme has come.
const LATE = 2000
// Each draws a picture: {shoot(side), and where it has a ghost take(), show(…); the view of a plot}.
const KINDS = {
  sphere, cloud: cloudPlane,
  async plot(host, picture, source) {
    const plot = await buildPlot(host, picture, source)
    return { plot, shoot: (side) => shootPlot(plot, side), ...planeGhost(plot) }
  },
}

const built = new Map()
let shelf = null
let shown = null
let stand = null
let stage = null

// For the client; only one page has it.  `standing` resolves when there is a place for pictures.
export const gallery = {
  standing: new Promise((resolve) => { stand = resolve }),
  has: (name) => built.has(name),
  // Of the scene on show.
  source: (name) => shown?.sources.get(name),
  cell: (name) => shown.cells.find((cell) => nameOf(cell) === name),
  plot: (name) => shown.plots.find(({ model }) => model.name === name),
  cellsInSight: () => shown.cells.filter(isInSight),
  openCells: () => shown.cells.filter((cell) => !isFolded(cell)),
  get shown() { return shown },
  // The picture of the scene on show that was last under the mouse.
  pointed: null,
  build, enter, takeGhost, showGhost, shoot,
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
  setShades(description.shades)
  const grid = element("div.gallery")
  const scene = { name: description.name, grid, sources: new Map(), cells: [], plots: [], ghosts: [], shots: new Map(), painted: false }
  const places = description.pictures.map((picture) => {
    const { name } = picture
    const [cell, host] = createCell(picture, stage.cornerFor(name), () => { gallery.pointed = name })
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
  const drawn = await Promise.all(places.map(([host, picture]) => (
    KINDS[picture.kind](host, picture, source, () => shown === scene))))
  drawn.forEach((one, i) => {
    scene.shots.set(description.pictures[i].name, one.shoot)
    if (one.take) scene.ghosts.push(one)
    if (one.plot) scene.plots.push(one.plot)
  })
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
  const shots = gallery.cellsInSight().map((cell) => [titleOf(cell), captionOf(cell), shown.shots.get(nameOf(cell))(side)])
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
  const place = columns?.map((column) => gallery.source(source).data[column]?.[0])
  const cell = gallery.cell(picture)
  if (place?.[0] === undefined || !isInSight(cell)) return null
  const { frame, repainted: moved } = gallery.plot(picture)
  return {
    host: cell.querySelector(".host"), moved,
    place: () => ({
      left: `calc(${frame.x_scale.compute(place[0])}px + 1.2em)`, top: `${frame.y_scale.compute(place[1])}px`,
    }),
  }
}

export function render({ el }) {
  shelf = element("div.shelf")
  el.append(shelf)
  stage = createStage(shelf, gallery)
  sayDragMe(besideLayer)
  listen({
    texts(texts) { for (const cell of shown?.cells ?? []) fillTexts(cell, texts) },
    // In the frame after a state: the browser looks up styles then in any case.
    painted: () => requestAnimationFrame(followTheme),
  })
  watchTheme(followThemeForAWhile)
  stand()
}
