"""The scene of the Suslov–Hess case: the density over the circle map."""

import re
import sys
from fractions import Fraction
from math import copysign, hypot, pi

import numpy as np
import pytest
from pytest import approx

from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.hess_case import proved_statement
from hess_explorer.views.caption import Caption
from hess_explorer.views.maps.circle_map import UNIFORM_HEIGHT, caption
from hess_mechanics import circle_map, f_max
from hess_mechanics.numerics.accuracy import REFERENCE
from hess_mechanics.suslov_hess.bifurcation import curve_point
from hess_mechanics.suslov_hess.invariant_measure import density_on_torus, invariant_measure
from support.view import View

SCENE = scenes()["suslov-hess"]
SIDE = 2.0 * pi


@pytest.mark.parametrize("I23, h, f", [(0.3, -0.2, -0.7), (0.9, -0.5, 0.3)])
def test_the_curve_over_the_bottom_is_the_invariant_density(I23, h, f):
    view = View(SCENE, {"I22": 1.0, "I23": I23, "h": h, "f": f}, seen={"circle"})
    phi, height = view.curve("circle-density")
    density = (height + pi) / (SIDE * UNIFORM_HEIGHT * SIDE)
    measure = invariant_measure(circle_map(I23, h, f, REFERENCE))
    assert density == approx(measure.density(phi), rel=1e-4)
    assert view.quantities("ζ of the invariant density = #") == approx([measure.zeta], rel=1e-3)


def test_the_shade_of_the_torus_is_the_density_of_its_caption():
    I23, h, f = 0.9, -0.5, 0.3
    # A body of its own with this a, of which nothing is known yet.
    view = View(SCENE, {"I22": 2.0, "I23": 2.0 * I23, "h": h, "f": f}, seen={"torus"})
    (shade,) = view.data["torus-density"]["image"]
    least, most = view.numbers("torus", "The flow preserves this density. # to # times the uniform density")
    density = np.asarray(shade, float) * most
    assert (density.min(), density.mean()) == approx((least, 1.0), rel=6e-3)
    exact = density_on_torus(circle_map(I23, h, f, REFERENCE), REFERENCE, density.shape[::-1])
    assert density == approx(exact, rel=6e-3)


@pytest.mark.parametrize(
    "values, words",
    [
        ({"I23": 0.5, "h": 1.5, "f": 0.6}, "|trace| > 2: all motions but one tend to the stable limit cycle."),
        ({"I23": 0.5, "h": 0.5, "f": 1.01563456028796105}, "|trace| = 2: the two cycles have merged."),
        ({"I23": 0.0, "h": 1.5, "f": 0.0}, "|trace| = 2: every orbit is periodic."),
        ({"I23": 0.5, "h": 1.0, "f": 0.0}, "On the separatrix no motion returns."),
        ({"I23": 0.5, "h": 0.3, "f": 0.0}, "At f = 0 the angle φ jumps"),
        (
            {"I23": 0.5, **dict(zip("hf", curve_point(0.5), strict=True))},
            "On the bifurcation curve the torus is a circle.",
        ),
        ({"I23": 4.0, "h": 0.9, "f": 1e-9}, "The density lies almost on one line"),
    ],
)
def test_where_the_torus_has_no_density_the_reason_is_said(values, words):
    view = View(SCENE, {"I22": 1.0, **values}, seen={"torus"})
    assert f"\nNo density is drawn. {words}" in view.text["torus"]
    assert len(view.verdict("torus")) <= 110
    assert "image" not in view.data.get("torus-density", {})
    view.assert_finite()


@pytest.mark.parametrize("f", [0.6, -0.6])
def test_the_moving_point_is_in_the_ring_of_the_diagram_when_n3_turns_and_beyond_it_else(f):
    I22, I23 = 1.0, 0.5
    view = View(SCENE, {"I22": I22, "I23": I23, "h": 1.5, "f": f}, seen={"bifurcation", "omega"})
    orbit = {name: np.asarray(column, float) for name, column in view.data["data-orbit"].items()}
    n3 = (I22 * orbit["g3"] - I23 * orbit["g2"]) / hypot(I22, I23)
    # b = 1/√(I22² + I23²): the time in units b = 1.
    times = orbit["t"] / hypot(I22, I23) ** 0.5
    rate = np.gradient(n3, times)
    inner = slice(2, -2)
    assert orbit["reach"][inner] == approx(copysign(1.0, f) * np.hypot(f, rate)[inner], rel=0.02)
    assert np.all(np.abs(orbit["reach"]) >= abs(f) * (1.0 - 1e-6))
    turns = np.abs(rate) < 0.02
    assert turns.any()
    assert orbit["reach"][turns] == approx(f, rel=2e-3)
    assert np.max(np.abs(orbit["reach"])) > 1.5 * abs(f)


