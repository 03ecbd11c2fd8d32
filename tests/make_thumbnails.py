"""Make the pictures of the gallery in the menu of scenes: `python tests/make_thumbnails.py [NAME…]`.

Each is the inside of a picture's axes, or a sphere, in the light and in the dark theme.
"""

import io
import sys
import tempfile
from pathlib import Path

from PIL import Image
from playwright.sync_api import FloatRect, Page

from hess_explorer.assets import STATIC
from hess_explorer.headless.browser import launched, wait_ready
from hess_explorer.headless.screenshot import server_process
from hess_explorer.page.showcase import EXHIBITS
from support.modules import look_inside

EDGE = 240
VIEWPORT = {"width": 560, "height": 680}
INSIDE = """name => {
  const plot = hess.plots.find(({ model }) => model.name === name)
  if (plot === undefined) return null
  const { x0, y0, width, height } = plot.frame.bbox
  const { left, top } = plot.el.getBoundingClientRect()
  return { x: left + x0, y: top + y0, width, height }
}"""
"""The rectangle inside the axes of a plot."""


def inside(page: Page, name: str) -> FloatRect:
    """Return the rectangle of a picture without its axes and caption."""
    return page.evaluate(INSIDE, name) or page.locator(f".picture-{name} canvas").first.bounding_box()


def main(names: list[str]) -> None:
    """Make the named pictures, or all."""
    with (
        launched() as browser,
        tempfile.TemporaryDirectory() as folder,
        server_process(Path(folder) / "server.log") as (_, base),
    ):
        for theme in ("light", "dark"):
            page = browser.new_page(viewport=VIEWPORT, color_scheme=theme, reduced_motion="reduce")
            look_inside(page)
            for exhibit in EXHIBITS:
                if names and exhibit.file not in names:
                    continue
                parts = f"embed=1&pictures={exhibit.picture}&controls=none&theme={theme}"
                page.goto(f"{base}/?{exhibit.query}&{parts}")
                wait_ready(page)
                # Sections and maps have been refined by then.
                page.wait_for_timeout(8000)
                shot = page.screenshot(clip=inside(page, exhibit.picture))
                small = Image.open(io.BytesIO(shot)).convert("RGB").resize((EDGE, EDGE), Image.Resampling.LANCZOS)
                small.save(STATIC / "thumbnails" / f"{exhibit.file}-{theme}.jpg", quality=82, optimize=True)
            page.close()


if __name__ == "__main__":
    main(sys.argv[1:])
