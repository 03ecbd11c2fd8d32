// @ts-check
// The page embedded in another one (embed=1): some pictures, some controls, the player, and a link to the whole page.

const KEYS = ["embed", "pictures", "controls"]

/**
 * Return the address of the whole page in its state, or of an embedded page with some of its parts.
 * @param {Record<string, string[]> | null} parts key of the address → names
 */
export function linkTo(parts = null) {
  // A file links to its explorer.
  const { home } = document.documentElement.dataset
  const url = home === undefined ? new URL(location.href) : new URL(`?${location.hash.slice(1)}`, home)
  for (const key of [...KEYS, ...(parts === null ? [] : ["large", "present"])]) url.searchParams.delete(key)
  if (parts === null) return url.href
  url.searchParams.set("embed", "1")
  for (const [key, names] of Object.entries(parts)) url.searchParams.set(key, names.join(",") || "none")
  return url.href.replaceAll("%2C", ",")
}

/**
 * Return the description of an embedded scene: its pictures open, its controls essential, the other pictures `absent`.  In an
 * embedded lesson the steps choose among all of them.
 * @param {SceneDescription} description
 * @param {ClientKeys} keys names of the pictures and controls that are kept
 * @returns {SceneDescription}
 */
export function embedded(description, { pictures, controls, lesson }) {
  if (lesson !== "") return description
  /** @type {(names: string) => (part: {name: string}) => boolean} */
  const isIn = (names) => ({ name }) => names.split(",").includes(name)
  const kept = description.controls.filter(isIn(controls))
  const [there, absent] = [true, false].map((is) => description.pictures.filter((one) => isIn(pictures)(one) === is))
  return {
    ...description, pictures: there.map((picture) => ({ ...picture, folded: /** @type {null} */ (null) })),
    lead: there.map(({ name }) => name), absent: absent.map(({ name }) => name), controls: kept, essential: kept.map(({ name }) => name), presets: [],
  }
}
