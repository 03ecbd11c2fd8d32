"""Figures for papers: lines match the data, text remains text, and metadata names the source."""

import io
import re
import xml.etree.ElementTree as ET
from math import cos, nan, pi, sin

import numpy as np
import pytest
from hess_explorer.export.sphere_canvas import seen
from PIL import Image
from pytest import approx
from scipy.spatial.transform import Rotation

from hess_explorer.export.figure import as_file
from hess_explorer.export.picture_data import picture_data
from hess_mechanics.errors import ModelError

DRAFT = "accuracy=draft"
# Lines, cells, a sphere, points.
SEVERAL = [("", "bifurcation"), ("", "sphere"), ("scene=scattering", "map"), ("scene=free-suslov", "omega")]


@pytest.mark.parametrize("link, picture", SEVERAL)
def test_text_stays_text_and_the_file_says_link_and_version(link, picture):
    found = picture_data(f"{link}&{DRAFT}", picture)
    svg = as_file(found, "svg")
    assert ET.fromstring(svg).tag.endswith("svg")
    text = svg.decode()
    assert found.facts["program"] in text
    assert found.link.replace("&", "&amp;") in text
    words = re.findall(r"<text[^>]*>([^<]+)</text>", text)
    names = getattr(found.picture, "axes", ("γ₁", "γ₂"))
    names = names(found.state) if callable(names) else names
    assert set(names) <= set(words)


def test_the_size_is_that_asked_for_and_black_has_no_colours():
    found = picture_data(DRAFT, "bifurcation")
    for black in (False, True):
        picture = Image.open(io.BytesIO(as_file(found, "png", 50.0, black)))
        assert picture.size == approx((50 / 25.4 * 300, 50 / 25.4 * 300), abs=1)
        red, green, blue = np.asarray(picture.convert("RGB"), float).reshape(-1, 3).T
        # The cells of ρ are grey or coloured as on the page: only what is drawn about them is black.
        locked = (np.abs(red - 0xB9) < 3) & (np.abs(green - 0xA7) < 3) & (np.abs(blue - 0xD6) < 3)
        assert (np.mean(locked) > 0.05) is not black
    assert as_file(found, "pdf").startswith(b"%PDF")
    assert "hess-explorer" in picture.info["Software"]
    assert found.link in picture.info["Description"]


@pytest.mark.parametrize("azimuth, elevation", [(0.6, 0.35), (-2.0, -1.1), (0.0, pi / 2)])
def test_a_sphere_is_seen_from_where_the_link_says(azimuth, elevation):
    eye = np.array([cos(elevation) * cos(azimuth), cos(elevation) * sin(azimuth), sin(elevation)])
    assert seen(eye[None], azimuth, elevation)[0] == approx([0.0, 0.0, 1.0], abs=1e-15)
    points = np.random.default_rng(1).normal(size=(20, 3))
    # Right, up, towards the eye: turned by the azimuth, then by the elevation, and the axes renamed.
    turned = Rotation.from_euler("zy", [-azimuth, elevation]).apply(points)
    assert seen(points, azimuth, elevation) == approx(turned[:, [1, 2, 0]], abs=1e-14)


def test_what_cannot_be_made_is_refused_with_a_sentence(monkeypatch):
    circle = picture_data(DRAFT, "circle")
    for wrong in (0.0, 19.9, 401.0, nan):
        with pytest.raises(ModelError, match="20 to 400 mm wide"):
            as_file(circle, "svg", wrong)
    with pytest.raises(ModelError, match="choose one of png, svg, pdf"):
        as_file(circle, "gif")
    monkeypatch.setitem(__import__("sys").modules, "matplotlib", None)
    with pytest.raises(ModelError, match=r"pip install 'hess-explorer\[export\]'"):
        as_file(circle, "svg")
