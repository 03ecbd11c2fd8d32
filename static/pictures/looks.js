// Colours, dashes and weights on our own canvases; "theme.py" has the same for Bokeh.  null: the colour of text.

// Name in CSS, on a light page, on a dark one.
const SHADES = [
  ["orbit", "#0072B2", "#4DAEEB"],
  ["stable", "#009E73", "#1DBE8F"],
  ["unstable", "#D55E00", "#F07A22"],
  ["second", "#BF6699", "#DE97C0"],
  ["sheet", "#56B4E9", "#B3DFFF"],
  ["forbidden", "#ECECEC", "#2B2B2B"],
  ["locked", "#B9A7D6", "#6F6190"],
  ["muted", "#808080", "#949494"],
  ["ink", "#101010", "#F2F2F2"],
  ["paper", "#FFFFFF", "#121212"],
]
const NAMED = new Map(SHADES.map(([name, light]) => [name, light]))
const ON_DARK = new Map(SHADES.map(([, light, dark]) => [light, dark]))

let dark = null

// Whether a page is dark whose text has this colour, in CSS.
export function isDark(text) {
  const [red, green, blue] = text.match(/[\d.]+/g).map(Number)
  return red + green + blue > 382
}

// The page has become dark or light: what asks for colours from now on, and legends, get those for it.
export function setDark(value) {
  if (value === dark) return
  dark = value
  for (const [name, shade] of shadesOf(dark)) document.documentElement.style.setProperty(`--${name}`, shade)
}

// [name, colour] of all, on a dark page or a light one.
export const shadesOf = (isDarkPage) => SHADES.map(([name, ...shades]) => [name, shades[isDarkPage ? 1 : 0]])

// "#rrggbb" or "#rrggbbaa" of "theme.py" → as it is on this page.
export function shade(colour) {
  if (!dark) return colour
  return (ON_DARK.get(colour.slice(0, 7).toUpperCase()) ?? colour.slice(0, 7)) + colour.slice(7)
}

export const onDark = () => dark === true

const look = (name, dash, weight) => ({ get colour() { return shade(NAMED.get(name)) }, dash, weight })

export const LOOKS = {
  orbit: look("orbit", [], 2.2),
  second: look("second", [], 2.2),
  stable: look("stable", [], 3),
  unstable: look("unstable", [7, 5], 3),
  limit: { colour: null, dash: [2, 3], weight: 1 },
  muted: look("muted", [], 1),
  axis: { colour: null, dash: [], weight: 2.5 },
  mass: { colour: "#F0E442", dash: [], weight: 3 },
}
export const POINT = "#F0E442"

const bytes = (colour) => [1, 3, 5].map((at) => Number.parseInt(colour.slice(at, at + 2), 16))
export const CLOUDS = {
  get 0() { return bytes(LOOKS.orbit.colour) },
  get 1() { return bytes(LOOKS.second.colour) },
}
