// @ts-check
// The pictures of the scenes.  The pictures of a scene are built once, kept, and filled with new data.

import { listen } from "../base/bus.js"
import { sayDragMe } from "../base/handle.js"
import { element } from "../base/elements.js"
import { zoom } from "../base/modes.js"
import { cloudPlane } from "./cloud_plane.js"
import { toPixels } from "./frame.js"
import { planeGhost, shootPlot } from "./ghost.js"
import { ink, inks, setShades } from "./looks.js"
import { createCell, fillCaption, fillHover, isFolded, isInSight, nameOf } from "./picture.js"
import { buildPlot } from "./plot.js"
import { colourPlot } from "./plot_looks.js"
import { Source } from "./sources.js"
import { sphere } from "./sphere.js"
import { createStage } from "./stage.js"
import { torus } from "./torus.js"

// Functions that draw a picture on a canvas of its own, by its kind.
/** @type {Record<string, (host: HTMLElement, picture: PictureDescription, source: FindSource, isShown: () => boolean) => Drawn>} */
const CANVASES = { sphere, torus, cloud: cloudPlane }

/** @type {Map<string, Scene>} */
const built = new Map()
/** @type {HTMLElement} */
let shelf = null
/** @type {Scene | null} */
let shown = null
/** @type {() => void} */
let stand = null
/** @type {ReturnType<typeof createStage>} */
let stage = null

/** The pictures of this page.  `standing` resolves when they can be built; most functions concern the scene on show. */
export const gallery = {
  standing: /** @type {Promise<void>} */ (new Promise((resolve) => { stand = resolve })),
  /** @param {string} name */
  has: (name) => built.get(name)?.isComplete ?? false,
  /** @param {string} name */
  source: (name) => shown?.sources.get(name),
  /** @param {string} name */
  cell: (name) => shown.cells.find((cell) => nameOf(cell) === name),
  /** @param {string} name */
  plot: (name) => shown.plots.find(({ model }) => model.name === name),
  get plots() { return shown?.plots ?? [] },
  cellsInSight: () => shown.cells.filter(isInSight),
  openCells: () => shown.cells.filter((cell) => !isFolded(cell)),
  get shown() { return shown },
  build, enter, takeGhost, showGhost, shoot,
}

/** @param {Scene} scene */
function colour({ plots }) {
  for (const plot of plots) colourPlot(plot, ...inks())
}

/** @param {HTMLElement} host @param {PictureDescription} picture @param {FindSource} source @returns {Promise<Drawn>} */
async function drawPlot(host, picture, source) {
  const plot = await buildPlot(host, picture, source)
  return { plot, shoot: (look) => shootPlot(plot, look), ...planeGhost(plot) }
}

/**
 * Build the pictures of a scene out of sight: first the canvases, then the plots, which take longer.
 * @param {SceneDescription} description
 * @param {() => Promise<void>} [begun] is called between them, if there are canvases
 */
async function build(description, begun = async () => {}) {
  setShades(description.shades)
  const grid = element("div.gallery")
  /** @type {FindSource} */
  const source = (name) => {
    if (!scene.sources.has(name)) scene.sources.set(name, new Source())
    return scene.sources.get(name)
  }
  /** @type {Scene} */
  const scene = { name: description.name, lead: description.lead, grid, sources: new Map(), cells: [], plots: [], ranges: {}, beside: {}, ghosts: [], shots: new Map(), sizes: new Map(), painted: false, isComplete: false, source }
  const places = description.pictures.map((picture) => {
    const [cell, host] = createCell(picture, stage.cornerFor(picture.name))
    grid.append(cell)
    scene.cells.push(cell)
    return /** @type {[HTMLElement, PictureDescription]} */ ([host, picture])
  })
  // The player reads the orbit even if no picture draws it.
  for (const name of [...description.tracks, ...Object.keys(description.dots)]) source(name)
  // Insert the picture at once, to get its size, but hide it until it is filled.
  grid.classList.add("away")
  shelf.append(grid)
  stage.place(scene)
  built.set(scene.name, scene)
  const canvases = places.map(([host, picture]) => CANVASES[picture.kind]?.(host, picture, source, () => shown === scene))
  if (canvases.some(Boolean)) await begun()
  const drawn = await Promise.all(places.map(([host, picture], i) => canvases[i] ?? drawPlot(host, picture, source)))
  drawn.forEach((one, i) => {
    scene.shots.set(description.pictures[i].name, one.shoot)
    if (one.take) scene.ghosts.push(/** @type {Ghost} */ (one))
    if (one.plot) scene.plots.push(one.plot)
  })
  colour(scene)
  stage.size(scene)
  while (!scene.plots.every((plot) => plot.has_finished())) await new Promise(requestAnimationFrame)
  scene.isComplete = true
  return scene
}

/** Return a copy of the pictures on show, to be shown faintly with another state. */
function takeGhost() {
  const scene = shown
  return { scene, parts: scene.ghosts.map((ghost) => ghost.take()) }
}

/** Show a copy, if it belongs to the scene on show; null removes it. @param {ReturnType<typeof takeGhost> | null} taken */
function showGhost(taken) {
  shown.ghosts.forEach((ghost, i) => ghost.show(taken?.scene === shown ? taken.parts[i] : null))
}

/**
 * Lay a copy for print over each picture in sight, and return the copies.  The page is light.
 * @param {number} side width in pixels
 */
function shoot(side) {
  const shots = gallery.cellsInSight().map((cell) => {
    const host = cell.querySelector(".host")
    const edge = host.clientWidth / zoom(host.clientWidth)
    const sheet = shown.shots.get(nameOf(cell))({ edge, ratio: side / edge, text: ink(), dark: false })
    sheet.className = "printed"
    host.append(sheet)
    return sheet
  })
  colour(shown)
  return shots
}

/** Show the pictures of another scene. @param {string} name */
function enter(name) {
  shown?.grid.classList.add("away")
  shown = built.get(name)
  shown.grid.classList.remove("away")
  stage.enter(shown)
  return shown
}

/** Return the place beside the first point of a layer, see `sayDragMe`. @param {Extract<Handle, {picture: string}>} handle */
function besideLayer({ picture, source, columns }) {
  const point = columns?.map((column) => gallery.source(source).data[column]?.[0])
  const cell = gallery.cell(picture)
  if (point?.[0] === undefined || !isInSight(cell)) return null
  const plot = gallery.plot(picture)
  return {
    host: cell.querySelector(".host"), moved: plot.repainted,
    place() {
      const [left, top] = toPixels(plot, point)
      return { left: `calc(${left}px + 1.2em)`, top: `${top}px` }
    },
  }
}

/** Render the pictures. @param {{el: HTMLElement}} part */
export function render({ el }) {
  shelf = element("div.shelf")
  el.append(shelf)
  // A pinch on a touchpad does not zoom the page.
  shelf.addEventListener("wheel", (event) => { if (event.ctrlKey) event.preventDefault() }, { passive: false })
  stage = createStage(shelf, gallery)
  sayDragMe(besideLayer)
  listen({
    captions(captions) { for (const cell of shown?.cells ?? []) fillCaption(cell, captions) },
    texts(texts) {
      for (const cell of shown?.cells ?? []) {
        fillHover(cell, texts)
        if (texts.windowed !== undefined) cell.classList.toggle("windowed", texts.windowed.split(" ").includes(nameOf(cell)))
      }
    },
    themed() { for (const scene of built.values()) colour(scene) },
  })
  stand()
}
