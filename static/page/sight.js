// Which pictures are out of sight or folded: those are not computed, and what comes into sight is asked for.

import { listen } from "./bus.js"

const MARGIN = "100px"

// appeared() is called when a picture comes into sight.
export function createSight(appeared, signal) {
  const hidden = new Set()
  const observer = new IntersectionObserver((entries) => {
    let found = false
    for (const { target, isIntersecting } of entries) {
      const { name } = target.dataset
      if (isIntersecting && !target.classList.contains("folded")) found = hidden.delete(name) || found
      else hidden.add(name)
    }
    if (found) appeared()
  }, { rootMargin: MARGIN, scrollMargin: MARGIN })
  listen("folded", ({ name, folded }) => {
    if (folded) hidden.add(name)
    else if (hidden.delete(name)) appeared()
  }, signal)
  signal.addEventListener("abort", () => observer.disconnect())
  return {
    hidden: () => [...hidden],
    // The pictures of another scene.
    watch(cells) {
      hidden.clear()
      observer.disconnect()
      for (const cell of cells) observer.observe(cell)
    },
  }
}
