"""The scene of the Euler–Poisson sections: names and captions of the examples agree with the results.

The numbers are held against orbits that are followed for longer, and against the energy written out.
"""

import re
from math import remainder, sqrt

import numpy as np
import pytest
from pytest import approx

from hess_explorer.protocol.specs import places
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.periodic_search import NONE
from hess_mechanics import circle_map, f_max, level, lyapunov_spectrum
from hess_mechanics.dynamics.birkhoff import rotation_number
from hess_mechanics.dynamics.return_map import section_crossings
from hess_mechanics.errors import ModelError
from hess_mechanics.euler_poisson.andoyer import AndoyerSection, coordinates
from hess_mechanics.euler_poisson.hess_split import HessTorus, split_at
from hess_mechanics.numerics.accuracy import STANDARD
from support.andoyer import dense, energies_at
from support.deviations import deviations
from support.moved import from_moved_starts
from support.thorough import sample
from support.view import View, values_of

EP = scenes()["euler-poisson"]


class EulerPoisson(View):
    """View of this scene, with its body, energy and area constant."""

    def __init__(self, values, **options):
        super().__init__(EP, values, **options)
        self.body = self.result.body
        self.h, self.f = self.values["h"], self.values["f"]

    @property
    def start(self):
        """The state of the chosen orbit."""
        return AndoyerSection(self.body, self.h, self.f).state_at(*places(self.values["starts"])[-1])


def relation(view, points):
    """r·M over G at (l, L/G), from the place alone: its sign is the side, and on the Hess manifold it is 0."""
    l, x = points.T
    r1, _, r3 = view.body.r
    return r1 * np.sqrt(np.maximum(0.0, 1.0 - x * x)) * np.sin(l) + r3 * x


def places_from(view, start, count=3000):
    """The crossings of the orbit through (l, L/G)."""
    section = AndoyerSection(view.body, view.h, view.f)
    return coordinates(section_crossings(section, [section.state_at(*start)], count, STANDARD).states[0])


# ---- Examples ---------------------------------------------------------------------------------------------------


@pytest.mark.chaotic
@pytest.mark.parametrize(
    "preset",
    sample((one for one in EP.presets if one.values.get("periodic", NONE) == NONE), 4),
    ids=lambda preset: preset.name,
)
def test_an_example_shows_what_its_name_and_its_captions_promise(preset):
    view = EulerPoisson(preset.values, seen={"section", "exponent", "sphere"})
    assert view.report.notes == []
    kept, count = view.numbers("section", "keeps its sign along # of # orbits")
    assert count == view.values["orbits"]
    hess = view.values["away"] == 0.0
    assert view.body.is_hess is hess
    assert (kept == count) is hess
    # The colours are those of the starts: in the Hess case of every point.
    first, second, own = (view.points(layer) for layer in ("first", "second", "own"))
    assert len(first) + len(second) == count * view.values["count"]
    assert np.all(relation(view, first) >= -1e-6) == np.all(relation(view, second) <= 1e-6) == hess
    assert own[-int(view.values["count"]) :][:2] == approx(
        places_from(view, places(view.values["starts"])[-1], 2), abs=1e-4
    )
    # Statements about the exponent.
    exponent, spread, end = view.numbers("exponent", "λ = # ± # after t = #")
    assert end == view.values["long"]
    assert view.curve("exponent-lambda")[1][-1] == approx(exponent, rel=6e-3, abs=0.05 * spread)
    rates = from_moved_starts(lambda: lyapunov_spectrum(view.body, view.start, 2000.0).values[0])
    sure = deviations(rates, 0.015)
    assert abs(sure) > 5.0
    assert ("Looks chaotic." if sure > 0.0 else "Looks regular.") in view.text["exponent"]
    # The moving point of the section is that of the orbit.
    M_and_gamma = view.result.orbit.path.states
    assert view.columns("data-orbit", "l", "x") == approx(coordinates(M_and_gamma), abs=1e-5)


def test_at_the_meandering_torus_the_rotation_number_turns_round_at_an_eighth():
    view = EulerPoisson({**EP.presets[1].values, "orbits": 0.0}, seen={"rotation"})
    *_, rho, place = view.numbers("rotation", "No twist where ρ has an extremum. ρ from # to #, extremum # at #.")
    assert rho == approx(0.125, abs=1e-4)
    centre = view.result.rotation.ends[0]
    assert rotation_number(places_from(view, (place, centre[1])), centre)[0] == approx(0.125, abs=1e-5)


def test_the_green_curve_is_the_hess_manifold():
    view = EulerPoisson({"orbits": 0.0, "away": 0.3}, seen={"section"})
    assert np.max(np.abs(relation(view, view.points("curve")))) < 1e-6


