// A piece of text that changes often: set as text, never as HTML.

export function render({ model, view, el }) {
  // Listeners go with the view: when it is removed, or rendered once more.
  view.living?.abort()
  view.living = new AbortController()
  model.on("remove", () => view.living.abort())
  const { signal } = view.living
  const item = document.createElement(model.tag)
  item.className = `text ${model.look}`
  if (model.live) item.setAttribute("role", "status")
  const show = (text) => {
    item.textContent = text
    item.hidden = text === ""
  }
  const onText = (event) => { if (model.key in event.detail) show(event.detail[model.key]) }
  document.addEventListener("hess:texts", onText, { signal })
  show("")
  document.dispatchEvent(new CustomEvent("hess:mounted", { detail: { kind: "texts", key: model.key, show } }))
  el.append(item)
}
