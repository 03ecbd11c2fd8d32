// @ts-check
// Loads the modules of the page while Bokeh and Panel are loading, and renders the page when Panel sends its component.  Panel's
// own loader fetches and rewrites each module, which takes longer than all the rest.

const served = import("./served.js")

document.addEventListener("component", async (event) => {
  const { render } = await served
  render(/** @type {CustomEvent} */ (event).detail)
})
