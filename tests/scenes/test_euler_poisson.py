"""The scene of the Euler–Poisson sections: sheets, starts, and what is said where there is nothing to draw."""

import re
from math import sqrt

import numpy as np
import pytest
from pytest import approx

from hess_explorer.protocol.specs import points_of
from hess_explorer.scenes import scenes
from hess_mechanics.errors import ModelError
from hess_mechanics.euler_poisson.andoyer import AndoyerSection, coordinates
from support.andoyer import dense, energies_at
from support.deviations import deviations
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
        return AndoyerSection(self.body, self.h, self.f).state_at(*points_of(self.values["starts"])[-1])


# ---- Examples ---------------------------------------------------------------------------------------------------


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
        _ = EP.of({**EP.defaults(), "sheet": "second G"}).clicks.selection


def test_curves_that_do_not_go_round_have_no_rotation_number():
    view = EulerPoisson({**values_of(EP, "Figure 13 b"), "orbits": 0.0}, seen={"rotation"})
    assert "No closed curve on the line rotates." in view.text["rotation"]
    assert len(view.data["rotation-orbits"]["x"]) == 0


# ---- What changes -----------------------------------------------------------------------------------------------


def test_a_drag_shows_the_section_at_once_with_fewer_orbits():
    view = EulerPoisson({"h": 41.37}, is_preview=True, seen={"section", "exponent"})
    assert view.report.todo == ()
    assert 0 < len(view.points("first")) + len(view.points("second")) <= 16 * 40
    assert "released" in view.text["exponent"]


def test_where_there_are_no_separatrices_the_picture_says_why():
    view = View(EP, {"orbits": 0.0, "count": 20.0, "h": 5.0, "f": 0.8}, seen=["split"])
    assert view.verdict("split") == "No separatrices found here."
    assert "no limit cycles here" in view.data["split-message"]["text"][0].replace("\n", " ")
    assert "splits" not in " ".join(view.report.notes)
    # A split that is smaller than its error is not denied.
    view = View(EP, {"orbits": 0.0, "count": 20.0, "away": 1e-12}, seen=["split"])
    assert view.verdict("split").startswith("No separatrix splitting is visible. Less than ")
