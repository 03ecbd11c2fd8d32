"""Make the pictures of the scenes, in *Scenes* and in the README: `python tests/manual/make_pictures.py [SCENE…]`.

Each is the inside of a picture's axes, or a sphere, in the light and in the dark theme.  With them go the whole page
(`page`) and the moving picture of the README (`motion`).
"""

import io
import sys
import tempfile
from pathlib import Path
from urllib.parse import urlencode

import numpy as np
from PIL import Image

from hess_explorer.assets import STATIC
from hess_explorer.export.formats import FileRequest
from hess_explorer.export.picture_data import picture_data
from hess_explorer.headless.browser import headless_browser, wait_ready
from hess_explorer.headless.film import frames
from hess_explorer.headless.screenshot import screenshot, server_process
from hess_explorer.scenes import scenes
from support.modules import look_inside
from support.view import values_of

README = Path(__file__).resolve().parents[2] / ".github" / "pictures"
FRONT = {
    "suslov-hess": ("Two limit cycles", "surface"),
    "free-suslov": ("Portrait, I₁₃ > 0, I₂₃ < 0", "omega"),
    "scattering": ("I₁₁ = 3.56", "map"),
    "suslov": ("Two attractors", "section"),
    "kharlamova": ("Periodic: two orbits", "domain"),
    "quartic": ("Mixed: in the sea", "section"),
    "rotation-number": ("One plateau", "map"),
    "chaplygin-ball": ("Projections", "omega"),
    "ball-section": ("Mixed", "section"),
    "euler-poisson": ("Two layers", "section"),
    "hess-leak": ("f = 0", "body"),
    "bridge": ("Two limit cycles", "omega"),
    "loxodrome": ("Almost round", "space"),
    "singular-measures": ("Free Suslov", "sphere"),
    "orbit-diagram": ("Period doubling", "diagram"),
    "ball-diagram": ("Period doubling", "diagram"),
    "own-body": ("Suslov problem", "sphere"),
    "suslov-hess-accuracy": ("Two limit cycles", "precision"),
    "rotation-number-accuracy": ("One plateau", "trade"),
}
"""Scene → beginning of the name of an example, and its front picture."""
EDGE = 320
VIEWPORT = {"width": 560, "height": 680}
DURATION, FRAMES = 14.0, 70
SIDE = 400
SHOWN = ("sphere", "body")
"""Pictures of the first step of the introduction, from left to right."""
INSIDE = """name => {
  const plot = hess.plots.find(({ model }) => model.name === name)
  if (plot === undefined) return null
  const { x0, y0, width, height } = plot.frame.bbox
  const { left, top } = plot.el.getBoundingClientRect()
  return { x: left + x0, y: top + y0, width, height }
}"""
"""The rectangle inside the axes of a plot."""


def inside(page, name):
    """Return the rectangle of a picture without its axes and caption."""
    return page.evaluate(INSIDE, name) or page.locator(f".picture-{name} canvas").first.bounding_box()


def taken(page, base, name, theme):
    """Return the front picture of a scene, once all of it has been computed, as a square."""
    example, picture = FRONT[name]
    values = values_of(scenes()[name], example)
    parts = {"embed": "1", "pictures": picture, "controls": "none", "theme": theme}
    page.goto(f"{base}/?{urlencode({'scene': name, **values, **parts})}")
    wait_ready(page)
    # The page has taken its last size.
    page.wait_for_timeout(1000)
    shot = page.screenshot(clip=inside(page, picture))
    return Image.open(io.BytesIO(shot)).convert("RGB").resize((EDGE, EDGE), Image.Resampling.LANCZOS)


def motion(file):
    """Write the moving picture of the README, frame by frame as the export of films draws it."""
    whole = [Image.new("RGB", (SIDE * len(SHOWN), SIDE)) for _ in range(FRAMES)]
    for column, picture in enumerate(SHOWN):
        data = picture_data(urlencode({"scene": "suslov-hess", "swarm": 50, "span": DURATION}), picture)
        drawn = frames(data, FileRequest("webm", 60.0), np.linspace(0.0, DURATION, FRAMES))
        for image, png in zip(whole, drawn, strict=True):
            frame = Image.open(io.BytesIO(png)).convert("RGB")
            image.paste(frame.resize((SIDE, SIDE), Image.Resampling.LANCZOS), (SIDE * column, 0))
    lasting = [100] * (FRAMES - 1) + [1500]
    whole[0].save(file, save_all=True, append_images=whole[1:], duration=lasting, loop=0, quality=50, method=4)


def main(names):
    """Make the named pictures, or all."""
    if not names or "motion" in names:
        motion(README / "motion.webp")
    with (
        headless_browser() as browser,
        tempfile.TemporaryDirectory() as folder,
        server_process(Path(folder) / "server.log") as (_, base),
    ):
        for theme in ("light", "dark"):
            page = browser.new_page(viewport=VIEWPORT, color_scheme=theme, reduced_motion="reduce")
            look_inside(page)
            for name in FRONT if not names else FRONT.keys() & names:
                file = f"{Path(scenes()[name].module).stem.replace('_', '-')}-{theme}.jpg"
                taken(page, base, name, theme).save(STATIC / "thumbnails" / file, quality=82, optimize=True)
            page.close()
    if not names or "page" in names:
        page = Image.open(io.BytesIO(screenshot("scene=suslov-hess", (1600, 950)))).convert("RGB")
        # With a palette a quarter of the bytes, and no difference to the eye.
        page.quantize(128, dither=Image.Dither.NONE).save(README / "page.png", optimize=True)


if __name__ == "__main__":
    main(sys.argv[1:])
