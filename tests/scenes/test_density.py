"""The density of a section: its counts, its stages, window and colours."""

import numpy as np
import pytest
from pytest import approx

from hess_explorer.protocol.specs import points_of
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework import points
from hess_explorer.scenes.parts.sections import density
from hess_explorer.views.plane.density import tones
from hess_mechanics import section
from hess_mechanics.dynamics.return_map import section_crossings
from hess_mechanics.dynamics.section_density import visits
from support.deviations import deviations, mean_of
from support.view import View, values_of

SCENES = scenes()
SEA = values_of(SCENES["suslov"], "A chaotic sea")
WHOLE = ((-np.pi, 0.0), (np.pi, np.pi))
FEW = {"orbits": 4.0, "count": 20.0}


def shown(name, **values):
    """The section of a scene alone, with its density."""
    return View(SCENES[name], {"indicator": "density", **values}, seen=("section",), density=True)


def test_visits_are_the_histogram_of_the_accurate_crossings_of_a_regular_orbit():
    state = SCENES["ball-section"].compute(
        {**SCENES["ball-section"].defaults(), **values_of(SCENES["ball-section"], "Regular")}, (), False
    )
    found = visits(state.poincare, WHOLE, (32, 20), [state.chosen_start], 400, True, density._LEVEL)
    exact = section(state.poincare, state.chosen_start, state.poincare.surface, 1e5, "precise", 400)
    counted, _, _ = np.histogram2d(*state.poincare.points_of(exact.states).T, bins=(32, 20), range=np.transpose(WHOLE))
    assert found.counts.sum() == found.points == 400
    # One point in fifty at the edge of a cell may lie in the next one, as 400 points are computed at a coarser level.
    assert np.abs(found.counts - counted.T).sum() <= 2 * 400 / 50
    more = visits(state.poincare, WHOLE, (32, 20), found.ends, 400, True, density._LEVEL)
    assert np.array_equal(more.combine(found).counts, found.counts + more.counts)
    assert more.combine(found).points == 800


@pytest.mark.parametrize("name", ["suslov", "ball-section", "quartic", "euler-poisson"])
def test_a_section_fills_in_stages_and_says_its_number_of_crossings(name, monkeypatch):
    few = FEW if "orbits" in SCENES[name].defaults() else {"count": 50.0}
    for most, stages in ((5e3, 1), (3e4, 3)):
        monkeypatch.setattr(points, "_MOST", most)
        view = shown(name, **few)
        counts = np.sum(view.result.density.counts, axis=0)
        assert counts.sum() == 128 * 32 * (2**stages - 1)
        assert f"{counts.sum():,} points; " in view.text["section"]
        # Nothing but the counted pixels is coloured, nor are there other points but those of chosen orbits.
        drawn = [np.asarray(part["image"][0]) for key, part in view.data.items() if key.startswith("section-density")]
        assert np.array_equal(np.max(drawn, axis=0).reshape(counts.shape) > 0.0, counts > 0)
        assert not any(len(view.points(layer)) for layer in ("first", "second", "others"))
    assert np.isfinite(drawn).all()
    held = View(SCENES[name], {"indicator": "density", **few}, True, ("section",), density=True)
    assert held.result.density.tones == () and "; " not in held.text["section"].split("points")[0]


@pytest.mark.chaotic
def test_a_window_has_its_own_density_and_the_later_half_only_the_last_stage():
    window = "-0.5,0.5;1,1.5"
    view = shown("suslov", **{**SEA, **FEW, "window": window, "colours": "forward only"})
    low, high = np.array(points_of(window))
    found, state = view.result.density, view.result
    assert view.result.section.frame == tuple(map(tuple, (low, high)))
    shares = []
    for starts in (starts for _, starts in found._kinds):
        points = section_crossings(state.poincare, starts, 96, density._LEVEL)
        for spots in map(state.poincare.points_of, points.states):
            shares.append(np.mean(np.all((spots >= low) & (spots < high), axis=1)))
    # Orbits in a sea visit the window as often, though not at the same places after a while: both shares scatter.
    share = found.points / (96 * len(shares))
    assert abs(deviations(shares, share, mean_of(shares)[1])) < 5.0
    assert share < 0.5
    later = shown("suslov", **{**SEA, **FEW, "colours": "forward only", "drop": "the later half"})
    assert later.result.density.points == 128 * 64


def test_tones_grow_with_the_counts_and_share_the_colours():
    first, second = np.array([[0, 1, 10, 100, 50]]), np.array([[0, 0, 0, 0, 50]])
    below, above = (one[0] for one in tones((first, second)))
    assert below[0] == 0.0 and np.all(np.diff(below[:4]) > 0.0) and below[3] == 255.0
    assert np.array_equal(above > 0.0, second[0] > 0)
    assert above[4] == approx(0.5 * below[3], abs=1.0)
