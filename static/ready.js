// Asks for states, fills the pictures with them, tells when they are painted, and keeps the URL.
// <html data-ready> is "false" from a change by the user until the answer to it is on the screen;
// data-state counts the painted states.  The next state is asked for only when the last one is
// painted, so nothing queues however fast a slider is dragged.

const URL_PAUSE = 400
const PATIENCE = 400
// The next pieces are asked for after a pause as long as the last ones took: half of the time is the user's.
const MORE_PAUSE = 80
const LOST = "The connection to the server is lost. See that it runs, and reload this page: its address keeps the state."

export function render({ model, view }) {
  const root = document.documentElement
  const own = model.client
  let state = null
  let requested = 0
  let asking = false
  let asked = null
  let lost = false
  let since = 0
  let held = false
  let touched = false
  let wish = {}
  let values = {}
  let chosen = null
  let bound = null
  let scene = null
  let sign = null
  root.dataset.ready = "false"
  root.dataset.state = "0"

  const tell = (name, detail) => document.dispatchEvent(new CustomEvent(name, { detail }))
  const bokeh = () => view.model.document
  const page = () => bokeh().roots().find((top) => top.data?.attributes.dark_theme !== undefined).data

  // One request at a time: the next one goes when the answer to the last is painted.
  const ask = () => {
    if (scene === null || asked !== null || asking || lost) return
    asking = true
    queueMicrotask(() => {
      asking = false
      asked = requested
      const entering = chosen !== null && chosen !== scene.name
      model.send_msg({
        requested, held, values, ...wish, scene: entering ? chosen : null, hidden: entering ? null : [...hidden],
      })
      values = {}
      wish = {}
      chosen = null
      clearTimeout(sign)
      sign = setTimeout(() => tell("hess:texts", { busy: "Computing… A scene is compiled when it is first used." }), PATIENCE)
    })
  }
  const request = () => {
    root.dataset.ready = "false"
    requested += 1
    ask()
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
  // Control → the request by which it was changed last.
  const moved = new Map()
  document.addEventListener("hess:change", (event) => {
    Object.assign(values, event.detail)
    for (const name of Object.keys(event.detail)) moved.set(name, requested + 1)
    request()
  })
  // What was changed before an example or a reset counts no more.
  const wishFor = (what) => {
    moved.set("preset", requested + 1)
    values = {}
    wish = what
    request()
  }
  document.addEventListener("hess:preset", (event) => wishFor({ preset: event.detail }))
  for (const what of ["reset", "undo", "clear"]) {
    document.addEventListener(`hess:${what}`, () => wishFor({ [what]: true }))
  }
  document.addEventListener("hess:stop", () => {
    wish.stop = true
    request()
  })
  document.addEventListener("hess:pick", (event) => {
    const { pick, drag } = event.detail
    // A finger that moves scrolls the page.
    if ((drag && touched) || !Array.isArray(pick) || !pick.slice(1).every(Number.isFinite)) return
    wish.picked = pick
    request()
  })
  document.addEventListener("hess:hover", (event) => {
    if (!event.detail.slice(1).every(Number.isFinite)) return
    wish.hover = event.detail
    ask()
  })
  document.addEventListener("hess:near", (event) => {
    if (descriptions.has(event.detail)) return
    wish.near = event.detail
    ask()
  })
  document.addEventListener("hess:scene", (event) => {
    // The scene chosen last, though its pictures may still be on their way.
    if (event.detail === (bound ?? state?.scene)) return
    chosen = bound = event.detail
    request()
  })
  document.addEventListener("hess:link", () => {
    // The link of what is on the screen, not of what the address bar has come to.
    writeUrlNow()
    navigator.clipboard?.writeText(window.location.href)
  })

  // What is mounted later than a state (controls in a drawer that opens) learns here what it has missed.
  let latest = { scene: null, texts: {}, controls: {} }
  document.addEventListener("hess:mounted", (event) => {
    const { kind, key, show } = event.detail
    const known = kind === "client" ? own : kind === "texts" ? latest.texts[key] : latest[kind]
    if (known != null) show(known)
  })

  // Pictures out of sight are not computed; what comes into sight is asked for.
  const hidden = new Set()
  const sight = new IntersectionObserver((entries) => {
    let appeared = false
    for (const { target, isIntersecting } of entries) {
      const { name } = target.dataset
      if (isIntersecting && !target.classList.contains("folded")) appeared = hidden.delete(name) || appeared
      else hidden.add(name)
    }
    if (appeared) request()
  }, { rootMargin: "100px", scrollMargin: "100px" })

  document.addEventListener("hess:folded", (event) => {
    const { name, folded } = event.detail
    if (folded) hidden.add(name)
    else if (hidden.delete(name)) request()
  })

  const updates = new Set()
  const canvases = new Set()
  const unpainted = (plot) => plot._invalidate_all || plot._invalidated_painters.size > 0
  const busy = () => canvases.size > 0 || scene.plots.some(unpainted)
  document.addEventListener("hess:canvas-invalid", (event) => { canvases.add(event.detail) })
  document.addEventListener("hess:canvas-painted", (event) => {
    canvases.delete(event.detail)
    onPainted()
  })

  // Bokeh paints each of thousands of dots as a circle with colours of its own; here they are squares as large, of one.
  const dots = (glyph) => (ctx, indices) => {
    const { sx, sy, size, visuals } = glyph
    visuals.line.set_vectorize(ctx, 0)
    ctx.fillStyle = ctx.strokeStyle
    const width = size.get(0) / 8 * Math.sqrt(Math.PI)
    for (const i of indices) ctx.fillRect(sx[i] - width / 2, sy[i] - width / 2, width, width)
  }
  const prepare = (found) => {
    for (const plot of found.plots) {
      plot.repainted.connect(() => onPainted())
      // To Bokeh a pointer that rests for 0.3 s is pressing: no click and no drag comes of it any more.
      plot.canvas_view.ui_event_bus.ui_gestures._start_timeout = () => {}
      // Bokeh's own repaint measures all axis labels first, also when `show` has painted already.
      const repaint = plot.repaint.bind(plot)
      // And it clears only what it fills: ticks of other axes would stay behind a transparent background.
      plot.repaint = () => {
        if (plot._invalidate_all) {
          const { primary } = plot.canvas_view
          primary.undo_transform((ctx) => ctx.clearRect(0, 0, primary.el.width, primary.el.height))
        }
        if (unpainted(plot)) repaint()
      }
      // Bokeh does not cut what is on the overlay canvas to the frame; all our moving elements are there.
      for (const part of plot.computed_renderer_views) {
        if (part.glyph?.model.marker?.value === "dot") part.glyph._paint = dots(part.glyph)
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

  // One tree and one block of single-precision numbers → the columns of the sources, axes, texts, controls.
  function unpack(tree, block) {
    const { ndarray } = Bokeh.require("core/util/ndarray")
    const place = (item) => {
      if (Array.isArray(item)) return item.map(place)
      if (typeof item !== "object" || item === null) return item
      const array = new Float32Array(block, 4 * item.at, item.n)
      return item.shape === undefined ? array : ndarray(array, { dtype: "float32", shape: item.shape })
    }
    for (const [name, [x0, x1, y0, y1]] of Object.entries(tree.ranges)) {
      const { model: plot } = scene.plots.find((one) => one.model.name === name)
      plot.x_range.setv({ start: x0, end: x1 })
      plot.y_range.setv({ start: y0, end: y1 })
    }
    for (const [name, columns] of Object.entries(tree.sources)) {
      scene.sources.get(name).put(Object.fromEntries(Object.entries(columns).map(([key, column]) => [key, place(column)])))
    }
    Object.assign(latest.texts, tree.texts)
    Object.assign(latest.controls, tree.controls)
    tell("hess:texts", tree.texts)
    // A control that has been moved on since is not moved back.
    const settled = Object.entries(tree.controls).filter(([name]) => !(moved.get(name) > state.answers))
    tell("hess:controls", Object.fromEntries(settled))
  }

  const descriptions = new Map()
  let arriving = Promise.resolve()
  // States come one by one; the pictures of a new scene are built behind those of the old one.
  const onState = () => {
    const [text, block] = [model.state, model.block]
    let near = null
    if (model.scene !== "" && !descriptions.has(model.scene)) {
      near = JSON.parse(model.scene)
      descriptions.set(model.scene, near).set(near.name, near)
    }
    const next = JSON.parse(text)
    arriving = arriving.then(async () => {
      if (!window.hess.has(next.scene)) prepare(await window.hess.build(descriptions.get(next.scene)))
      state = next
      if (scene?.name !== state.scene) enter()
      show(block)
      if (near !== null && !window.hess.has(near.name)) prepare(await window.hess.build(near))
    }).catch((error) => {
      // One state that cannot be shown must not keep the next ones away.
      asked = null
      console.error(error)
    })
  }
  const enter = () => {
    scene = window.hess.enter(state.scene)
    latest = { scene: descriptions.get(state.scene), texts: {}, controls: {} }
    hidden.clear()
    sight.disconnect()
    for (const cell of scene.cells) sight.observe(cell)
    root.dataset.scene = scene.name
    tell("hess:enter", latest.scene)
  }

  let waiting = false
  let applied = false
  let giveUp = null
  let more = null
  const settle = () => {
    const { number, answers } = state
    clearTimeout(giveUp)
    root.dataset.state = String(number)
    clearTimeout(sign)
    tell("hess:texts", { busy: "" })
    asked = null
    // The first picture on new axes has ticks of the old ones in it: Bokeh's are painted once more.
    if (!scene.settled) for (const plot of scene.plots) if (plot.model.name in state.tree.ranges) plot.request_paint()
    scene.settled = true
    // What could not be painted yet (a hidden tab) is still waited for, but holds up nothing.
    waiting = busy()
    tell("hess:progress", state.progress)
    clearTimeout(more)
    if (answers < requested) ask()
    else if (state.progress !== null) more = setTimeout(ask, Math.max(MORE_PAUSE, performance.now() - since))
    else if (!waiting) root.dataset.ready = "true"
  }
  // Called whenever one of the pictures has been painted.
  const onPainted = () => { if (waiting && applied && !busy()) settle() }

  const show = (block) => {
    since = performance.now()
    unpack(state.tree, block)
    writeUrl()
    waiting = true
    applied = false
    clearTimeout(giveUp)
    // A hidden tab paints nothing, and a broken picture must not hold up the page for ever.
    giveUp = setTimeout(settle, document.hidden ? 0 : 2000)
    // Bokeh takes new data in promises.  When they are through, paint at once rather than in the next
    // frame: when that comes, all is ready for it.
    const paint = () => Promise.all(updates).then(() => {
      if (updates.size > 0) return
      applied = true
      tell("hess:paint")
      for (const plot of scene.plots) if (unpainted(plot) && !plot._invalidate_all) plot.paint()
      onPainted()
    })
    paint()
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

  const covered = () => Object.values(window.Bokeh.index).some((top) => {
    const veil = top.shadow_el?.querySelector(".MuiBackdrop-root")
    return veil != null && getComputedStyle(veil).visibility !== "hidden"
  })
  // The first state is read when the page stands, even if the user was faster and it is no longer the first.
  const start = () => {
    if (bokeh() == null || !bokeh().is_idle || window.hess === undefined) return void requestAnimationFrame(start)
    // On a phone the controls would cover the pictures: there they open by the menu button.
    if (window.innerWidth < 800) page().sidebar_open = false
    uncover()
  }
  const uncover = () => {
    if (covered() && performance.now() < 10_000) return void requestAnimationFrame(uncover)
    bokeh().on_event("connection_lost", () => {
      lost = true
      clearTimeout(sign)
      tell("hess:texts", { busy: LOST })
    })
    bokeh().on_change((event) => { if (event.attr === "dark_theme") writeUrl() })
    tell("hess:client", own)
    model.on("state", onState)
    onState()
  }
  start()
}
