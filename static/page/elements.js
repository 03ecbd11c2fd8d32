// The elements that the page is made of.

/**
 * Return an element, for instance element("p.why", { role: "status" }, "Not yet.").
 * @param {string} name the tag, and classes after points
 * @param {...(object | Node | string | number)} parts properties, if they come first, and children
 */
export function element(name, ...parts) {
  const [tag, ...classes] = name.split(".")
  const item = document.createElement(tag)
  item.classList.add(...classes)
  if (parts[0]?.constructor === Object) {
    const { dataset, ...properties } = parts.shift()
    Object.assign(item, properties)
    Object.assign(item.dataset, dataset)
  }
  item.append(...parts)
  return item
}

/**
 * Return a button.
 * @param {string} name classes with points between them; tests find it by `param-…`, which says what it is for
 * @param {((event: MouseEvent) => void) | null} onclick
 * @param {...(object | Node | string | number)} parts see `element`
 */
export function button(name, onclick, ...parts) {
  return Object.assign(element(`button.${name}`, ...parts), { type: "button", onclick })
}

/** Return the HTML of an icon; its path is drawn on 24 × 24 units. */
export function icon(path = "", size = "1.4em") {
  return `<svg viewBox="0 0 24 24" width="${size}" height="${size}" aria-hidden="true"><path fill="currentColor" d="${path}"/></svg>`
}

/** Give a button another icon, tooltip and accessible name. */
export function relabel(item, path, title, ariaLabel = title) {
  item.querySelector("path").setAttribute("d", path)
  Object.assign(item, { title, ariaLabel })
}
