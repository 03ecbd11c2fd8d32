// The page inside another one (embed=1): some pictures, some controls, the player, and a link to all of it.

import { tell } from "./bus.js"

const KEYS = ["embed", "pictures", "controls"]
const root = document.documentElement

export const isEmbedded = () => root.hasAttribute("data-embed")

export function embed() {
  root.toggleAttribute("data-embed", true)
  tell("embedding")
}

// The address of the whole page in the state of this one, or of these parts of it.
export function linkTo(parts = null) {
  const url = new URL(location.href)
  for (const key of [...KEYS, ...(parts === null ? [] : ["large", "present"])]) url.searchParams.delete(key)
  if (parts === null) return url.href
  url.searchParams.set("embed", "1")
  for (const [key, names] of Object.entries(parts)) url.searchParams.set(key, names.join(",") || "none")
  return url.href.replaceAll("%2C", ",")
}

// Of the description of a scene what these keys of the address name: pictures are open, controls essential; the names of
// the other pictures are `absent`.
export function embedded(description, { pictures, controls }) {
  const isIn = (names) => ({ name }) => names.split(",").includes(name)
  const kept = description.controls.filter(isIn(controls))
  const [there, absent] = [true, false].map((is) => description.pictures.filter((one) => isIn(pictures)(one) === is))
  return {
    ...description, pictures: there.map((picture) => ({ ...picture, folded: null })), absent: absent.map(({ name }) => name),
    controls: kept, essential: kept.map(({ name }) => name), presets: [],
  }
}
