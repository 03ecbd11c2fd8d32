// What of Panel's page the client needs: its theme, its drawer, whether it stands, whether the server answers.

const NARROW = 800
const MOST = 10_000

// `document` is Bokeh's document of the page.
export function createPage(view) {
  const bokeh = () => view.model.document
  const page = () => bokeh().roots().find((top) => top.data?.attributes.dark_theme !== undefined).data
  const covered = () => Object.values(Bokeh.index).some((top) => {
    const veil = top.shadow_el?.querySelector(".MuiBackdrop-root")
    return veil != null && getComputedStyle(veil).visibility !== "hidden"
  })
  const nextFrame = () => new Promise(requestAnimationFrame)
  return {
    isDark: () => page().dark_theme,
    // Resolves when all that Panel shows is there and nothing covers it.
    async standing() {
      while (bokeh() == null || !bokeh().is_idle) await nextFrame()
      // On a phone the controls would cover the pictures: there they open by the menu button.
      if (window.innerWidth < NARROW) page().sidebar_open = false
      while (covered() && performance.now() < MOST) await nextFrame()
    },
    onThemeChange(hear) { bokeh().on_change((event) => { if (event.attr === "dark_theme") hear() }) },
    onConnectionLost(hear) { bokeh().on_event("connection_lost", hear) },
  }
}
