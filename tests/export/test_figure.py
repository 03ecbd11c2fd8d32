"""Figures of plots for papers: text remains text, and metadata names the source."""

import io
import re
import xml.etree.ElementTree as ET
from math import nan

import numpy as np
import pytest
from PIL import Image
from pytest import approx

from hess_explorer.export.figure import as_file
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
