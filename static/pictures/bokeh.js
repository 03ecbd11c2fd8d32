// @ts-check
// BokehJS in a page that is a file: it takes longer to start than everything else, and runs when the first plot needs it.

/** Run BokehJS if the page holds it as text; a served page has it from the start. */
export function startBokeh() {
  const held = document.getElementById("bokeh")
  if (held === null) return
  held.remove()
  document.head.append(Object.assign(document.createElement("script"), { textContent: held.textContent }))
}
