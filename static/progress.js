// How much of the state on show is computed, while the rest is on its way; Stop (or Escape) leaves it at that.

const SHOWN_AFTER = 300

export function render({ model, view, el }) {
  // Listeners go with the view: when it is removed, or rendered once more.
  view.living?.abort()
  view.living = new AbortController()
  model.on("remove", () => view.living.abort())
  const { signal } = view.living
  const box = document.createElement("div")
  box.className = "computing"
  box.setAttribute("role", "status")
  const bar = document.createElement("progress")
  bar.setAttribute("aria-label", "Computed")
  const stop = document.createElement("button")
  stop.type = "button"
  stop.className = "button param-stop"
  stop.textContent = "Stop"
  stop.title = "Leave it at what is drawn (Escape)"
  box.append(bar, stop)
  box.hidden = true
  el.append(box)
  let since = null
  const end = () => { if (since !== null) document.dispatchEvent(new CustomEvent("hess:stop")) }
  stop.addEventListener("click", end)
  document.addEventListener("keydown", (event) => { if (event.key === "Escape") end() }, { signal })
  document.addEventListener("hess:progress", (event) => {
    if (event.detail === null) {
      since = null
      box.hidden = true
      return
    }
    since ??= performance.now()
    const [done, of] = event.detail
    bar.max = of
    bar.value = done
    box.hidden = performance.now() - since < SHOWN_AFTER
  }, { signal })
}
