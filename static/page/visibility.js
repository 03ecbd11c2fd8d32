// @ts-check
// Tracks the pictures that are out of sight or folded: the server does not compute them until they appear.

/**
 * Return the tracker.
 * @param {() => void} appeared is called when a picture comes into sight
 */
export function createVisibility(appeared) {
  /** @type {Set<string>} */
  const hidden = new Set()
  const observer = new IntersectionObserver((entries) => {
    let found = false
    for (const entry of entries) {
      const { name } = /** @type {HTMLElement} */ (entry.target).dataset
      if (entry.isIntersecting) found = hidden.delete(name) || found
      else hidden.add(name)
    }
    if (found) appeared()
  })
  return {
    hidden: () => [...hidden],
    /**
     * Watch the pictures of a scene; the server has drawn those that are not folded.
     * @param {HTMLElement[]} cells
     */
    watch(cells) {
      hidden.clear()
      observer.disconnect()
      for (const cell of cells) {
        if ("late" in cell.dataset || !cell.checkVisibility()) hidden.add(cell.dataset.name)
        observer.observe(cell)
      }
    },
  }
}