# ---- what is proved ---------------------------------------------------------------------------------------------


def ends(text):
    """The ends of the intervals in a text, exactly: doubles do not tell 1.9999999999999999996 from 2."""
    return [[Fraction(end.replace("−", "-")) for end in pair] for pair in re.findall(r"\[([^],]+),\s([^]]+)\]", text)]


@pytest.mark.parametrize(
    "I23, h, f", [(0.5, 1.5, 0.6), (0.1, 1.5, 0.6), (0.5, 0.5, 1.01563456028796105), (0.3, 0.2, 0.0)]
)
def test_the_caption_of_the_circle_map_says_what_is_proved_when_it_is_found(I23, h, f):
    # A body of its own with this a, of which nothing is known yet.
    values = {"I22": 2.0, "I23": 2.0 * I23, "h": h, "f": f}
    view = View(SCENE, values, seen={"circle"})
    assert any(task.function is proved_statement for task in view.first.todo)
    said = view.text["circle"]
    (sentence,) = (line for line in view.report.quantities if line.startswith("Proved"))
    theta = circle_map(I23, h, f, REFERENCE)
    for text, share in ((said, 2e-3), (sentence, 1e-8)):
        if theta.kind == "hyperbolic":
            assert "exactly two cycles" in text
            known = sorted(point.multiplier for point in theta.fixed_points)
        else:
            assert "no cycle" in text
            known = [theta.trace]
            assert ends(text)[0][1] < 2.0
        for (low, high), number in zip(ends(text), known, strict=True):
            assert low - 1e-12 * low <= number <= high + 1e-12 * high
            assert high - low <= share * high
    # While a slider is held nothing is proved.
    held = View(SCENE, values, seen={"circle"}, is_preview=True)
    assert not any(task.function is proved_statement for task in held.report.todo)
    assert "Proved" not in held.text["circle"]


def test_what_is_not_proved_is_said():
    """a = 0, f = 0 has trace 2; beyond the edge by 1e-16 no motion has exactly the numbers in the boxes."""
    for values, words in (
        ({"I22": 1.0, "I23": 0.0, "h": 2.0, "f": 0.0}, "Undecided at 256 bits: the intervals do not tell"),
        ({"I22": 1.0, "I23": 0.5, "h": 0.5, "f": f_max(0.5)}, "Not proved: No motion has exactly"),
    ):
        view = View(SCENE, values, seen={"circle"})
        assert any(line.startswith(words) for line in view.report.quantities), view.report.quantities


def test_without_the_library_one_quiet_sentence_says_so(monkeypatch):
    monkeypatch.setitem(sys.modules, "flint", None)
    view = View(SCENE, {"h": 1.45}, seen={"circle"})
    assert view.first.todo == ()
    assert [line for line in view.report.quantities if "python-flint" in line] == [
        "Proofs need python-flint: pip install 'hess-explorer[prove]'"
    ]
    assert "roved" not in view.text["circle"]


def test_on_the_edge_the_caption_says_that_there_is_no_torus_and_names_no_cycle():
    """h = 13/8, f = 15/8 are decimals, and exactly on the edge; doubles alone find two fixed points of a map there."""
    theta = circle_map(0.5, 1.625, 1.875, REFERENCE)
    assert theta.kind == "hyperbolic"
    found = proved_statement(1.0, 0.5, 1.625, 1.875)
    assert caption(theta, found.badge) == Caption(numbers=found.badge)
    assert found.badge == "Proved: no torus, but a circle with n₃ constant: two equilibria."
    assert "exactly two equilibria" in found.sentence
    assert "one periodic orbit" in proved_statement(1.0, 0.1, 1.625, 1.875).badge
