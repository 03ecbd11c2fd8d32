// Tells when the pictures of the current state are painted, and keeps the URL.
// <html data-ready> is "false" from a change by the user until the answer to it is on the screen;
// data-state counts the painted states.  The server sends the next state only when the last one
// is painted ("painted"), so nothing queues however fast a slider is dragged.

const USER_CHANGES = new Set(["value", "value_throttled", "clicks", "picked"])
const URL_PAUSE = 400

export function render({ model, view }) {
  const root = document.documentElement
  const own = model.client
  let requested = 0
  let spherePending = false
  root.dataset.ready = "false"
  root.dataset.state = "0"

  const bokeh = () => view.model.document
  const onChange = (event) => {
    if (!event.sync || !USER_CHANGES.has(event.attr)) return
    root.dataset.ready = "false"
    requested += 1
    model.requested = requested
  }

  const plots = () => {
    const found = []
    const visit = (item) => {
      if (item.request_paint !== undefined && item.repainted !== undefined) found.push(item)
      for (const child of item.children_views?.() ?? []) visit(child)
    }
    for (const top of Object.values(window.Bokeh.index)) visit(top)
    return found
  }

  // A plot has something to paint while it holds invalidated parts.
  const busy = () => spherePending || plots().some((plot) => plot._invalidate_all || plot._invalidated_painters.size > 0)

  // One tree and one block of single-precision numbers → the columns of the sources.
  function unpack(tree, block) {
    const place = (item) => {
      if (Array.isArray(item)) return item.map(place)
      if (typeof item === "object" && item !== null) return new Float32Array(block, 4 * item.at, item.n)
      return item
    }
    for (const [name, columns] of Object.entries(tree)) {
      const data = Object.fromEntries(Object.entries(columns).map(([key, column]) => [key, place(column)]))
      bokeh().get_model_by_name(name).setv({ data }, { sync: false })
    }
  }

  let waiting = false
  let deadline = 0

  const settle = () => {
    const { number, answers } = model.sequence
    // A hidden tab paints nothing, and a broken picture must not hold up the server for ever.
    if (busy() && !document.hidden && performance.now() < deadline) return void requestAnimationFrame(settle)
    waiting = false
    root.dataset.state = String(number)
    if (answers >= requested && !busy()) root.dataset.ready = "true"
    model.painted = number
  }

  const onSequence = () => {
    const { number, tree } = model.sequence
    if (number === 0) return
    unpack(tree, model.block)
    writeUrl()
    deadline = performance.now() + 2000
    if (waiting) return
    waiting = true
    if (document.hidden) setTimeout(settle, 0)
    else requestAnimationFrame(settle)
  }

  let timer = null
  const writeUrl = () => {
    if (timer !== null) return
    timer = setTimeout(() => {
      timer = null
      const extra = Object.entries(own).map(([key, value]) => `&${key}=${encodeURIComponent(value)}`).join("")
      const query = `?${model.query}${extra}`
      if (query !== window.location.search) window.history.replaceState(null, "", query)
    }, URL_PAUSE)
  }
  const onUrl = (event) => {
    Object.assign(own, event.detail)
    writeUrl()
  }
  document.addEventListener("hess:url", onUrl)
  let picks = 0
  document.addEventListener("hess:pick", (event) => {
    if (event.detail.slice(1).every(Number.isFinite)) model.picked = [...event.detail, (picks += 1)]
  })
  document.addEventListener("hess:sphere-invalid", () => { spherePending = true })
  document.addEventListener("hess:sphere-painted", () => { spherePending = false })

  model.on("sequence", onSequence)
  const start = () => {
    // The first paint is over when Bokeh says so; after that our own marks hold.
    if (bokeh() == null || !bokeh().is_idle) return void requestAnimationFrame(start)
    bokeh().on_change(onChange)
    onSequence()
  }
  start()
  return () => document.removeEventListener("hess:url", onUrl)
}
