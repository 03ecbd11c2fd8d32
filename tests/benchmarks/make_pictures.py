"""`python tests/benchmarks/make_pictures.py`: the pictures of the README, into .github/pictures."""

from io import BytesIO
from pathlib import Path
from urllib.parse import urlencode

from PIL import Image

from hess_explorer.headless.screenshot import screenshot
from hess_explorer.scenes import scenes

FOLDER = Path(__file__).resolve().parents[2] / ".github" / "pictures"
PAGE, SMALL = (1600, 950), (1280, 720)
THUMBNAIL = (400, 225)


def save(picture, name, colours):
    """As PNG with a palette: a quarter of the bytes, and no difference to the eye."""
    picture.quantize(colours, dither=Image.Dither.NONE).save(FOLDER / f"{name}.png", optimize=True)


def taken(query, size):
    """The page in this state, as an RGB image."""
    return Image.open(BytesIO(screenshot(urlencode(query), size))).convert("RGB")


def main():
    """Save the page as it opens, and a thumbnail of every scene with its own pictures."""
    save(taken({"scene": "suslov-hess"}, PAGE), "page", 128)
    for scene in scenes().values():
        if scene.origin is None:
            save(taken({"scene": scene.name}, SMALL).resize(THUMBNAIL, Image.Resampling.LANCZOS), scene.name, 64)


if __name__ == "__main__":
    main()
