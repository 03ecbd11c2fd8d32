// Where the data of pictures are: `data` by column, `put` for new ones, `watch` to be told of them.

export class Source {
  data = {}
  // The plots of Bokeh that draw these data.
  plots = new Set()
  #models = []
  #watchers = new Set()

  // A source of Bokeh's that gets the same data: one for each plot that draws them.
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

  watch(watcher, signal) {
    this.#watchers.add(watcher)
    signal?.addEventListener("abort", () => this.#watchers.delete(watcher))
  }
}
