"""Access from tests to the page's own modules, imported once more as `window.hess`.

hess.plots, hess.source(name), hess.has(scene) are the gallery's; hess.tell(name, detail) and hess.listen(name, hear)
the bus's; hess.plotted() names the sources of the planar pictures on show; hess.clouds(source, t).
"""

from hess_explorer.assets import modules_path

_SCRIPT = """const begin = () => {
  const load = (path) => import(new URL(`MODULES/${path}`, document.baseURI).href)
  Promise.all([
    load("page/bus.js"), load("pictures/gallery.js"), load("pictures/cloud.js"),
  ]).then(([bus, { gallery }, { cloudsOf }]) => {
    window.hess = {
      get plots() { return gallery.shown.plots }, source: gallery.source, has: gallery.has, tell: bus.tell,
      listen: (name, hear) => bus.listen({ [name]: hear }), clouds: (source, t) => cloudsOf(source).at(t),
      plotted() {
        const { sources, cells } = gallery.shown
        const drawn = cells.filter((cell) => cell.querySelector("canvas") !== null).map((cell) => cell.dataset.name)
        return [...sources.keys()].filter((name) => !name.endsWith("-box") && !drawn.includes(name)).sort()
      },
    }
  })
}
const isServed = location.protocol.startsWith("http")
if (isServed) addEventListener("DOMContentLoaded", begin)""".replace("MODULES", modules_path())


def look_inside(page):
    """From the next address on; with Playwright's asynchronous pages, to be awaited."""
    return page.add_init_script(_SCRIPT)
