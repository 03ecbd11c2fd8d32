// Tells when the pictures of the current state are painted, and keeps the URL.
// <html data-ready> is "false" from a change by the user until the answer to it is on the screen;
// data-state counts the painted states.  The next state is asked for only when the last one is
// painted, so nothing queues however fast a slider is dragged.

const URL_PAUSE = 400

export function render({ model, view }) {
  const root = document.documentElement
  const own = model.client
  let state = null
  let requested = 0
  let asking = false
  let asked = null
  let held = false
  let touched = false
  let values = {}
  let picked = null
  let reset = false
  let chosen = null
  let scene = null
  let entered = null
  let spherePending = false
  root.dataset.ready = "false"
  root.dataset.state = "0"

  const bokeh = () => view.model.document
  const page = () => bokeh().roots().find((top) => top.data?.attributes.dark_theme !== undefined).data
  // One request at a time: the next one goes when the answer to the last is painted.
  const ask = () => {
    if (scene === null || asked !== null || asking) return
    asking = true
    // Behind the change itself on its way to the server.
    queueMicrotask(() => {
      asking = false
      asked = requested
      if (chosen === entered) chosen = null
      if (chosen !== null) leave()
      model.send_msg({ requested, held, values, picked, reset, scene: chosen, hidden: [...hidden] })
      values = {}
      picked = null
      reset = false
      chosen = null
    })
  }
  const request = () => {
    root.dataset.ready = "false"
    requested += 1
    ask()
  }
  const onChange = (event) => {
    // A menu.  Numbers, picks and buttons come as events of the page.
    if (event.sync && event.attr === "value") request()
    if (event.attr === "dark_theme") writeUrl()
  }
  // While a pointer holds a slider the axes hold still; letting go is a request of its own.
  document.addEventListener("pointerdown", (event) => {
    touched = event.pointerType === "touch"
    held = event.composedPath().some((item) => item.classList?.contains("hand"))
  }, true)
  for (const name of ["pointerup", "pointercancel"]) {
    document.addEventListener(name, () => {
      if (!held) return
      held = false
      request()
    }, true)
  }
  document.addEventListener("hess:change", (event) => {
    Object.assign(values, event.detail)
    request()
  })
  document.addEventListener("hess:pick", (event) => {
    const { pick, drag } = event.detail
    // A finger that moves scrolls the page.
    if ((drag && touched) || !Array.isArray(pick) || !pick.slice(1).every(Number.isFinite)) return
    picked = pick
    request()
  })

  document.addEventListener("hess:scene", (event) => {
    if (event.detail === (chosen ?? entered)) return
    chosen = event.detail
    request()
  })
  const leave = () => {
    entered = chosen
    latest = { texts: {}, numbers: {} }
    // The old pictures stay in the document for a while: their names are for the new ones.
    for (const plot of plots) {
      plot.model.setv({ name: null }, { sync: false })
      for (const { data_source } of plot.model.renderers) data_source?.setv({ name: null }, { sync: false })
    }
  }

  // What is built later than a state (controls in a drawer that opens, a player of another scene) learns here what it
  // has missed.
  let latest = { texts: {}, numbers: {} }
  document.addEventListener("hess:mounted", (event) => {
    const { kind, key, show } = event.detail
    const known = kind === "client" ? own : latest[kind][key]
    if (known !== undefined) show(known)
  })

  // Pictures out of sight are not computed; what comes into sight is asked for.
  const hidden = new Set()
  const sight = new IntersectionObserver((entries) => {
    let appeared = false
    for (const { target, isIntersecting } of entries) {
      const name = pictureOf(target)
      if (isIntersecting) appeared = hidden.delete(name) || appeared
      else hidden.add(name)
    }
    if (appeared) request()
  }, { rootMargin: "100px", scrollMargin: "100px" })
  const pictureOf = (cell) => [...cell.classList].find((name) => name.startsWith("picture-")).slice("picture-".length)

  document.addEventListener("click", (event) => {
    const on = (name) => event.composedPath().some((item) => item.classList?.contains(name))
    if (on("param-reset")) {
      values = {}
      reset = true
      request()
    } else if (on("param-link")) {
      // The link of what is on the screen, not of what the address bar has come to.
      writeUrlNow()
      navigator.clipboard?.writeText(window.location.href)
    }
  })

  let plots = []
  const updates = new Set()
  // The views of all plots, and the cells of all pictures.
  const findPictures = () => {
    const found = { plots: [], cells: [] }
    const visit = (item) => {
      if (item == null) return
      if (item.request_paint !== undefined && item.repainted !== undefined) found.plots.push(item)
      if (item.el?.classList.contains("picture")) found.cells.push(item.el)
      for (const child of item.children_views?.() ?? []) visit(child)
    }
    for (const top of Object.values(window.Bokeh.index)) visit(top)
    return found
  }

  const unpainted = (plot) => plot._invalidate_all || plot._invalidated_painters.size > 0
  const busy = () => spherePending || plots.some(unpainted)

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
    Object.assign(latest.texts, tree.texts)
    Object.assign(latest.numbers, tree.numbers)
    document.dispatchEvent(new CustomEvent("hess:text", { detail: tree.texts }))
  }

  let waiting = false
  let applied = false
  let giveUp = null

  const settle = () => {
    const { number, answers } = state
    clearTimeout(giveUp)
    root.dataset.state = String(number)
    asked = null
    // What could not be painted yet (a hidden tab) is still waited for, but holds up nothing.
    waiting = busy()
    if (answers < requested) ask()
    else if (!waiting) root.dataset.ready = "true"
  }
  // Called whenever one of the pictures has been painted.
  const onPainted = () => { if (waiting && applied && !busy()) settle() }

  const onState = () => {
    const block = model.block
    state = JSON.parse(model.state)
    if (state.scene !== scene) whenBuilt(() => show(block))
    else show(block)
  }

  const show = (block) => {
    unpack(state.tree, block)
    // A control that has been moved on since is not moved back.
    if (state.answers === requested) {
      document.dispatchEvent(new CustomEvent("hess:numbers", { detail: state.tree.numbers }))
    }
    writeUrl()
    waiting = true
    applied = false
    clearTimeout(giveUp)
    // A hidden tab paints nothing, and a broken picture must not hold up the page for ever.
    giveUp = setTimeout(settle, document.hidden ? 0 : 2000)
    // Bokeh takes new data in promises.  When they are through, paint at once rather than in the next
    // frame: when that comes, all is ready for it.
    Promise.all(updates).then(() => {
      if (updates.size > 0) return
      applied = true
      document.dispatchEvent(new CustomEvent("hess:paint"))
      for (const plot of plots) if (unpainted(plot) && !plot._invalidate_all) plot.paint()
      onPainted()
    })
  }

  let timer = null
  const writeUrlNow = () => {
    clearTimeout(timer)
    timer = null
    const extra = Object.entries(own).map(([key, value]) => `&${key}=${encodeURIComponent(value)}`).join("")
    const query = `?${state.query}${extra}${page().dark_theme ? "&theme=dark" : ""}`
    if (query !== window.location.search) window.history.replaceState(null, "", query)
  }
  const writeUrl = () => { timer ??= setTimeout(writeUrlNow, URL_PAUSE) }
  document.addEventListener("hess:url", (event) => {
    Object.assign(own, event.detail)
    writeUrl()
  })
  document.addEventListener("hess:sphere-invalid", () => { spherePending = true })
  document.addEventListener("hess:sphere-painted", () => { spherePending = false; onPainted() })

  const prepare = (found) => {
    plots = found.plots
    hidden.clear()
    sight.disconnect()
    for (const cell of found.cells) sight.observe(cell)
    for (const plot of plots) {
      plot.repainted.connect(onPainted)
      // Bokeh's own repaint measures all axis labels first, also when `onState` has painted already.
      const repaint = plot.repaint.bind(plot)
      plot.repaint = () => { if (unpainted(plot)) repaint() }
      // Bokeh does not cut what is on the overlay canvas to the frame; all our moving elements are there.
      for (const part of plot.computed_renderer_views) {
        const update = part.update_data?.bind(part)
        if (update !== undefined) {
          part.update_data = (indices) => {
            const done = update(indices)
            updates.add(done)
            return done.finally(() => updates.delete(done))
          }
        }
        if (part.model.level === "overlay") Object.defineProperty(part, "needs_clip", { value: true, configurable: true })
      }
      // Its first picture was not cut: wipe it, rims included.
      const { el } = plot.canvas_view.overlays
      el.width = el.width
      plot.request_paint()
    }
  }

  const covered = () => Object.values(window.Bokeh.index).some((top) => {
    const veil = top.shadow_el?.querySelector(".MuiBackdrop-root")
    return veil != null && getComputedStyle(veil).visibility !== "hidden"
  })

  // Calls back when all plots of the scene of this state are there, have been painted once, and nothing covers them.
  const whenBuilt = (callback) => {
    const found = findPictures()
    const names = found.plots.map((plot) => plot.model.name).sort().join()
    const built = names === [...state.plots].sort().join() && found.plots.every((plot) => plot.has_finished())
    if (!built || (scene === null && covered() && performance.now() < 10_000)) {
      return void requestAnimationFrame(() => whenBuilt(callback))
    }
    scene = state.scene
    prepare(found)
    callback()
  }
  const start = () => {
    if (bokeh() == null || !bokeh().is_idle) return void requestAnimationFrame(start)
    bokeh().on_change(onChange)
    // On a phone the controls would cover the pictures: there they open by the menu button.
    if (window.innerWidth < 800) page().sidebar_open = false
    started = true
    onState()
    entered = state.scene
  }
  // The first state is read when the page stands, even if the user was faster and it is no longer the first.
  let started = false
  model.on("state", () => { if (started) onState() })
  start()
}
