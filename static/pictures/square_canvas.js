// A square canvas of our own, as wide as its place: painted again when its data, its size or the page's theme change.

import { listen } from "../page/bus.js"
import { element } from "../page/mount.js"
import { zoom } from "../page/presenting.js"
import { isDark, setDark } from "./looks.js"
import { shootSquare } from "./shots.js"

// paint(ctx, {size, ratio, text, dark}): the side in device pixels, their number for each of the units in which lines and
// letters are measured, the colour of text, whether that is the lighter one of text and page.  A unit is a pixel of CSS,
// but larger in present mode.  {canvas, width: the side in pixels of CSS, request(), shoot(side)}.
export function squareCanvas(el, properties, paint, signal) {
  const canvas = element("canvas", properties)
  el.append(canvas)
  const ctx = canvas.getContext("2d")
  const own = { canvas, width: 0, request }
  let requested = false

  function draw() {
    if (!requested) return
    requested = false
    const ratio = window.devicePixelRatio || 1
    const size = Math.round(own.width * ratio)
    if (size === 0) return
    if (canvas.width !== size) canvas.width = canvas.height = size
    ctx.setTransform(1, 0, 0, 1, 0, 0)
    ctx.clearRect(0, 0, size, size)
    const text = getComputedStyle(canvas).color
    const dark = isDark(text)
    setDark(dark)
    paint(ctx, { size, ratio: ratio * zoom(), text, dark })
  }

  function request() {
    if (requested) return
    requested = true
    requestAnimationFrame(draw)
  }

  // As it is printed, `side` pixels wide.
  own.shoot = (side) => shootSquare(paint, side, zoom() * side / own.width)

  // With all the others of a state, rather than in the next frame.
  listen("paint", draw, signal)
  listen("presenting", request, signal)
  const theme = new MutationObserver(request)
  for (const item of [document.documentElement, document.body]) {
    theme.observe(item, { attributes: true, attributeFilter: ["data-theme", "class", "style"] })
  }
  const resize = new ResizeObserver(() => {
    own.width = canvas.clientWidth
    request()
  })
  resize.observe(canvas)
  signal.addEventListener("abort", () => {
    theme.disconnect()
    resize.disconnect()
  })
  request()
  return own
}
