"""Figures of plots for papers: text remains text, and metadata names the source."""

import io
import re
import xml.etree.ElementTree as ET
from math import nan

import numpy as np
import pytest
from PIL import Image
from pytest import approx

from hess_explorer.export.figure import as_figure, as_file
from hess_explorer.export.formats import FileRequest
from hess_explorer.export.picture_data import picture_data
from hess_mechanics.errors import ModelError

DRAFT = "accuracy=draft"
# Lines, cells, points of a cloud at the time of the link.
SEVERAL = [("", "bifurcation"), ("scene=scattering", "map"), ("scene=singular-measures&points=1000&t=5", "density")]


@pytest.mark.parametrize("link, picture", SEVERAL)
def test_text_stays_text_and_the_file_says_link_and_version(link, picture):
    found = picture_data(f"{link}&{DRAFT}", picture)
    svg = as_file(found, FileRequest("svg"))
    assert ET.fromstring(svg).tag.endswith("svg")
    text = svg.decode()
    assert found.facts["program"] in text
    assert found.link.replace("&", "&amp;") in text
    words = re.findall(r"<text[^>]*>([^<]+)</text>", text)
    assert set(found.picture.names(found.state)) <= set(words)


@pytest.mark.parametrize("width", [60.0, 85.0, 180.0])
@pytest.mark.parametrize("picture", ["omega", "circle", "bifurcation"])
def test_labels_stay_inside_their_frame_and_off_markers(picture, width):
    figure = as_figure(picture_data(DRAFT, picture), width)
    figure.draw_without_rendering()
    (axes,) = figure.axes
    labels = [text for text in axes.texts if text.get_visible() and text.get_fontweight() == "bold"]
    assert len(labels) >= 2
    frame = axes.get_window_extent()
    markers = [path for path in axes.collections if type(path).__name__ == "PathCollection"]
    places = [
        (axes.transData.transform(one.get_offsets()), one.get_sizes()[0] ** 0.5 / 144.0 * figure.dpi) for one in markers
    ]
    for label in labels:
        box = label.get_window_extent()
        assert frame.x0 <= box.x0 and box.x1 <= frame.x1 and frame.y0 <= box.y0 and box.y1 <= frame.y1, label
        for (x, y), radius in ((place, radius) for found, radius in places for place in found):
            away = np.hypot(max(box.x0 - x, 0.0, x - box.x1), max(box.y0 - y, 0.0, y - box.y1))
            assert away >= 0.9 * radius, label


def test_the_size_is_that_asked_for_and_black_has_no_colours():
    found = picture_data(DRAFT, "bifurcation")
    for black in (False, True):
        picture = Image.open(io.BytesIO(as_file(found, FileRequest("png", 50.0, black))))
        assert picture.size == approx((50 / 25.4 * 300, 50 / 25.4 * 300), abs=1)
        red, green, blue = np.asarray(picture.convert("RGB"), float).reshape(-1, 3).T
        # The cells of ρ are grey or coloured as on the page: only what is drawn about them is black.
        locked = (np.abs(red - 0xB9) < 3) & (np.abs(green - 0xA7) < 3) & (np.abs(blue - 0xD6) < 3)
        assert (np.mean(locked) > 0.05) is not black
    assert as_file(found, FileRequest("pdf")).startswith(b"%PDF")
    assert "hess-explorer" in picture.info["Software"]
    assert found.link in picture.info["Description"]


def test_what_cannot_be_made_is_refused_with_a_sentence(monkeypatch):
    circle = picture_data(DRAFT, "circle")
    for wrong in (19.9, 401.0, nan):
        with pytest.raises(ModelError, match="20 to 400 mm wide"):
            as_file(circle, FileRequest("svg", wrong))
    monkeypatch.setitem(__import__("sys").modules, "matplotlib", None)
    with pytest.raises(ModelError, match=r"pip install 'hess-explorer\[export\]'"):
        as_file(circle, FileRequest("svg"))
