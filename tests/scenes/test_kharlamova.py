"""The scenes "principal axis, b3 = 0" and "b1 = b2 = 0": kinds of motions, starts at the edge, clicks."""

from math import sqrt

import numpy as np
import pytest
from pytest import approx

from hess_explorer.scenes import scenes
from support.view import View

ARC, POINT = scenes()["kharlamova"], scenes()["quartic"]


@pytest.mark.parametrize("preset", ARC.presets, ids=lambda preset: preset.name)
def test_an_example_of_b3_0_is_what_its_name_says(preset):
    view = View(ARC, preset.values)
    found, states, body = view.result.arc, view.result.orbit.states, view.result.body
    kind = preset.name.split()[0].rstrip(":").lower()
    assert found.kind == {"near": "periodic"}.get(kind, kind)
    in_plane = np.column_stack([sqrt(body.I11) * states[:, 3], -sqrt(body.I22) * states[:, 2]])
    assert view.columns("data-orbit", "q1", "q2") == approx(in_plane, abs=2e-6)
    if found.kind == "periodic":
        (shown,) = view.numbers("domain", "back and forth. T = #.")
        period, missed = view.numbers(
            "period", "T = # in this direction. After T the orbit returns to its start within #."
        )
        assert shown == period == approx(found.period, rel=6e-4)
        assert missed <= 1e-6
    elif found.kind == "asymptotic":
        assert "T = ∞" in view.text["period"]
        assert np.ptp(states[-2:], axis=0).max() < 1e-3
    else:
        assert np.ptp(states, axis=0) == approx(np.zeros(5), abs=1e-12)
        assert ("unstable" in view.text["domain"]) is ("unstable" in preset.name)


def test_a_start_outside_moves_to_the_edge_and_says_so():
    values, notes = ARC.admit({**ARC.defaults(), "q1": 3.0, "q2": 0.0})
    assert values["q1"] == approx(sqrt(1.5))
    assert "outside the ellipse" in notes[0]
    assert ARC.compute(values, ARC.pictures, False).start[4] == 0.0
    values, notes = POINT.admit({**POINT.defaults(), "h": 2.0, "Q1": 0.1, "Q2": 0.0})
    assert "moved to the edge" in notes[0]
    assert POINT.compute(values, (), False).start[4] == approx(1.0, abs=1e-6)


@pytest.mark.chaotic
@pytest.mark.parametrize("name", ["quartic", "ball-section"])
def test_at_first_a_section_has_the_beginnings_of_all_its_orbits(name):
    values = {"count": 45.0, "h": 0.83}
    view = View(scenes()[name], values)
    first, whole = view.begun, view.result
    # All crossings; and a second run of both, for how many of them are right.
    assert (len(view.first.todo), first.section.points().shape, view.first.total) == (3, (20 * 30, 2), 3)
    assert (view.report.todo, view.report.total) == ((), 3)
    # Later a chaotic orbit shows that its steps were others.
    begun = first.section.points().reshape(20, 30, 2)[:, :8]
    assert whole.section.points().reshape(20, 45, 2)[:, :8] == approx(begun, abs=1e-5)
    # The chosen orbit is there at once.
    assert len(first.section.chosen_points) == 45
    held = View(scenes()[name], values, is_preview=True)
    assert (held.report.todo, len(held.result.section.chosen_points)) == ((), 30)
    # At the draft, whose first points are the same to the eye, but for an orbit or two that part fast.
    drawn = held.result.section.points().reshape(20, 30, 2)[:, :3]
    assert np.sort(np.abs(drawn - begun[:, :3]).max(axis=(1, 2)))[-3] < 1e-3


def test_a_click_chooses_where_the_orbit_starts():
    view = View(POINT, {})
    assert view.stage.pick("domain", 0.5, -0.25) == {"Q1": 0.5, "Q2": -0.25}
    picked = view.stage.pick("section", 0.7, 0.3)
    again = View(POINT, picked)
    places, _ = again.result.body.to_plane(np.array([again.result.start]))
    assert places[0] == approx((0.0, 0.7), abs=1e-12)
    assert again.result.start[3] == approx(0.3, abs=1e-12)
    # Grey: nothing.
    assert view.stage.pick("section", 0.0, 1.0) == {}
    assert View(ARC, {}).stage.pick("period", 1.0, 5.0) == {"alpha": 1.0}
