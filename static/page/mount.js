// How the parts of the page are mounted, and the elements that they are made of.

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

// Which style sheets each part has besides "page/base.css".
const SHEETS = {
  bar: ["controls/dialog.css", "controls/bar.css"],
  controls: ["controls/dialog.css", "controls/controls.css"],
  pictures: ["pictures/pictures.css"],
  player: ["controls/controls.css", "controls/player.css"],
  lessons: ["page/page.css", "page/lessons.css"],
}

/**
 * Mounts parts of the page, each in a shadow of its own, where its styles are its alone.
 *
 * @param {Record<string, string>} sheets - path → style sheet
 * @param {AbortSignal} [signal] - aborts when they are removed: their listeners go with them
 */
export function createMount(sheets, signal = new AbortController().signal) {
  return (name, render, properties = {}, host = element("div")) => {
    const el = element("div", { className: name })
    host.attachShadow({ mode: "open" }).append(
      ...["page/base.css", ...(SHEETS[name] ?? ["page/page.css"])].map((path) => element("style", { textContent: sheets[path] })), el)
    render({ ...properties, el, signal })
    return host
  }
}
