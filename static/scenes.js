// The menu of scenes, by their pictures.  A choice goes to "ready.js" by the event "hess:scene"; what the mouse or the
// keyboard rests on by "hess:near": its pictures are built before they are asked for.

const REST = 60

export function render({ model, view, el }) {
  view.living?.abort()
  view.living = new AbortController()
  model.on("remove", () => view.living.abort())
  const { signal } = view.living
  const bar = document.createElement("div")
  bar.className = "scenes"
  bar.setAttribute("role", "group")
  bar.setAttribute("aria-label", "Scene")
  el.append(bar)

  function show({ name }) {
    const here = model.scenes.find((scene) => scene.name === name)
    const base = here?.origin ?? name
    // Of what looks into another scene only that of the scene on show is offered.
    const offered = model.scenes.filter((scene) => scene.origin === null || scene.origin === base)
    const focused = bar.getRootNode().activeElement?.dataset.scene
    bar.replaceChildren(...offered.map((scene) => {
      const item = document.createElement("button")
      item.type = "button"
      item.className = `scene param-scene-${scene.name}`
      item.dataset.scene = scene.name
      item.title = scene.summary
      item.setAttribute("aria-pressed", String(scene.name === name))
      const picture = document.createElementNS("http://www.w3.org/2000/svg", "svg")
      picture.setAttribute("viewBox", "0 0 48 32")
      picture.setAttribute("aria-hidden", "true")
      picture.innerHTML = scene.picture
      const title = document.createElement("span")
      title.textContent = scene.title
      item.append(picture, title)
      const tell = (name) => document.dispatchEvent(new CustomEvent(name, { detail: scene.name }))
      item.addEventListener("click", () => tell("hess:scene"))
      let resting = null
      for (const name of ["pointerenter", "focus"]) {
        item.addEventListener(name, () => { resting = setTimeout(tell, REST, "hess:near") })
      }
      for (const name of ["pointerleave", "blur"]) item.addEventListener(name, () => clearTimeout(resting))
      return item
    }))
    const pressed = bar.querySelector('[aria-pressed="true"]')
    if (pressed !== null) bar.scrollTop = pressed.offsetTop - bar.clientHeight / 2
    if (focused !== undefined) bar.querySelector(`[data-scene="${focused}"]`)?.focus()
  }
  document.addEventListener("hess:enter", (event) => show(event.detail), { signal })
  document.dispatchEvent(new CustomEvent("hess:mounted", { detail: { kind: "scene", show } }))
}
