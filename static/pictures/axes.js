// Ticks along a frame, with their numbers.

function segment(ctx, x0, y0, x1, y1) {
  ctx.beginPath()
  ctx.moveTo(x0, y0)
  ctx.lineTo(x1, y1)
  ctx.stroke()
}

/**
 * Draw the ticks below a frame and to the left of it.
 * @param {CanvasRenderingContext2D} ctx
 * @param {{left: number, right: number, top: number, bottom: number}} frame
 * @param {[number, string][]} below where each tick is, and its number
 * @param {[number, string][]} beside
 * @param {{length: number, gap: number, alpha?: number, isInside?: boolean}} look the length of a tick, how far away the
 *   numbers are, how strong; isInside: the last ones do not reach beyond the frame
 */
export function drawTicks(ctx, frame, below, beside, { length, gap, alpha = 1, isInside = false }) {
  for (const [x] of below) segment(ctx, x, frame.bottom, x, frame.bottom + length)
  for (const [y] of beside) segment(ctx, frame.left - length, y, frame.left, y)
  ctx.globalAlpha = alpha
  const isLast = (ticks, i) => isInside && i === ticks.length - 1
  below.forEach(([x, label], i) => {
    ctx.textBaseline = "top"
    ctx.textAlign = isLast(below, i) ? "right" : "center"
    ctx.fillText(label, x, frame.bottom + gap)
  })
  beside.forEach(([y, label], i) => {
    ctx.textBaseline = isLast(beside, i) ? "top" : "middle"
    ctx.textAlign = "right"
    ctx.fillText(label, frame.left - gap, y)
  })
}
