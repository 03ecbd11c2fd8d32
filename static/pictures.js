// The pictures of a scene: built once, then kept, and only filled with new data ("ready.js" does it).
// Gives `window.hess`: source(name), plots, build(description), enter(name).

// Data that no Bokeh glyph draws, in the form of Bokeh's.
class Plain {
  data = {}
  watchers = new Set()
  put(data) {
    this.data = data
    for (const watcher of this.watchers) watcher()
  }
  watch(watcher, signal) {
    this.watchers.add(watcher)
    signal?.addEventListener("abort", () => this.watchers.delete(watcher))
  }
}

class OfBokeh {
  constructor(model) { this.model = model }
  get data() { return this.model.data }
  put(data) { this.model.setv({ data }, { sync: false }) }
  watch(watcher, signal) {
    this.model.change.connect(watcher)
    signal?.addEventListener("abort", () => this.model.change.disconnect(watcher))
  }
}

const KINDS = { sphere, cloud: cloudPlane }

// A button that shows a picture which is not seen at first, or folds it again.
function unfolding(cell, label) {
  const button = document.createElement("button")
  button.type = "button"
  button.className = "button unfold"
  const show = () => {
    const folded = cell.classList.contains("folded")
    button.textContent = folded ? label : "Hide"
    button.setAttribute("aria-expanded", String(!folded))
  }
  button.addEventListener("click", () => {
    const folded = cell.classList.toggle("folded")
    show()
    document.dispatchEvent(new CustomEvent("hess:folded", { detail: { name: cell.dataset.name, folded } }))
  })
  show()
  return button
}

export function render({ model, view, el }) {
  // Rendered once more: the same pictures in the new place.
  if (view.shelf !== undefined) return void el.append(view.shelf)
  const shelf = document.createElement("div")
  view.shelf = shelf
  shelf.className = "shelf"
  el.append(shelf)
  const living = new AbortController()
  model.on("remove", () => living.abort())
  const { signal } = living
  const built = new Map()
  let shown = null

  // Colours of the page's theme, on whatever Bokeh draws itself.
  const paint = (scene) => {
    const style = getComputedStyle(shelf)
    const text = style.color
    const muted = style.getPropertyValue("--mui-palette-text-secondary") || text
    for (const plot of scene.plots) {
      for (const part of plot.model.references()) {
        if (part.axis_label_text_color !== undefined) {
          part.setv({
            axis_label_text_color: text, axis_label_text_font_style: "normal", axis_label_text_font: "system-ui, sans-serif",
            major_label_text_color: muted, major_label_text_font: "system-ui, sans-serif",
            axis_line_color: muted, axis_line_alpha: 0.4, major_tick_line_color: muted, major_tick_line_alpha: 0.4,
            minor_tick_line_alpha: 0,
          })
        } else if (part.text_color !== undefined && part.text_baseline !== undefined) {
          part.setv({ text_color: text })
        }
      }
      plot.model.setv({ outline_line_color: muted, outline_line_alpha: 0.4 })
    }
  }

  async function build(description) {
    const grid = document.createElement("div")
    grid.className = "gallery"
    const scene = { name: description.name, grid, sources: new Map(), cells: [], plots: [], canvases: [] }
    const hosts = []
    for (const picture of description.pictures) {
      const cell = document.createElement("section")
      cell.className = `picture picture-${picture.name}`
      cell.dataset.name = picture.name
      cell.classList.toggle("folded", picture.folded !== null)
      const caption = document.createElement("h2")
      caption.className = "text caption"
      const host = document.createElement("div")
      const under = document.createElement("output")
      under.className = "text hover"
      under.hidden = true
      host.className = "host"
      cell.append(caption, host, under)
      if (picture.folded !== null) cell.append(unfolding(cell, picture.folded))
      cell.addEventListener("mouseleave", () => { under.hidden = true })
      grid.append(cell)
      scene.cells.push(cell)
      if (picture.kind === "plot") hosts.push(host)
      else {
        scene.sources.set(picture.name, new Plain())
        scene.canvases.push([host, picture])
      }
    }
    // In place, for its size, but not to be seen before it is filled.
    grid.classList.add("away")
    shelf.append(grid)
    // A track that no plot draws has a source all the same: the player and the spheres read it.
    for (const track of description.tracks) scene.sources.set(track, new Plain())
    const plots = Bokeh.require("document").Document.from_json(JSON.parse(description.document))
    const views = await Bokeh.embed.add_document_standalone(plots, grid, hosts)
    for (const item of plots.all_models) {
      if (item.data !== undefined && item.name != null) scene.sources.set(item.name, new OfBokeh(item))
    }
    scene.plots = plots.roots().map((root) => views.get(root))
    for (const [host, picture] of scene.canvases) {
      KINDS[picture.kind](host, picture, (name) => scene.sources.get(name), signal, () => shown === scene)
    }
    paint(scene)
    while (!scene.plots.every((plot) => plot.has_finished())) await new Promise(requestAnimationFrame)
    built.set(scene.name, scene)
    return scene
  }

  function enter(name) {
    const scene = built.get(name)
    if (shown !== null) shown.grid.classList.add("away")
    scene.grid.classList.remove("away")
    shown = scene
    window.hess.plots = scene.plots
    return scene
  }

  const onTexts = (event) => {
    for (const cell of shown?.cells ?? []) {
      const text = event.detail[cell.dataset.name]
      if (text !== undefined) cell.querySelector(".caption").textContent = text
      const hover = event.detail[`hover-${cell.dataset.name}`]
      if (hover !== undefined) {
        const under = cell.querySelector(".hover")
        under.textContent = hover
        under.hidden = hover === "" || !cell.matches(":hover")
      }
    }
  }
  document.addEventListener("hess:texts", onTexts, { signal })
  const scheme = new MutationObserver(() => { for (const scene of built.values()) paint(scene) })
  for (const item of [document.documentElement, document.body]) {
    scheme.observe(item, { attributes: true, attributeFilter: ["data-theme", "class"] })
  }
  signal.addEventListener("abort", () => scheme.disconnect())

  window.hess = {
    plots: [],
    source: (name) => shown?.sources.get(name),
    has: (name) => built.has(name),
    build, enter,
  }
}
