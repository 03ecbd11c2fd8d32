// What every component of Panel on this page begins with.

// The signal that aborts when the component is removed, or rendered once more: its listeners go with it.
const controllers = new WeakMap()

export function lifetime({ model, view }) {
  controllers.get(view)?.abort()
  const controller = new AbortController()
  controllers.set(view, controller)
  model.on("remove", () => controller.abort())
  return controller.signal
}

// An element with these properties, attributes ("aria-…", "role") among them, and children.
export function element(tag, properties = {}, ...children) {
  const item = document.createElement(tag)
  for (const [name, value] of Object.entries(properties)) {
    if (name.includes("-") || name === "role") item.setAttribute(name, value)
    else item[name] = value
  }
  item.append(...children)
  return item
}
