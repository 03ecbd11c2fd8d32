// Tells when the pictures of the current state are painted, and keeps the URL.
// <html data-ready> is "false" from a change by the user until the answer to it is on the screen;
// data-state counts the painted states.  The server sends the next state only when the last one
// is painted, so nothing queues however fast a slider is dragged.

const USER_CHANGES = new Set(["value", "clicks"])
const URL_PAUSE = 400

export function render({ model, view }) {
  const root = document.documentElement
  const own = model.client
  let state = null
  let requested = 0
  let asking = false
  let held = false
  let spherePending = false
  root.dataset.ready = "false"
  root.dataset.state = "0"

  const bokeh = () => view.model.document
  const request = () => {
    root.dataset.ready = "false"
    requested += 1
    // Behind the change itself on its way to the server.
    if (asking) return
    asking = true
    queueMicrotask(() => { asking = false; model.send_msg({ requested, held }) })
  }
  const onChange = (event) => {
    if (event.sync && USER_CHANGES.has(event.attr)) request()
  }
  // While a pointer holds a slider the axes hold still; letting go is a request of its own.
  document.addEventListener("pointerdown", (event) => {
    held = event.composedPath().some((item) => item.classList?.contains("MuiSlider-root"))
  }, true)
  for (const name of ["pointerup", "pointercancel"]) {
    document.addEventListener(name, () => {
      if (!held) return
      held = false
      request()
    }, true)
  }
  document.addEventListener("hess:pick", (event) => {
    if (!event.detail.slice(1).every(Number.isFinite)) return
    model.send_msg({ picked: event.detail })
    request()
  })

  let plots = []
  const findPlots = () => {
    const found = []
    const visit = (item) => {
      if (item.request_paint !== undefined && item.repainted !== undefined) found.push(item)
      for (const child of item.children_views?.() ?? []) visit(child)
    }
    for (const top of Object.values(window.Bokeh.index)) visit(top)
    return found
  }

  // A plot has something to paint while it holds invalidated parts.
  const busy = () => spherePending || plots.some((plot) => plot._invalidate_all || plot._invalidated_painters.size > 0)

  // One tree and one block of single-precision numbers → the columns of the sources.
  function unpack(tree, block) {
    const place = (item) => {
      if (Array.isArray(item)) return item.map(place)
      if (typeof item === "object" && item !== null) return new Float32Array(block, 4 * item.at, item.n)
      return item
    }
    for (const [name, columns] of Object.entries(tree.sources)) {
      const data = Object.fromEntries(Object.entries(columns).map(([key, column]) => [key, place(column)]))
      bokeh().get_model_by_name(name).setv({ data }, { sync: false })
    }
    document.dispatchEvent(new CustomEvent("hess:text", { detail: tree.texts }))
  }

  let waiting = false
  let giveUp = null

  const settle = () => {
    const { number, answers } = state
    waiting = false
    clearTimeout(giveUp)
    root.dataset.state = String(number)
    if (answers >= requested && !busy()) root.dataset.ready = "true"
    model.send_msg({ painted: number })
  }
  // Called whenever one of the pictures has been painted.
  const onPainted = () => { if (waiting && !busy()) settle() }

  const onState = () => {
    state = JSON.parse(model.state)
    unpack(state.tree, model.block)
    writeUrl()
    if (waiting) return
    waiting = true
    // A hidden tab paints nothing, and a broken picture must not hold up the server for ever.
    giveUp = setTimeout(settle, document.hidden ? 0 : 2000)
    // Paint now rather than in the next frame: when that comes, all is ready for it.
    document.dispatchEvent(new CustomEvent("hess:paint"))
    for (const plot of plots) if (plot._invalidated_painters.size > 0) plot.paint()
    onPainted()
  }

  let timer = null
  const writeUrl = () => {
    if (timer !== null) return
    timer = setTimeout(() => {
      timer = null
      const extra = Object.entries(own).map(([key, value]) => `&${key}=${encodeURIComponent(value)}`).join("")
      const query = `?${state.query}${extra}`
      if (query !== window.location.search) window.history.replaceState(null, "", query)
    }, URL_PAUSE)
  }
  const onUrl = (event) => {
    Object.assign(own, event.detail)
    writeUrl()
  }
  document.addEventListener("hess:url", onUrl)
  document.addEventListener("hess:sphere-invalid", () => { spherePending = true })
  document.addEventListener("hess:sphere-painted", () => { spherePending = false; onPainted() })

  model.on("state", onState)
  const prepare = () => {
    plots = findPlots()
    for (const plot of plots) {
      plot.repainted.connect(onPainted)
      // Bokeh does not cut what is on the overlay canvas to the frame; all our moving elements are there.
      for (const part of plot.computed_renderer_views) {
        if (part.model.level === "overlay") Object.defineProperty(part, "needs_clip", { value: true, configurable: true })
      }
      plot.request_paint()
    }
  }

  const start = () => {
    // The first paint is over when Bokeh says so; after that our own marks hold.
    if (bokeh() == null || !bokeh().is_idle) return void requestAnimationFrame(start)
    bokeh().on_change(onChange)
    prepare()
    onState()
  }
  start()
  return () => document.removeEventListener("hess:url", onUrl)
}
