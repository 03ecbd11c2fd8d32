"""Periodic orbits in the four scenes with a section: how long they are followed, their manifolds, what is said."""

from functools import cache
from math import pi

import numpy as np
import pytest
from pytest import approx

from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework import periodic_search
from hess_explorer.scenes.framework.periodic_search import NONE
from hess_explorer.scenes.framework.windows import pixels_in
from hess_explorer.views.layers import Axes
from hess_explorer.views.plane.periodic import visible_parts
from hess_mechanics.dynamics.periodic import difference
from support.view import FEW, View, values_of

NAMES = ("suslov", "quartic", "ball-section", "euler-poisson")
LIGHT = {
    "suslov": FEW,
    "quartic": {"count": 20.0},
    "ball-section": {"count": 20.0},
    "euler-poisson": FEW,
}
LAYERS = ("attracts", "neither", "repels", "stable-manifold", "unstable-manifold", "homoclinic")
PICTURES = {
    "suslov": ["section", "exponent", "sphere"],
    "quartic": ["section", "domain", "sphere"],
    "ball-section": ["section", "omega", "returns"],
    "euler-poisson": ["section", "exponent", "sphere"],
}


@cache
def shown(name, periodic, *given, is_preview=False):
    values = {**LIGHT[name], **dict(given), "periodic": periodic}
    return View(scenes()[name], values, seen=PICTURES[name], is_preview=is_preview)


def drawn(view):
    """Return the layers of a periodic orbit that have data."""
    return {name for name in LAYERS if any(map(len, view.data.get(f"section-{name}", {}).values()))}


def test_a_manifold_ends_where_the_map_jumps_and_no_line_is_drawn_across():
    view = shown("suslov", "any period")
    ends = [one for one in view.result.periodic_orbit.manifolds if "the map jumps" in one.end_reason]
    assert len(ends) == 4
    assert any("the map jumps: an orbit touches the plane of the section" in note for note in view.report.notes)
    pixel = 1.0 / max(pixels_in(view.result.section.frame))
    for curve in view.result.periodic_orbit.manifolds:
        # Chords of ten pixels at most: before, one of 1.7 led from the edge δ = π through the middle of the section.
        assert np.hypot(*np.diff(curve.points, axis=0).T).max() <= 10.0 * pixel * (1.0 + 1e-9)
    for curve in ends:
        # Further on by a hundredth of the return it is somewhere else.
        before, after = curve.point_at(curve.parameters[-1]), curve.point_at(curve.parameters[-1] + 0.01)
        assert difference(curve.turns, before, curve.points[-1]) == approx([0.0, 0.0], abs=1e-6)
        assert np.hypot(*difference(curve.turns, after, before)) > 0.2


def test_where_every_orbit_of_the_ball_closes_the_chosen_one_is_parabolic():
    given = {**values_of(scenes()["ball-section"], "Returning orbits"), **LIGHT["ball-section"]}
    view = shown("ball-section", "period 1", *given.items())
    assert view.verdict("section").startswith("Period 1, parabolic. Multipliers μ = 1, 1, error ")
    assert drawn(view) == {"neither"}
    assert view.points("neither") == approx(np.array([[view.values["psi"], view.values["delta"]]]), abs=1e-6)
    # It is followed by itself.
    returns = view.data["returns-own"]
    assert (np.asarray(returns["x"]), np.asarray(returns["y"])) == (approx([0.5]), approx([0.5]))


@pytest.mark.parametrize("name", NAMES)
def test_without_one_nothing_is_said_or_drawn_of_it(name):
    scene = scenes()[name]
    view = shown(name, NONE)
    assert drawn(view) == set()
    said = [*view.text.values(), *view.report.quantities, *view.report.notes, view.report.status]
    assert not any(word in text for text in said for word in ("Period ", "periodic orbit", "manifold:", "Newton"))
    assert scene.idle_values({**scene.defaults(), **LIGHT[name]})["reach"] == 5.0
    assert "reach" not in scene.idle_values({**scene.defaults(), "periodic": "period 1"})
    # An example has none, whatever was chosen before.
    assert all("periodic" in scene.example(one) for one in scene.presets)


def test_where_none_is_found_the_chosen_orbit_is_shown_and_why():
    view = shown("suslov", "period 3")
    assert view.verdict("section") == "No orbit of period 3 found near this point. The chosen orbit is shown."
    assert view.report.notes == [
        "Newton's method finds no orbit of period 3 from here: start closer to one, where an orbit comes back close to "
        "itself, or choose another period."
    ]
    assert drawn(view) == set()
    assert len(view.points("own")) == 20
    assert view.data["data-orbit"]["t"][-1] == approx(view.values["span"])
    assert view.verdict("exponent").startswith("λ = ")


def test_before_it_is_known_the_caption_says_so_and_the_chosen_orbit_is_shown():
    values = {**LIGHT["suslov"], "periodic": "period 1", "h": 1.0123, "reach": 0.0}
    view = View(scenes()["suslov"], values, seen=["section", "exponent"], whole=False)
    assert view.verdict("section") == "Searching for a periodic orbit."
    assert drawn(view) == set()
    assert view.verdict("exponent") == "Being computed."
    known = View(scenes()["suslov"], values, seen=["section", "exponent"])
    assert "Searching" not in known.text["section"]
    assert drawn(known)


def test_while_a_slider_is_held_it_follows_and_its_manifolds_come_later():
    view = shown("ball-section", "period 1", is_preview=True)
    assert view.verdict("section").startswith("Period 1, saddle. Multipliers μ = 2.19, 0.4566, error ")
    assert drawn(view) == {"repels"}
    assert "Its manifolds are computed when the slider is released." in view.report.quantities
    let_go = shown("ball-section", "period 1")
    assert not any("released" in line for line in let_go.report.quantities)
    assert "4 of 4 branches of its manifolds are drawn to length 5" in let_go.report.quantities


def test_a_branch_that_ends_early_says_why(monkeypatch):
    # Within this block only: what is computed with the small number stays in the cache, and other tests ask for the
    # usual length.
    with monkeypatch.context() as patch:
        patch.setattr(periodic_search, "_RETURNS", 1000)
        view = shown("ball-section", "period 1", ("reach", 30.0))
    assert view.report.notes[0] == "A branch of a manifold ends early. After 1000 returns of the map."
    assert "0 of 4 branches of its manifolds are drawn to length 30" in view.report.quantities
    assert not any("early" in note for note in shown("ball-section", "period 1").report.notes)


def test_a_curve_goes_round_an_angle():
    turn = 2.0 * pi
    x = np.linspace(2.0, 2.0 + 1.5 * turn, 400)
    curve = np.column_stack([x, np.sin(x)])
    axes = Axes((-pi, pi), (-1.0, 1.0))
    parts = visible_parts(curve, turn, axes)
    # From 2 on, once round, and a half turn to 2 + π.
    assert len(parts) == 3
    for part in parts:
        assert part[:, 1] == approx(np.sin(part[:, 0]), abs=1e-12)
        inner = part[1:-1, 0]
        assert np.all((inner >= -pi) & (inner <= pi))
    assert sum(map(len, parts)) >= len(curve)