def other_momenta(view, places):
    """Count the momenta with this energy at places (n, 2), by a dense search."""
    top = sqrt(2.0 * (view.h + view.body.strength) / min(view.body.a))
    return [
        np.count_nonzero(np.diff(np.sign(dense(view.body, view.f, float(l), float(x), top)[1] - view.h)))
        for l, x in places
    ]


@pytest.mark.chaotic
def test_points_on_another_sheet_are_drawn_apart():
    view = EulerPoisson({**values_of(EP, "Figure 14 c"), "orbits": 60.0, "count": 200.0}, seen={"section"})
    apart = view.points("elsewhere")
    everything = np.vstack([view.points("first"), view.points("second"), view.points("own")])
    few = len(apart) + 5.0 * sqrt(len(apart)) * np.array([-1.0, 1.0])
    assert np.all((few > 0.0) & (few < 0.02 * len(everything)))
    assert all(np.min(np.abs(everything - point).max(axis=1)) < 1e-6 for point in apart)
    # There another momentum has this energy as well; at most of the other points there is none.
    assert np.mean(np.array(other_momenta(view, apart[:20])) >= 2) > 0.9
    assert deviations(np.array(other_momenta(view, everything[::40])) >= 2, 0.35) < -5.0
    assert view.quantities("on another sheet: # points") == [len(apart)]


def test_on_a_small_sheet_another_start_is_found():
    """The chosen place is not on it: it is taken from those that fill the window, as few places are."""
    view = EulerPoisson(
        {**EP.presets[-1].values, "h": 0.2, "window": "", "count": 20.0, "sheet": "second G"},
        seen={"section"},
        noted=True,
    )
    assert re.search("no motion with this h and f crosses the second sheet", " ".join(view.report.notes))
    assert len(view.points("own")) == 20


def test_on_the_second_sheet_orbits_start_with_the_smaller_momentum():
    body = {"I1": 1.0, "I2": 1.5, "I3": 2.0, "m": -sqrt(0.5), "h": 0.5, "f": 0.3, "orbits": 8.0, "count": 30.0}
    largest, second = (
        EulerPoisson({**EP.presets[0].values, **body, "sheet": sheet}, seen={"section"})
        for sheet in ("largest G", "second G")
    )
    start = np.array(second.result.start)
    l, x = coordinates(start[None])[0]
    G = float(np.linalg.norm(start[:3]))
    assert second.h == approx(float(energies_at(second.body, 0.3, l, x, G)[0]), abs=1e-9)
    larger = AndoyerSection(second.body, 0.5, 0.3).state_at(float(l), float(x))
    assert np.linalg.norm(larger[:3]) > 1.01 * G
    # Nearly all of the section is grey then, as hardly any motion crosses that sheet.
    first, other = (np.mean(np.asarray(view.data["section-impossible"]["image"][0])) for view in (largest, second))
    assert first < 0.3
    assert other > 0.9


def test_where_there_is_no_second_sheet_that_is_said():
    with pytest.raises(ModelError, match=r"crosses the second sheet: choose the largest G"):
        _ = EP.of({**EP.defaults(), "sheet": "second G"}).clicks.picked


def test_curves_that_do_not_go_round_have_no_rotation_number():
    view = EulerPoisson({**values_of(EP, "Figure 13 b"), "orbits": 0.0}, seen={"rotation"})
    assert "No closed curve on the line rotates." in view.text["rotation"]
    assert len(view.data["rotation-orbits"]["x"]) == 0


# ---- What changes -----------------------------------------------------------------------------------------------


def test_a_drag_shows_the_section_at_once_with_fewer_orbits():
    view = EulerPoisson({"h": 41.37}, dragging=True, seen={"section", "exponent"})
    assert view.report.todo == ()
    assert 0 < len(view.points("first")) + len(view.points("second")) <= 16 * 40
    assert "released" in view.text["exponent"]


def test_while_epsilon_is_dragged_the_rotation_number_is_that_of_few_orbits_right_to_a_hundredth():
    values = {"away": 0.02, "orbits": 0.0}
    rest, held = (EulerPoisson(values, seen={"rotation"}, dragging=dragging) for dragging in (False, True))
    assert held.report.todo == ()
    (found, exact), (along, rho) = (view.columns("rotation-orbits", "x", "y").T for view in (rest, held))
    above = along > 0.6
    assert np.count_nonzero(above) >= 3
    apart = [remainder(y - np.interp(x, found, exact), 1.0) for x, y in zip(along[above], rho[above], strict=True)]
    assert np.max(np.abs(apart)) < 0.01


