// Data sources of pictures: columns by name, shared by all plots and canvases that draw them.

/** `data` holds the columns; `put` replaces them; `watch` calls a function when that happens. */
export class Source {
  data = {}
  // The plots of Bokeh that draw these data.
  plots = new Set()
  #models = []
  #watchers = new Set()

  // Feed a data source of Bokeh's too: one for each plot that draws the data.
  add(model, plot) {
    this.#models.push(model)
    this.plots.add(plot)
    this.data = model.data instanceof Map ? Object.fromEntries(model.data) : model.data
  }

  put(data) {
    this.data = data
    for (const model of this.#models) model.setv({ data }, { sync: false })
    for (const watcher of this.#watchers) watcher()
  }

  watch(watcher) { this.#watchers.add(watcher) }
}
