// A piece of text that changes often: set as text, never as HTML.

export function render({ model, el }) {
  const item = document.createElement(model.tag)
  item.className = `text ${model.look}`
  if (model.live) item.setAttribute("role", "status")
  const show = (text) => {
    item.textContent = text
    item.hidden = text === ""
  }
  const onText = (event) => { if (model.key in event.detail) show(event.detail[model.key]) }
  document.addEventListener("hess:text", onText)
  show(model.text)
  el.append(item)
  return () => document.removeEventListener("hess:text", onText)
}
