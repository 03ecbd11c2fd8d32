"""The pictures of the Suslov–Hess scene: their data and captions."""

import re
from functools import cache
from math import pi
from types import SimpleNamespace

import numpy as np
import pytest
from pytest import approx

from hess_explorer.scenes import scenes
from hess_mechanics import circle_map, level, turning_points
from support.mechanics import angle_between
from support.suslov_hess import assert_orbit
from support.thorough import sample
from support.view import View

SCENE = scenes()["suslov-hess"]
DEFAULTS = SCENE.defaults()
REFERENCE = level("reference")
PRESETS = {preset.name: {**DEFAULTS, **preset.values} for preset in SCENE.presets}
a = DEFAULTS["I23"] / DEFAULTS["I22"]


@cache
def first():
    """The scene in its first state, h = 1.5, f = 0.6."""
    return View(SCENE, DEFAULTS)


def numbers_in(text):
    return [float(number.replace("−", "-")) for number in re.findall(r"−?\d+(?:\.\d+)?(?:e−?\d+)?", text)]


def caption_numbers(view, words):
    """Return the numbers after these words in the caption of the circle map, without those of a proof."""
    caption = re.split(r", multipliers in \[|, \|trace\| in \[|Proved: no torus", view.text["circle"])[0]
    assert words in caption, caption
    return numbers_in(caption.split(words, 1)[1])


def proved(view, words):
    """Intervals [(low, high)] after these words in what the caption of the circle map says is proved."""
    said = view.text["circle"].split("Proved:")[1]
    assert words in said, said
    return [tuple(numbers_in(interval)) for interval in re.findall(r"\[[^]]*\]", said.split(words, 1)[1])]


@pytest.mark.parametrize("name", sample(PRESETS, 5))
def test_an_example_is_the_one_of_the_equations_with_the_right_numbers(name):
    values = PRESETS[name]
    h, f = values["h"], values["f"]
    view = View(SCENE, values, noted=True)
    assert numbers_in(view.text["bifurcation"])[:2] == approx([h, f], rel=6e-4, abs=1e-12)
    here = view.data["bifurcation-here"]
    assert_orbit(SimpleNamespace(data=view.data.get, here=lambda: (here["h"][0], here["f"][0])), values)
    if name.startswith("Separatrix"):
        assert "no return" in view.text["circle"]
        return
    # Two turning points that are the same are said once.
    heights = numbers_in(view.text["sphere"].replace("n₃", ""))
    assert (2 * heights)[-2:] == approx(turning_points(h, f).roots[1:], rel=6e-4)
    exact = circle_map(values["I23"] / values["I22"], h, f, REFERENCE)
    assert caption_numbers(view, "ρ =")[0] == approx(exact.rotation_number, rel=6e-4, abs=1e-4)
    if exact.kind != "hyperbolic":
        ((low, high),) = proved(view, "no cycle")
        # Both in four digits or more, and the map in doubles.
        assert low - 1e-10 <= exact.trace <= high + 1e-10
        assert high - low <= 2e-3 * high
        return
    trace = caption_numbers(view, "|trace| =")[0]
    assert trace == approx(exact.trace, rel=6e-4)
    for point, (low, high) in zip(exact.fixed_points, proved(view, "exactly two cycles"), strict=True):
        assert low - 1e-10 * high <= point.multiplier <= high * (1.0 + 1e-10)
        assert low < high <= (1.0 + 1e-3) * low


@pytest.mark.parametrize(
    "says, values",
    [
        ("Two limit cycles on the torus.", {}),
        ("No limit cycle on the torus.", {"h": 0.2, "f": 0.5}),
        ("The two cycles have merged.", PRESETS["At the lock boundary (a = 0.5)"]),
        ("Bifurcation curve: the torus is a circle.", PRESETS["On the bifurcation curve"]),
        ("f = 0: the centre is a circle.", {"h": 0.3, "f": 0.0}),
        ("Separatrix: the centre is the upper equilibrium.", {"h": 1.0, "f": 0.0}),
    ],
)
def test_the_torus_in_space_says_what_it_is_and_its_curves_lie_on_it(says, values):
    values = {**DEFAULTS, **values, "shade": "invariant density"}
    view, h, f = View(SCENE, values), values["h"], values["f"]
    assert view.text["surface"].split("\n")[1].startswith(says)
    elliptic = says.startswith("No limit cycle")
    assert ("No density." in view.text["surface"]) is not elliptic
    assert ("re" in view.data["surface"]) is elliptic
    names = [one for one in ("orbit", "stable", "unstable") if view.data.get(f"surface-{one}")]
    assert len(names) == (3 if says.startswith("Two") else 1)
    largest, surface = 2.0 * (h + 1.0), view.data["surface"]
    curves = [view.columns(f"surface-{one}", *"xyz").T for one in names]
    for x, y, z in [*curves, (surface["radius"], 0.0, surface["height"])]:
        square = largest * (np.square(x) + np.square(y))
        rise = largest * np.asarray(z)
        assert rise**2 + f**2 == approx(square * (1.0 - (0.5 * square - h) ** 2), abs=2e-5 * largest)
    # The centre is reached where the caption speaks of it.
    assert bool(surface["radius"][0] < 1e-6) is ("centre" in says)


def test_the_graph_and_the_cobweb_of_the_circle_map_are_those_of_the_map():
    cobweb, map_ = first().data["circle-cobweb"], first().result.map
    phi, theta = (first().data["circle-map"][axis][0].astype(float) for axis in ("xs", "ys"))
    assert phi[[0, -1]] == approx([-pi, pi], abs=1e-5)
    assert np.all(np.diff(phi) >= 0)
    # One turn of Θ for one turn of φ, without a jump.
    assert theta[-1] - theta[0] == approx(2 * pi, abs=1e-5)
    assert np.max(np.abs(np.diff(theta))) < 0.1
    assert angle_between(theta, map_.theta(phi)) < 2e-5
    x, y = np.array(cobweb["phi"]), np.array(cobweb["theta"])
    assert np.all((np.diff(x) == 0) | (np.diff(y) == 0))
    iterates = y[::2]
    assert iterates[0] == approx(0.5, abs=1e-6)
    assert iterates.size >= 10
    assert angle_between(iterates[1:], map_.theta(iterates[:-1])) < 2e-5
