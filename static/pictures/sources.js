// @ts-check
// Data sources: columns by name, shared by all plots and canvases that draw them.

/** A data source: `data` holds the columns, `put` replaces them, `watch` calls a function whenever they are replaced. */
export class Source {
  /** @type {Data} */
  data = {}
  /** The Bokeh plots that draw these data. @type {Set<PlotView>} */
  plots = new Set()
  /** @type {BokehModel[]} */
  #models = []
  /** @type {Set<() => void>} */
  #watchers = new Set()

  /** Feed a Bokeh data source too; each plot has its own. @param {BokehModel} model @param {PlotView} plot */
  add(model, plot) {
    this.#models.push(model)
    this.plots.add(plot)
    // Keep data that arrive before the plot.
    if (Object.keys(this.data).length === 0) this.data = model.data instanceof Map ? Object.fromEntries(model.data) : model.data
  }

  /** Give the data to the plots, which were built after it came. */
  feed() {
    for (const model of this.#models) model.setv({ data: this.data }, { sync: false })
  }

  /** @param {Data} data */
  put(data) {
    this.data = data
    this.feed()
    for (const watcher of this.#watchers) watcher()
  }

  /** @param {() => void} watcher */
  watch(watcher) { this.#watchers.add(watcher) }
}

/**
 * Return a function that remembers what `read` returned for an object the first time.
 * @template {object} Key
 * @template Result
 * @param {(key: Key) => Result} read
 */
export function atFirst(read) {
  /** @type {WeakMap<Key, Result>} */
  const found = new WeakMap()
  /** @param {Key} key */
  return (key) => {
    if (!found.has(key)) found.set(key, read(key))
    return found.get(key)
  }
}

/**
 * Return [look, columns, times] of the curves that have points.
 * @param {Record<string, string>} looks name of a source → look
 * @param {FindSource} source
 * @param {string[]} names of the three columns
 * @returns {[string, Columns, ArrayLike<number> | undefined][]}
 */
export const curvesOf = (looks, source, names) => Object.entries(looks).map(([name, look]) => {
  const { data } = source(name)
  return /** @type {[string, Columns, ArrayLike<number>]} */ ([look, names.map((column) => data[column]), data.t])
}).filter(([, [x]]) => x?.length > 1)
