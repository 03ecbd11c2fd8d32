// @ts-check
// A square picture in space that drag, arrow keys and touch turn.  All of them begin with the view in the address.

import { listen, tell } from "../base/bus.js"
import { onDrag } from "../base/drag.js"
import { within } from "../base/numbers.js"
import { arrowOf } from "../base/keys.js"
import { squareCanvas } from "./canvas.js"
import { createSheet, RADIUS } from "./projection.js"

const STEP = Math.PI / 36
/** @type {[number, number]} */
const HOME = [0.6, 0.35]

/**
 * Draw a turnable picture in an element, see `squareCanvas`.
 * @template Image
 * @param {HTMLElement} el
 * @param {string} className
 * @param {{name: string, title: string, what: string, isShown: () => boolean, sources: Source[],
 *   paint: (on: Sheet) => void, paintMoving?: ((on: Sheet) => void) | null,
 *   take: () => Image, paintGhost: (on: Sheet, image: Image) => void}} picture its name and title, what turns ("sphere"), and
 *   whether its scene is on show; `sources` are those at whose change it is painted, and paintMoving draws what moves in time, on a
 *   canvas above: the rest is not painted again for it.  take() returns what paintGhost draws of an earlier state
 * @returns {Drawn}
 */
export function turnable(el, className, {
  name, title, what, isShown, sources, paint, paintMoving = null, take, paintGhost,
}) {
  let turn = HOME
  /** @type {Image | null} */
  let kept = null
  /** @type {ReturnType<typeof squareCanvas> | null} */
  let ghost = null
  const own = squareCanvas(el, className, {
    tabIndex: 0, role: "application", ariaRoleDescription: `rotatable ${what}`,
    ariaLabel: `${title}: arrow keys turn it, Home turns it back`,
    title: "Drag to turn; Home turns it back",
    /** @param {KeyboardEvent} event */
    onkeydown(event) {
      const arrow = arrowOf(event)
      if (event.key === "Home") rotate(...HOME)
      else if (arrow !== undefined) rotate(turn[0] - STEP * arrow[0], turn[1] + STEP * arrow[1])
      else return
      event.preventDefault()
      event.stopPropagation()
    },
  }, (ctx, look) => {
    paint(createSheet(ctx, look, turn))
    own.canvas.dataset.turn = turn.map((x) => x.toFixed(4)).join(" ")
  })
  /** @param {string} layer @param {(on: Sheet) => void} act */
  const canvasAbove = (layer, act) => squareCanvas(el, layer, { ariaHidden: true }, (ctx, look) => act(createSheet(ctx, look, turn)))
  const above = paintMoving && canvasAbove("moving", paintMoving)
  const request = () => { for (const layer of [own, above, ghost]) layer?.request() }

  const askForTurn = () => tell("ask-client", (keys) => { turn = [Number(keys.az), Number(keys.el)] })
  askForTurn()

  /** @param {number} azimuth @param {number} elevation */
  function rotate(azimuth, elevation) {
    const limit = Math.PI / 2
    const wrapped = Math.atan2(Math.sin(azimuth), Math.cos(azimuth))
    turn = [wrapped, within(elevation, -limit, limit)]
    tell("url", { az: turn[0].toFixed(4), el: turn[1].toFixed(4) })
    tell("turned", [name, ...turn])
    request()
  }

  onDrag(own.canvas, ({ clientX, clientY }) => [clientX, clientY, ...turn], ([x, y, azimuth, elevation], { clientX, clientY }) => {
    const perPixel = 2 / (own.canvas.clientWidth * RADIUS)
    rotate(azimuth - (clientX - x) * perPixel, elevation + (clientY - y) * perPixel)
  })

  listen({
    // The picture of another scene may have been rotated meanwhile.
    enter() { if (isShown()) askForTurn() },
    turn([turned, ...angles]) { if (isShown() && turned === name && angles.every(Number.isFinite)) rotate(...angles) },
    time() { if (isShown()) (above ?? own).request() },
  })
  for (const source of sources) source.watch(request)
  return {
    /** Return the picture on a canvas of its own. @param {ShotLook} look */
    shoot(look) {
      const sheet = own.shoot(look)
      if (above !== null) {
        const ctx = sheet.getContext("2d")
        ctx.resetTransform()
        ctx.drawImage(above.shoot(look), 0, 0)
      }
      return sheet
    },
    take,
    show(image) {
      if (image === kept) return
      kept = image
      ghost ??= canvasAbove("ghost", (on) => { if (kept !== null) paintGhost(on, kept) })
      ghost.request()
    },
  }
}
