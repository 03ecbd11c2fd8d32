"""Access from tests to the page's own modules, as `window.hess`.

hess.plots, hess.source(name), hess.has(scene) are the gallery's; hess.tell(name, detail) and hess.listen(name, hear)
the bus's; hess.plotted() names the sources of the planar pictures on show; hess.clouds(source, t).
"""

from hess_explorer.assets import modules_path

SERVED = f"{modules_path()}/page/served.js"
"""The file of all modules of a page beside its server, which exports each by its path."""

_SCRIPT = """const begin = () => {
  import(new URL("BUNDLE", document.baseURI).href).then((modules) => {
    const { "base/bus.js": bus, "pictures/gallery.js": { gallery }, "pictures/cloud.js": { cloudsOf } } = modules
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
if (isServed) addEventListener("DOMContentLoaded", begin)""".replace("BUNDLE", SERVED)


def look_inside(page):
    """From the next address on; with Playwright's asynchronous pages, to be awaited."""
    return page.add_init_script(_SCRIPT)
