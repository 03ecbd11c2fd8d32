// HTML of the scene on show, from the project's own files: its legend or its words.

export function render({ model, view, el }) {
  view.living?.abort()
  view.living = new AbortController()
  model.on("remove", () => view.living.abort())
  const { signal } = view.living
  const item = document.createElement("div")
  item.className = model.part
  const show = (scene) => { item.innerHTML = scene[model.part] }
  document.addEventListener("hess:enter", (event) => show(event.detail), { signal })
  document.dispatchEvent(new CustomEvent("hess:mounted", { detail: { kind: "scene", show } }))
  el.append(item)
}