@pytest.mark.chaotic
def test_the_rotation_picture_says_of_all_the_line_what_its_orbits_are():
    view = EulerPoisson({"orbits": 0.0}, seen={"rotation"})
    low, high = view.numbers("rotation", "From # to #")
    # ½ is −½: the curve is not torn in two, and the axis is as high as it and 0.
    assert (-0.52 < low < -0.49) and (-0.3 < high < -0.27)
    seas = [np.asarray(part[0][0]) for part in view.data["rotation-sea"]["xs"]]
    covered = sum(float(np.ptp(part)) for part in seas)
    marked = len(view.data["rotation-orbits"]["x"]) + len(view.data["rotation-standing"]["x"])
    assert covered + 2.0 * marked / 48 == approx(2.0, abs=1e-6)
    assert np.all(view.data["rotation-standing"]["y"] == 0.0)


SECOND_SERIES = [one for one in EP.presets if one.name.startswith("Figure 14")]


@pytest.mark.parametrize("preset", SECOND_SERIES, ids=lambda one: one.name)
def test_what_an_example_of_the_second_series_says_of_the_hess_motion_is_so(preset):
    """By the circle map of the same torus: a1′ = a2, b = a2 μ|r|, h → a2 H/b, f → a2 F1/√b."""
    a2, b = 2.0 / 3.0, (2.0 / 3.0) * sqrt(0.5)
    h, f = a2 * preset.values["h"] / b, a2 * preset.values["f"] / sqrt(b)
    a = sqrt((1.0 - a2) * (a2 - 0.5)) / a2
    view = View(EP, preset.values, seen={"surface"})
    expected, torus = ("no Hess motion yet", "No torus.")
    if abs(f) <= f_max(h):
        expected, torus = {
            "elliptic": ("no limit cycles", "No limit cycle"),
            "hyperbolic": ("two limit cycles, two layers part", "Two limit cycles"),
        }[circle_map(a, h, f, level("precise")).kind]
        states = view.result.orbit.path.states
        off = np.max(np.abs(states[:, [0, 2]] @ np.array(view.result.body.r)[[0, 2]]))
        assert view.numbers("surface", "|r·M| up to #;")[0] == approx(off, rel=6e-3)
    assert preset.name.endswith(expected)
    assert view.text["surface"].split("\n")[1].startswith(torus)


@pytest.mark.parametrize("away", [0.0, 0.02])
def test_the_split_of_the_separatrices_is_0_in_the_hess_case_and_begins_in_proportion_to_epsilon(away):
    view = View(EP, {"orbits": 0.0, "count": 20.0, "long": 20.0, "away": away}, seen=["split"])
    torus = HessTorus((1.0, 0.625, 0.375), 9.975, 50.0, 5.0)
    exact = split_at(torus, away, level("reference"))
    slope, off = view.quantities("split/ε → # ± #")
    if away:
        value, error, l, shown = view.numbers(
            "split", "\nThe separatrices are split. By # ± # at l = #; as ε → 0: # ε."
        )
        found = view.result.split.split
        assert abs(found.value - exact.value) <= error + exact.error + 1e-8
        assert value == approx(found.value, rel=6e-4)
        assert value == approx(slope * away, rel=0.02)
        assert abs(value) > 1e3 * error
    else:
        error, l, shown = view.numbers(
            "split", "\nThe separatrices are not split. Less than # at l = #; as ε → 0: # ε."
        )
        assert abs(exact.value) <= error < 1e-9
    assert (l, shown) == (approx(exact.l, abs=1e-3), approx(slope, rel=1e-3))
    assert off < 1e-6
    drawn = view.data["split-splits"]
    assert np.interp(0.01, drawn["x"], drawn["y"]) == approx(0.01 * slope, rel=0.02)
    ((x, y),) = zip(*(view.data["split-here"][key] for key in "xy"), strict=True)
    assert (x, y) == (approx(away), approx(exact.value, abs=1e-8))


def test_where_there_are_no_separatrices_the_picture_says_why():
    view = View(EP, {"orbits": 0.0, "count": 20.0, "h": 5.0, "f": 0.8}, seen=["split"])
    assert view.text["split"].split("\n")[1] == "No separatrices are found here."
    assert "no limit cycles here" in view.data["split-message"]["text"][0].replace("\n", " ")
    assert "splits" not in " ".join(view.report.notes)
    # A split that is smaller than its error is not denied.
    view = View(EP, {"orbits": 0.0, "count": 20.0, "away": 1e-12}, seen=["split"])
    assert view.text["split"].split("\n")[1].startswith("No split is visible. Less than ")
