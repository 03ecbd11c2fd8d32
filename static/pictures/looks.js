// Colours, dashes and weights on our own canvases.  "theme.py" describes the colours; a scene's description brings them.

// The colour of text in print.
export const INK = "rgb(16, 16, 16)"
export const POINT = "#F0E442"

// Name in CSS → [on a light page, on a dark one].
let shades = {}
// Colour on a light page → on a dark one.
let onDarkPage = new Map()
let dark = null

/** Take the shades of "theme.py": {name in CSS: [on a light page, on a dark one]}. */
export function setShades(given) {
  shades = given
  onDarkPage = new Map(Object.values(given))
  showShades()
}

function showShades() {
  for (const [name, colour] of shadesOf(dark)) document.documentElement.style.setProperty(`--${name}`, colour)
}

/** Return whether a page is dark whose text has this colour, in CSS. */
export function isDark(text) {
  const [red, green, blue] = text.match(/[\d.]+/g).map(Number)
  return red + green + blue > 382
}

/** Give everything that asks for colours from now on, and legends, those of a dark or a light page. */
export function setDark(value) {
  if (value === dark) return
  dark = value
  showShades()
}

/** Return [name, colour] of all shades, on a dark page or a light one. */
export const shadesOf = (isDarkPage) => Object.entries(shades).map(([name, pair]) => [name, pair[isDarkPage ? 1 : 0]])

/** Return a colour of "theme.py", "#rrggbb" or "#rrggbbaa", as it is on this page. */
export function shade(colour) {
  if (!dark) return colour
  return (onDarkPage.get(colour.slice(0, 7).toUpperCase()) ?? colour.slice(0, 7)) + colour.slice(7)
}

export const onDark = () => dark === true

/** Call `act` whenever the theme of the page may have changed. */
export function watchTheme(act) {
  const observer = new MutationObserver(act)
  for (const item of [document.documentElement, document.body]) {
    observer.observe(item, { attributes: true, attributeFilter: ["data-theme", "class", "style"] })
  }
}

const look = (name, weight, dash = []) => ({ get colour() { return shade(shades[name][0]) }, dash, weight })

// Without a colour: that of text.
export const LOOKS = {
  orbit: look("orbit", 2.2),
  second: look("second", 2.2),
  stable: look("stable", 3),
  unstable: look("unstable", 3, [7, 5]),
  muted: look("muted", 1),
  limit: { weight: 1, dash: [2, 3] },
  axis: { weight: 2.5 },
  mass: { weight: 3, colour: POINT },
}

/** Take the dash, the weight and the colour of a look; `text` is the colour of text. */
export function useLook(ctx, { colour = null, dash = [], weight }, text) {
  ctx.setLineDash(dash)
  ctx.lineWidth = weight
  ctx.strokeStyle = colour ?? text
}

/** Begin a path with a circle. */
export function circlePath(ctx, x, y, radius) {
  ctx.beginPath()
  ctx.arc(x, y, radius, 0, 2 * Math.PI)
}

/** Draw a point of a phase portrait: a dot, or a ring where it is unstable. */
export function drawMark(ctx, x, y, name, text) {
  circlePath(ctx, x, y, 5)
  ctx.setLineDash([])
  ctx.lineWidth = 2.5
  ctx.strokeStyle = ctx.fillStyle = LOOKS[name].colour ?? text
  if (name !== "unstable") ctx.fill()
  ctx.stroke()
}

/** Return [red, green, blue, alpha] of "#rrggbb" or "#rrggbbaa". */
export const bytesOf = (colour) => [1, 3, 5, 7].map((at) => Number.parseInt(colour.slice(at, at + 2) || "ff", 16))

// Of the first cloud of points, and of the second.
const CLOUDS = ["orbit", "second"]
export const cloudColour = (i) => bytesOf(LOOKS[CLOUDS[i]].colour)
