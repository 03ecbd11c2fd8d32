// A number: a slider for the hand, a box for exact values.  Changes go to "ready.js" by the event
// "hess:change" {name: value}; what the server says of all numbers comes by "hess:numbers"
// {name: [value, low, high, step]}.

export function render({ model, view, el }) {
  // Listeners go with the view: when it is removed, or rendered once more.
  view.living?.abort()
  view.living = new AbortController()
  model.on("remove", () => view.living.abort())
  const { signal } = view.living
  const { name, label, symbol, help } = model
  const frame = document.createElement("div")
  frame.className = "number"
  const title = document.createElement("span")
  title.className = "label"
  title.textContent = label
  title.title = help
  const box = document.createElement("input")
  box.type = "text"
  box.inputMode = "decimal"
  box.spellcheck = false
  box.setAttribute("aria-label", `${symbol}, exact value`)
  box.title = `${help} Type an exact value and press Enter.`
  const slider = document.createElement("input")
  slider.type = "range"
  slider.className = "hand"
  slider.setAttribute("aria-label", label)
  slider.setAttribute("aria-description", help)
  slider.title = help
  frame.append(title, box, slider)
  el.append(frame)

  let shown = null
  function show([value, low, high, step]) {
    shown = value
    slider.min = Math.min(low, value)
    slider.max = Math.max(high, value)
    slider.step = step
    slider.value = value
    box.value = String(value)
    box.removeAttribute("aria-invalid")
  }
  const change = (value) => {
    shown = value
    document.dispatchEvent(new CustomEvent("hess:change", { detail: { [name]: value } }))
  }

  slider.addEventListener("input", () => {
    box.value = slider.value
    change(Number(slider.value))
  })
  const commit = () => {
    const text = box.value.trim().replaceAll("−", "-").replace(",", ".")
    const value = Number(text)
    const valid = text !== "" && Number.isFinite(value)
    box.setAttribute("aria-invalid", String(!valid))
    box.setCustomValidity(valid ? "" : "This is not a number: type one like 1.5 or 1e-8.")
    if (!valid) box.reportValidity()
    else if (value !== shown) change(value)
  }
  box.addEventListener("change", commit)
  box.addEventListener("input", () => box.setCustomValidity(""))
  box.addEventListener("keydown", (event) => {
    if (event.key !== "Escape") return
    box.value = String(shown)
    box.setCustomValidity("")
    box.removeAttribute("aria-invalid")
  })
  const onNumbers = (event) => { if (name in event.detail) show(event.detail[name]) }
  document.addEventListener("hess:numbers", onNumbers, { signal })
  show(model.shown)
  document.dispatchEvent(new CustomEvent("hess:mounted", { detail: { kind: "numbers", key: name, show } }))
}
