// @ts-check
// The Poisson sphere.  Drag, arrow keys and touch rotate it; the far side is drawn first and dimmed.
//
// It draws the tracks in its options from their sources (columns g1, g2, g3).  Its own source, with the name of the picture,
// holds axis [3], label, circles [[axis, height, look]], marks [[γ, look, label]], and the look of the orbit if it depends on the
// state.  The option `clouds` names a source of clouds of points ("cloud.js").  The option `attitude` names a source and makes it a sphere fixed in space with a body inside
// ("body.js"); `title` describes it, and `bare` keeps only the equator of the graticule.
// On the far side the moving point has a dashed ring.

import { bodyIn } from "./body.js"
import { drawPoint } from "./body_parts.js"
import { pointLayer } from "./cloud.js"
import { FAINT } from "./ghost.js"
import { circlePath, drawMark, LOOKS } from "./looks.js"
import { moment } from "./moment.js"
import { curvesOf } from "./sources.js"
import { drawBeads } from "./swarm.js"
import { turnable } from "./turnable.js"
import { circle, graticule, scaled } from "./vectors.js"

/**
 * Return the guest that draws clouds of points on a sphere.
 * @param {Source} source
 * @returns {SphereGuest}
 */
function sphereClouds(source) {
  const layer = pointLayer(source)
  return {
    paint(sheet, near) {
      const { ratio, px, py, depth } = sheet
      layer.draw(sheet, ({ count, g1, g2, g3 }, add) => {
        for (let i = 0; i < count; i++) {
          const [x, y, z] = [g1[i], g2[i], g3[i]]
          if (depth(x, y, z) >= 0 === near) add(ratio * px(x, y), ratio * py(x, y, z))
        }
      })
    },
  }
}

/** @type {Vector[]} */
const AXES = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]

/** @param {Sheet} sheet @param {Vector} axis @param {string} label @param {boolean} near */
function drawAxis({ isNear, at, line, write }, axis, label, near) {
  if (isNear(axis) !== near) return
  line(axis, scaled(axis, 1.12))
  write(label, ...at(scaled(axis, 1.2)))
}

/**
 * Draw a sphere in an element.
 * @param {HTMLElement} el
 * @param {PictureDescription} options
 * @param {FindSource} source
 * @param {() => boolean} isShown whether the scene is on show
 * @returns {Drawn}
 */
export function sphere(el, options, source, isShown) {
  const inSpace = options.attitude !== undefined
  const own = source(options.name)
  // Layers in addition to the tracks.
  /** @type {SphereGuest | null} */
  const guest = options.clouds !== undefined ? sphereClouds(source(options.clouds))
    : inSpace ? bodyIn(own, source(options.attitude)) : null
  const lines = options.bare ? [circle([0, 0, 1], 0)] : graticule()

  const tracks = () => curvesOf({ ...options.tracks, ...(own.data.look && { "data-orbit": own.data.look }) }, source, ["g1", "g2", "g3"])

  /** @param {Sheet} on @param {boolean} near */
  function drawHalf(on, near) {
    const { ctx, text, stroke, use, isNear, at, write } = on
    use({ weight: 1 })
    ctx.fillStyle = text
    ctx.globalAlpha = near ? 0.3 : 0.12
    for (const line of lines) stroke(line, near)
    ctx.globalAlpha = near ? 0.9 : 0.4
    ctx.font = "14px system-ui, sans-serif"
    ctx.textAlign = "center"
    ctx.textBaseline = "middle"
    const { axis, label: name, circles = [], marks = [] } = own.data
    if (!inSpace) {
      AXES.forEach((direction, i) => drawAxis(on, direction, options.labels[i], near))
      if (axis?.length === 3) drawAxis(on, axis, name, near)
    }
    for (const [a, b, c, height, look] of circles) {
      use(LOOKS[look])
      stroke(circle([a, b, c], height), near)
    }
    ctx.globalAlpha = near ? 1 : 0.3
    for (const [look, track] of tracks()) {
      use(LOOKS[look])
      stroke(track, near)
    }
    guest?.paint(on, near)
    for (const [x, y, z, look, label] of marks) {
      const position = [x, y, z]
      if (isNear(position) !== near) continue
      drawMark(ctx, ...at(position), look, text)
      write(label, ...at(scaled(position, 1.15)))
    }
  }

  /** @param {Sheet} on */
  function paint(on) {
    const { ctx, half, scale } = on
    guest?.begin?.(on)
    drawHalf(on, false)
    ctx.globalAlpha = 0.5
    on.use({ weight: 1.5 })
    circlePath(ctx, half, half, scale)
    ctx.stroke()
    guest?.middle?.(on)
    drawHalf(on, true)
    ctx.globalAlpha = 1
    if (guest !== null) paintPoint(on)
  }

  /** @param {Sheet} on */
  function paintPoint(on) {
    const { ctx, px, py, depth } = on
    drawBeads(ctx, source("data-swarm"), inSpace ? ["mx", "my", "mz"] : ["g1", "g2", "g3"], ([x, y, z], i) => (
      [px(x[i], y[i]), py(x[i], y[i], z[i]), depth(x[i], y[i], z[i]) >= 0]))
    if (inSpace || moment.state?.g1 === undefined) return
    const { g1, g2, g3 } = moment.state
    drawPoint(on, [g1, g2, g3], on.isNear([g1, g2, g3]))
  }

  return turnable(el, inSpace ? "solid" : "sphere", {
    name: options.name, title: options.title ?? "Poisson sphere", what: "sphere", isShown,
    sources: [options.name, ...Object.keys(options.tracks), options.clouds, options.attitude, "data-swarm"].filter(Boolean).map(source),
    paint, paintMoving: guest === null ? paintPoint : null, take: tracks,
    paintGhost(on, kept) {
      for (const [name, track] of kept) {
        on.use(LOOKS[name])
        for (const near of [false, true]) {
          on.ctx.globalAlpha = near ? FAINT : 0.3 * FAINT
          on.stroke(track, near)
        }
      }
    },
  })
}
