// @ts-check
// The frame of a Bokeh plot: its axes, in pixels of the plot.

/**
 * Return the pixels of a point.
 * @param {Pick<PlotView, "frame">} plot
 * @param {number[]} point values on the axes
 * @returns {[number, number]}
 */
export const toPixels = ({ frame }, [x, y]) => [frame.x_scale.compute(x), frame.y_scale.compute(y)]

/**
 * Return the values on the axes at some pixels.
 * @param {Pick<PlotView, "frame">} plot
 * @param {number[]} pixels
 * @returns {[number, number]}
 */
export const toValues = ({ frame }, [x, y]) => [frame.x_scale.invert(x), frame.y_scale.invert(y)]

/**
 * Clip what is drawn from now on.
 * @param {CanvasRenderingContext2D} ctx
 * @param {Frame} frame
 */
export function clipTo(ctx, { x0, y0, x1, y1 }) {
  ctx.beginPath()
  ctx.rect(x0, y0, x1 - x0, y1 - y0)
  ctx.clip()
}

/**
 * Return the style of a canvas over a plot, into which the style sheets of the page do not reach.
 * @param {string} more declarations
 */
export const covering = (more) => `position: absolute; inset: 0; width: 100%; height: 100%; ${more}`
