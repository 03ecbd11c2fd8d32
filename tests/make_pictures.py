"""Make the pictures of the gallery in *Scenes* and of the README: `python tests/make_pictures.py [NAME…]`.

Each is the inside of a picture's axes, or a sphere, in the light and in the dark theme; with them goes the whole page.
"""

from __future__ import annotations

import io
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

from PIL import Image
from playwright.sync_api import FloatRect, Page

from hess_explorer.assets import STATIC
from hess_explorer.headless.browser import launched, wait_ready
from hess_explorer.headless.screenshot import screenshot, server_process
from hess_explorer.page.showcase import EXHIBITS, Exhibit
from support.modules import look_inside

README = Path(__file__).resolve().parents[1] / ".github" / "pictures"
FRONT = (
    Exhibit("suslov-hess", "Two limit cycles", "surface"),
    Exhibit("free-suslov", "Portrait, I₁₃ > 0, I₂₃ < 0", "omega"),
    Exhibit("scattering", "I₁₁ = 3.56", "map"),
    Exhibit("suslov", "Two attractors", "section"),
    Exhibit("kharlamova", "Periodic: two orbits", "domain"),
    Exhibit("quartic", "Mixed: in the sea", "section"),
    Exhibit("rotation-number", "One plateau", "map"),
    Exhibit("chaplygin-ball", "Projections", "omega"),
    Exhibit("ball-section", "Mixed", "section"),
    Exhibit("euler-poisson", "Two layers", "section"),
    Exhibit("hess-leak", "f = 0", "body"),
    Exhibit("bridge", "Two limit cycles", "omega"),
    Exhibit("loxodrome", "Almost round", "space"),
    Exhibit("singular-measures", "Free Suslov", "sphere"),
    Exhibit("orbit-diagram", "Period doubling", "diagram"),
    Exhibit("ball-diagram", "Period doubling", "diagram"),
    Exhibit("own-body", "Suslov problem", "sphere"),
)
"""The front picture of each scene."""
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


def taken(page: Page, base: str, exhibit: Exhibit, theme: str, edge: int) -> Image.Image:
    """Return a picture, once all of it has been computed, as a square of so many pixels."""
    parts = f"embed=1&pictures={exhibit.picture}&controls=none&theme={theme}"
    page.goto(f"{base}/?{exhibit.query}&{parts}")
    wait_ready(page)
    # The page has taken its last size.
    page.wait_for_timeout(1000)
    shot = page.screenshot(clip=inside(page, exhibit.picture))
    return Image.open(io.BytesIO(shot)).convert("RGB").resize((edge, edge), Image.Resampling.LANCZOS)


def wanted(names: list[str]) -> Iterator[tuple[Exhibit, Path, int]]:
    """Yield the named pictures, or all: each with its file, without theme and suffix, and its edge in pixels."""
    for exhibit in EXHIBITS:
        if not names or exhibit.file in names:
            yield exhibit, STATIC / "thumbnails" / exhibit.file, 240
    for exhibit in FRONT:
        if not names or exhibit.scene in names:
            yield exhibit, README / exhibit.scene, 320


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
            for exhibit, path, edge in wanted(names):
                picture = taken(page, base, exhibit, theme, edge)
                picture.save(path.with_name(f"{path.name}-{theme}.jpg"), quality=82, optimize=True)
            page.close()
    if not names or "page" in names:
        page = Image.open(io.BytesIO(screenshot("scene=suslov-hess", (1600, 950)))).convert("RGB")
        # With a palette a quarter of the bytes, and no difference to the eye.
        page.quantize(128, dither=Image.Dither.NONE).save(README / "page.png", optimize=True)


if __name__ == "__main__":
    main(sys.argv[1:])
