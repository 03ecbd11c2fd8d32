// What of Panel's page the client needs: its theme, and whether it stands.

// `document` is Bokeh's document of the page.
export function createPage(view) {
  const bokeh = () => view.model.document
  const page = () => bokeh().roots().find((top) => top.data?.attributes.dark_theme !== undefined).data
  const nextFrame = () => new Promise(requestAnimationFrame)
  return {
    isDark: () => page().dark_theme,
    turnTheme() { page().dark_theme = !page().dark_theme },
    // Resolves when all that Panel shows is there.
    async standing() {
      while (bokeh() == null || !bokeh().is_idle) await nextFrame()
    },
    onThemeChange(hear) { bokeh().on_change((event) => { if (event.attr === "dark_theme") hear() }) },
  }
}
