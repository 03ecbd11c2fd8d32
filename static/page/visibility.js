// Which pictures are out of sight or folded: those are not computed, and what comes into sight is asked for.

// appeared() is called when a picture comes into sight.
export function createVisibility(appeared) {
  const hidden = new Set()
  const observer = new IntersectionObserver((entries) => {
    let found = false
    for (const { target, isIntersecting } of entries) {
      const { name } = target.dataset
      if (isIntersecting) found = hidden.delete(name) || found
      else hidden.add(name)
    }
    if (found) appeared()
  })
  return {
    hidden: () => [...hidden],
    // The pictures of another scene, of which the server has drawn those that are not folded at first.
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
