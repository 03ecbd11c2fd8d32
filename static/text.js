// A piece of text that changes often: set as text, never as HTML.

export function render({ model, el }) {
  const item = document.createElement(model.tag)
  item.className = `text ${model.look}`
  if (model.live) item.setAttribute("role", "status")
  const show = () => {
    item.textContent = model.text
    item.hidden = model.text === ""
  }
  model.on("text", show)
  show()
  el.append(item)
}
