// The controls of the scene on show: a slider and a box for each number, a menu for each choice, one of examples,
// Reset and Copy link.  Changes go to "ready.js" by events of the page; what the server says of all values comes by
// "hess:controls" {name: [value, low, high, step] or option}.

function element(tag, properties, ...children) {
  const item = Object.assign(document.createElement(tag), properties)
  item.append(...children)
  return item
}

const tell = (name, detail) => document.dispatchEvent(new CustomEvent(name, { detail }))

// A number: a slider for the hand, a box for exact values.
function number({ name, label, symbol, help }) {
  const title = element("span", { className: "label", textContent: label, title: help })
  const box = element("input", {
    type: "text", inputMode: "decimal", spellcheck: false, title: `${help} Type an exact value and press Enter.`,
    ariaLabel: `${symbol}, exact value`,
  })
  const slider = element("input", { type: "range", className: "hand", title: help, ariaLabel: label })
  slider.setAttribute("aria-description", help)
  let shown = null
  const change = (value) => {
    shown = value
    tell("hess:change", { [name]: value })
  }
  slider.addEventListener("input", () => {
    box.value = slider.value
    change(Number(slider.value))
  })
  box.addEventListener("change", () => {
    const text = box.value.trim().replaceAll("−", "-").replace(",", ".")
    const value = Number(text)
    const valid = text !== "" && Number.isFinite(value)
    box.setAttribute("aria-invalid", String(!valid))
    box.setCustomValidity(valid ? "" : "This is not a number: type one like 1.5 or 1e-8.")
    if (!valid) box.reportValidity()
    else if (value !== shown) change(value)
    // As the server will write it: from here on another text is one that is being typed.
    if (valid) box.value = String(value)
  })
  box.addEventListener("input", () => box.setCustomValidity(""))
  box.addEventListener("keydown", (event) => {
    if (event.key !== "Escape") return
    box.value = String(shown)
    box.setCustomValidity("")
    box.removeAttribute("aria-invalid")
  })
  const show = ([value, low, high, step]) => {
    // States may come while a number is typed, piece by piece of a section: they leave it alone.
    const typing = box.getRootNode().activeElement === box && box.value !== String(shown)
    shown = value
    slider.min = Math.min(low, value)
    slider.max = Math.max(high, value)
    slider.step = step
    slider.value = value
    if (typing) return
    box.value = String(value)
    box.removeAttribute("aria-invalid")
  }
  return [element("div", { className: `number param-${name}` }, title, box, slider), show]
}

function menu(name, label, options, help, choose) {
  const select = element("select", { title: help, ariaLabel: label }, ...options.map((option) => new Option(...option)))
  const frame = element("label", { className: `menu param-${name}` }, element("span", { textContent: label }), select)
  select.addEventListener("change", () => choose(select.value))
  return [frame, (option) => { select.value = option }]
}

function choice({ name, label, options, help }) {
  const plain = options.map((option) => [option, option])
  const [frame, show] = menu(name, label, plain, help, (option) => tell("hess:change", { [name]: option }))
  return [element("div", {}, frame, element("p", { className: "text help", textContent: help })), show]
}

function button(name, label, title, press) {
  const item = element("button", { type: "button", className: `button param-${name}`, textContent: label, title })
  item.addEventListener("click", press)
  return item
}

export function render({ model, view, el }) {
  // Listeners go with the view: when it is removed, or rendered once more.
  view.living?.abort()
  view.living = new AbortController()
  model.on("remove", () => view.living.abort())
  const { signal } = view.living
  const column = element("div", { className: "column" })
  el.append(column)
  let shows = {}

  const build = (scene) => {
    const [examples, showExample] = menu("preset", "Example",
      [["Choose an example…", ""], ...scene.presets.map((name) => [name, name])],
      "States to begin with", (name) => { if (name !== "") tell("hess:preset", name) })
    shows = { preset: showExample }
    const items = scene.controls.map((control) => {
      const [item, show] = control.kind === "number" ? number(control) : choice(control)
      shows[control.name] = show
      return item
    })
    column.replaceChildren(examples, ...items, element("div", { className: "buttons" },
      button("reset", "Reset", "Back to the first state of this scene", () => tell("hess:reset")),
      ...(scene.drawn ? [
        button("undo", "Undo", "Take back the last click or box in a picture", () => tell("hess:undo")),
        button("clear", "Clear", "Without all clicks and boxes", () => tell("hess:clear"))] : []),
      button("link", "Copy link", "A link to all that is on the screen", () => tell("hess:link"))))
  }
  const show = (values) => {
    for (const [name, value] of Object.entries(values)) shows[name]?.(value)
  }
  document.addEventListener("hess:enter", (event) => build(event.detail), { signal })
  document.addEventListener("hess:controls", (event) => show(event.detail), { signal })
  tell("hess:mounted", { kind: "scene", show: build })
  tell("hess:mounted", { kind: "controls", show })
}
