"""Colours: visible on both themes, equal in the browser, and a periodic colour scale for turns."""

import json
import re

import numpy as np
import pytest

from hess_explorer.page.description import describe
from hess_explorer.scenes import scenes
from hess_explorer.views import theme
from support.accessible import contrast, luminance, rgb
from support.mechanics import ROOT

LOOKS = ROOT / "static/pictures/looks.js"


@pytest.mark.parametrize("page", [0, 1], ids=["light", "dark"])
def test_lines_stand_out_and_what_is_impossible_is_quiet(page):
    shades = {name: pair[page] for name, pair in theme.SHADES.items()}
    behind = shades["paper"]
    assert contrast(shades["orbit"], behind) >= 4.5
    for name in ("stable", "unstable", "second", "muted"):
        assert contrast(shades[name], behind) >= 3.0, name
    assert contrast(shades["forbidden"], behind) < 1.5
    # Points and lines may lie on what is locked, and words on what is impossible.
    assert contrast(shades["ink"], shades["locked"]) >= 4.5
    assert contrast(shades["ink"], shades["forbidden"]) >= 4.5
    # On a dark page only markers of the orbit may be brighter than the orbit.
    assert page == 0 or all(
        luminance(shades[name]) < luminance(shades["orbit"]) for name in ("forbidden", "locked", "muted", "unstable")
    )


def test_the_browser_gets_its_shades_from_here():
    described = json.loads(describe(next(iter(scenes()))))
    assert described["shades"] == {name: list(pair) for name, pair in theme.SHADES.items()}
    script = LOOKS.read_text(encoding="utf-8")
    named = set(re.findall(r'look\("(\w+)"', script))
    assert {"orbit", "stable", "unstable", "second", "muted"} <= named <= theme.SHADES.keys()
    # It repeats none of them.
    assert not {colour for pair in theme.SHADES.values() for colour in pair} & set(re.findall(r"#[0-9A-F]{6}", script))


def test_the_scale_of_turns_ends_where_it_begins():
    scale = np.array([rgb(colour) for colour in theme.TURN_MAP])
    steps = np.linalg.norm(np.roll(scale, -1, axis=0) - scale, axis=1)
    assert len(scale) == 256
    # Across ±1/2 it goes on as elsewhere.
    assert steps[-1] <= 1.5 * np.median(steps)
    assert steps.max() < 0.03
    # Half a turn apart it differs clearly.
    assert np.linalg.norm(np.roll(scale, 128, axis=0) - scale, axis=1).min() > 0.4


# How eyes without one kind of cones mix linear red, green and blue (Machado, Oliveira and Fernandes 2009).
EYES = {
    "all cones": np.eye(3),
    "protan": [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
    "deutan": [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.01182, 0.04294, 0.968881]],
    "tritan": [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.3039]],
}
XYZ = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])


def lab(colour, eye):
    """CIELAB of a colour as an eye sees it."""
    parts = np.array([int(colour[i : i + 2], 16) / 255.0 for i in (1, 3, 5)])
    linear = np.where(parts <= 0.04045, parts / 12.92, ((parts + 0.055) / 1.055) ** 2.4)
    x, y, z = np.cbrt(XYZ @ np.clip(np.array(eye) @ linear, 0.0, 1.0) / XYZ.sum(axis=1))
    return np.array([116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)])


@pytest.mark.parametrize("eye", EYES.values(), ids=EYES)
def test_the_colour_blind_tell_the_basins_apart(eye):
    seen = [lab(colour, eye) for colour in (*theme.BASINS, theme.MUTED)]
    assert min(np.linalg.norm(a - b) for i, a in enumerate(seen) for b in seen[:i]) > 15.0


@pytest.mark.parametrize("page", [0, 1], ids=["light", "dark"])
@pytest.mark.parametrize("eye", EYES.values(), ids=EYES)
def test_the_colour_blind_tell_the_chosen_orbits_apart(eye, page):
    chosen = [theme.SHADES[f"chosen-{i}"][page] for i in range(len(theme.CHOSEN))]
    others = [theme.SHADES[name][page] for name in ("orbit", "unstable")]
    seen = [lab(colour, eye) for colour in (*chosen, *others)]
    assert min(np.linalg.norm(a - b) for i, a in enumerate(seen[:-2]) for b in (*seen[:i], *seen[-2:])) > 15.0
    assert min(contrast(colour, theme.SHADES["paper"][page]) for colour in chosen) >= 3.0
