// @ts-check
// Colours, dashes and line widths on our own canvases.  The colours come from "theme.py" with the description of a scene.

// Text and secondary text on a light page and on a dark one.
/** @type {[string, string][]} */
const INKS = [["rgba(0, 0, 0, 0.87)", "rgba(0, 0, 0, 0.6)"], ["rgb(255, 255, 255)", "rgba(255, 255, 255, 0.7)"]]
export const POINT = "#F0E442"

// Maps a CSS name to [colour on a light page, colour on a dark page].
/** @type {Record<string, [string, string]>} */
let shades = {}
// Maps a colour on a light page to the colour on a dark page.
/** @type {Map<string, string>} */
let onDarkPage = new Map()
let dark = false

/**
 * Set the shades of "theme.py".
 * @param {Record<string, [string, string]>} given CSS name → [colour on a light page, colour on a dark page]
 */
export function setShades(given) {
  shades = given
  onDarkPage = new Map(Object.values(given))
  for (const [name, pair] of Object.entries(given)) document.documentElement.style.setProperty(`--${name}`, `light-dark(${pair})`)
}

/** Return the text colour on paper. */
export const ink = () => shades.ink[0]

/**
 * Choose the colours of a dark or a light page for everything that is drawn from now on.
 * @param {boolean} value
 */
export const setDark = (value) => { dark = value }

/**
 * Return a colour of "theme.py" as it is on this page.
 * @param {string} colour "#rrggbb" or "#rrggbbaa"
 */
export function shade(colour) {
  if (!dark) return colour
  return (onDarkPage.get(colour.slice(0, 7).toUpperCase()) ?? colour.slice(0, 7)) + colour.slice(7)
}

/** Return whether the page is dark. */
export const onDark = () => dark
/** Return the colours of text and of secondary text. */
export const inks = () => INKS[Number(dark)]

/** @param {string} name @param {number} weight @param {number[]} dash @returns {Look} */
const look = (name, weight, dash = []) => ({ get colour() { return shade(shades[name][0]) }, dash, weight })

// Looks without a colour use the text colour.
/** @type {Record<string, Look>} */
export const LOOKS = {
  orbit: look("orbit", 2.2),
  second: look("second", 2.2),
  stable: look("stable", 3),
  unstable: look("unstable", 3, [7, 5]),
  ...Object.fromEntries(Array.from({ length: 8 }, (_, i) => [`chosen-${i}`, look(`chosen-${i}`, 2.2)])),
  muted: look("muted", 1),
  limit: { weight: 1, dash: [2, 3] },
  axis: { weight: 2.5 },
  mass: { weight: 3 },
}

/**
 * Set the dash, width and colour of lines.
 * @param {CanvasRenderingContext2D} ctx
 * @param {Look} look
 * @param {string} text the colour of text
 */
export function useLook(ctx, { colour = null, dash = [], weight }, text) {
  ctx.setLineDash(dash)
  ctx.lineWidth = weight
  ctx.strokeStyle = colour ?? text
}

/**
 * Begin a path with a circle.
 * @param {CanvasRenderingContext2D} ctx
 * @param {number} x
 * @param {number} y
 * @param {number} radius
 */
export function circlePath(ctx, x, y, radius) {
  ctx.beginPath()
  ctx.arc(x, y, radius, 0, 2 * Math.PI)
}

/**
 * Fill a circle, whose path stays for its outline.
 * @param {CanvasRenderingContext2D} ctx
 * @param {number} x
 * @param {number} y
 * @param {number} radius
 * @param {string | CanvasGradient} colour
 */
export function drawDisc(ctx, x, y, radius, colour) {
  circlePath(ctx, x, y, radius)
  ctx.fillStyle = colour
  ctx.fill()
}

/**
 * Begin a path with a polyline.
 * @param {CanvasRenderingContext2D} ctx
 * @param {Iterable<number[]>} points
 */
export function linePath(ctx, points) {
  ctx.beginPath()
  for (const [x, y] of points) ctx.lineTo(x, y)
}

/**
 * Draw a point of a phase portrait: a dot, or a ring if it is unstable.
 * @param {CanvasRenderingContext2D} ctx
 * @param {number} x
 * @param {number} y
 * @param {string} name the name of its look
 * @param {string} text the colour of text
 */
export function drawMark(ctx, x, y, name, text) {
  circlePath(ctx, x, y, 5)
  ctx.setLineDash([])
  ctx.lineWidth = 2.5
  ctx.strokeStyle = ctx.fillStyle = LOOKS[name].colour ?? text
  if (name !== "unstable") ctx.fill()
  ctx.stroke()
}

/**
 * Return [red, green, blue, alpha] of a colour.
 * @param {string} colour "#rrggbb" or "#rrggbbaa"
 */
export const bytesOf = (colour) => [1, 3, 5, 7].map((at) => Number.parseInt(colour.slice(at, at + 2) || "ff", 16))

// Looks of the first and the second cloud of points.
const CLOUDS = ["orbit", "second"]
/**
 * Return [red, green, blue, alpha] of a cloud of points.
 * @param {number} i
 */
export const cloudColour = (i) => bytesOf(LOOKS[CLOUDS[i]].colour)
