"""Pictures in files are those of the page, drawn again at the size of the file."""

import base64
import io
import re
from functools import cache
from html import unescape

import numpy as np
import pytest
from PIL import Image, ImageChops
from pytest import approx

from hess_explorer.__main__ import main
from hess_explorer.export.formats import FileRequest
from hess_explorer.export.picture_data import picture_data
from hess_explorer.headless import drawing
from hess_explorer.headless.browser import VARIABLE
from hess_explorer.headless.drawing import png_of
from hess_explorer.headless.file import content
from hess_explorer.offline.pages import state_page
from support.offline import opened

pytestmark = pytest.mark.usefixtures("browser")

LINK = "scene=suslov-hess&h=1.2&f=0.3&accuracy=draft&t=3&az=0.3&el=0.2"
CLOUD = "scene=singular-measures&points=1000&accuracy=draft&t=5"
# A body, a sphere, a torus; a cloud on the plane and on the sphere.
SOLIDS = [(LINK, "body"), (LINK, "sphere"), (LINK, "surface"), (CLOUD, "omega"), (CLOUD, "sphere")]
SHARP = 2.5
"""Pixels of a figure for each pixel of the page."""


def pixels(png):
    """The picture on white."""
    drawn = Image.open(io.BytesIO(png)).convert("RGBA")
    return Image.alpha_composite(Image.new("RGBA", drawn.size, "white"), drawn).convert("RGB")


def apart(one, other):
    """The mean difference of two pictures, of 255 levels."""
    return np.asarray(ImageChops.difference(one, other)).mean()


@pytest.mark.parametrize("link, picture", SOLIDS)
def test_a_file_is_the_canvas_of_the_page_at_the_same_size(link, picture, browser, tmp_path):
    path = tmp_path / "page.html"
    path.write_bytes(state_page(link, [picture])[1])
    # In this window an edge is a whole number of pixels of the screen: else both are blurred, and not alike.
    with opened(browser, path.as_uri(), (400, 700), device_scale_factor=SHARP) as page:
        canvas = page.locator(".host canvas").first
        edge = canvas.evaluate("canvas => canvas.clientWidth")
        # A sphere or torus has a second canvas for moving points; a screenshot may begin between two pixels.
        shown = Image.new("RGBA", (round(SHARP * edge),) * 2, "white")
        for url in page.locator(".host canvas").evaluate_all("all => all.map((one) => one.toDataURL())"):
            layer = Image.open(io.BytesIO(base64.b64decode(url.partition(",")[2]))).convert("RGBA")
            shown.alpha_composite(layer.resize(shown.size))
        shown = shown.convert("RGB")
    found = picture_data(link, picture)
    made = pixels(png_of(found, edge * 25.4 / 120.0))
    assert made.size == approx((SHARP * edge,) * 2, abs=1)
    shown = shown.resize(made.size)
    assert apart(made, shown) < 2.0
    # At another time, or from another side, it would be another picture.
    other = picture_data(link.replace("t=5", "t=1").replace("az=0.3", "az=1.5"), picture)
    assert apart(pixels(png_of(other, edge * 25.4 / 120.0)), shown) > 4.0 * apart(made, shown) + 0.2


def test_a_picture_has_300_dots_an_inch_its_metadata_and_in_black_no_colours():
    found = picture_data(LINK, "body")
    picture = Image.open(io.BytesIO(content(found, FileRequest("png", 60.0))))
    assert picture.size == (round(60 / 25.4 * 300),) * 2
    assert picture.info["dpi"] == approx((300, 300), abs=0.1)
    assert {name: picture.info[name] for name in found.texts} == found.texts
    black = np.asarray(pixels(content(found, FileRequest("png", 60.0, black=True))), int)
    assert np.ptp(black, axis=2).max() <= 2
    assert np.ptp(np.asarray(picture, int), axis=2).max() > 20


@pytest.mark.parametrize(
    "link, picture, names",
    [
        (LINK, "body", {"γ, gravity"}),
        (LINK, "sphere", {"γ₁", "γ₃"}),
        (CLOUD, "omega", {"ω₁", "ω₂", "−2", "2"}),
    ],
)
def test_vector_files_hold_an_image_and_names_axes_and_caption_as_text(link, picture, names):
    found = picture_data(link, picture)
    svg = content(found, FileRequest("svg", 60.0)).decode()
    words = [unescape(word) for word in re.findall(r"<text[^>]*>([^<]+)</text>", svg)]
    assert names | {found.title} <= set(words)
    assert found.caption.replace(" ", "") in "".join(words).replace(" ", "")
    assert found.link.replace("&", "&amp;") in svg
    # The image has its own pixels: 300 an inch.
    (image,) = re.findall(r"<image[^>]*>", svg)
    assert 'width="709"' in image
    assert len(svg) < 1_500_000
    assert re.search(rb"/Height 709\b", content(found, FileRequest("pdf", 60.0)))


def test_without_a_browser_a_sentence_says_what_to_do(monkeypatch, capsys, tmp_path):
    monkeypatch.setattr(drawing, "_studio", cache(drawing._Studio))
    monkeypatch.setenv(VARIABLE, "/nowhere/chrome")
    words = ["export", "--state", LINK, "--picture"]
    for picture, kind in (("body", "png"), ("omega", "mp4")):
        assert main([*words, picture, "--format", kind, "--out", str(tmp_path / f"x.{kind}")]) == 2
        assert f"{VARIABLE} names '/nowhere/chrome'" in capsys.readouterr().err
    assert main([*words, "circle", "--format", "png", "--out", str(tmp_path / "x.png")]) == 0
