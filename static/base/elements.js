// @ts-check
// Functions that create HTML elements.

/**
 * Return a new element, for instance element("p.why", { role: "status" }, "Not yet.").
 * @template {string} Name
 * @param {Name} name the tag, followed by classes
 * @param {...(object | Node | string | number)} parts properties (if they come first) and children
 * @returns {ElementOf<Name>}
 */
export function element(name, ...parts) {
  const [tag, ...classes] = name.split(".")
  const item = document.createElement(tag)
  item.classList.add(...classes)
  if (parts[0]?.constructor === Object) {
    const { dataset, ...properties } = /** @type {{dataset?: object}} */ (parts.shift())
    Object.assign(item, properties)
    Object.assign(item.dataset, dataset)
  }
  item.append(.../** @type {(Node | string)[]} */ (parts))
  return /** @type {ElementOf<Name>} */ (item)
}

/**
 * Return a new button.
 * @param {string} name classes; tests find the button by its class `param-…`
 * @param {((event: MouseEvent) => void) | null} onclick
 * @param {...(object | Node | string | number)} parts see `element`
 * @returns {HTMLButtonElement}
 */
export function button(name, onclick, ...parts) {
  return Object.assign(element(`button.${name}`, ...parts), { type: "button", onclick })
}

/**
 * Set the properties of an element that have changed; setting the same value again could force a style or layout update.
 * @template {object} Item
 * @param {Item} item
 * @param {Partial<Item>} properties
 */
export function update(item, properties) {
  for (const [name, value] of Object.entries(properties)) {
    if (item[/** @type {keyof Item} */ (name)] !== value) Object.assign(item, { [name]: value })
  }
}

/** Show a text in an element, which is hidden without one. @param {HTMLElement} item @param {string} text */
export const say = (item, text) => update(item, { textContent: text, hidden: text === "" })

/** Return the HTML of an icon; the lines of the path are drawn in a box of 24 × 24 units. @param {string} path */
export function icon(path, size = "1.4em") {
  return `<svg class="icon" viewBox="0 0 24 24" width="${size}" height="${size}" aria-hidden="true"><path d="${path}"/></svg>`
}

/**
 * Change the icon, tooltip and accessible name of a button.
 * @param {HTMLElement} item
 * @param {string} path
 * @param {string} title
 */
export function relabel(item, path, title, ariaLabel = title) {
  item.querySelector("path").setAttribute("d", path)
  Object.assign(item, { title, ariaLabel })
}
