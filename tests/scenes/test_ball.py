"""The scenes "Chaplygin ball" and "ball with a field": names and captions of the examples agree with the results.

The mechanics has tests of its own; first returns and where an orbit comes from are those of `eq29` by SciPy.
"""

from math import acos, atan2, copysign, cos, hypot, pi

import numpy as np
import pytest
from pytest import approx

from hess_explorer.scenes.framework.periodic_search import NONE
from support.ball import BALL, SECTION, angles, energy_of, first_returns, integrate, occupied, shown
from support.view import View, example


def xi_of(values):
    return np.array([values["I23"], -values["I13"]]) / hypot(values["I13"], values["I23"])


def circle_of(values, state):
    """The angle between ξ and γ."""
    xi = xi_of(values)
    return atan2(hypot(xi[0] * state[3] - xi[1] * state[2], state[4]), state[2:4] @ xi)


def ball(name):
    return example("chaplygin-ball", name)


every_ball = pytest.mark.parametrize("name", [one.name for one in BALL.presets])


# ---- the ball without a field -----------------------------------------------------------------------------------


@every_ball
def test_the_chosen_orbit_goes_from_its_circle_to_the_one_in_the_captions(name):
    view = ball(name)
    values, xi, states = view.values, xi_of(view.values), view.result.orbit.path.states
    start = states[0]
    assert energy_of(values, start) == approx(values["h"], rel=1e-12)
    # δ from the line, and, followed back, from the circle θ⁻.
    assert (xi[0] * start[1] - xi[1] * start[0]) / (xi @ start[:2]) == approx(10.0 ** -values["digits"], rel=1e-9)
    past = integrate(values, start, [-40.0])[-1]
    assert circle_of(values, past) == approx(values["theta"], abs=1e-7)
    left, joined = cos(values["theta"]), states[-1, 2:4] @ xi
    for picture, pattern in (("sphere", "Γ = # at the start, Γ = # at the end"), ("Gamma", "From # to #.")):
        assert view.numbers(picture, pattern) == [shown(left), approx(joined, abs=1e-4)]
    # And it has arrived there: ω at rest on Nˢ.
    assert xi @ states[-1, :2] < 0.0
    assert abs(xi[0] * states[-1, 1] - xi[1] * states[-1, 0]) < 1e-2
    circles = view.data["sphere"]["circles"]
    assert [circle[4] for circle in circles] == ["unstable", "stable"]
    for circle, height in zip(circles, (left, joined), strict=True):
        assert circle[:4] == approx([*xi, 0.0, height], abs=1e-5)


@every_ball
def test_theta_plus_over_the_phases_goes_through_the_orbit_and_its_range_is_that_of_the_caption(name):
    view = ball(name)
    values = view.values
    (phis,), (curve,) = (view.data["curve-ball"][key] for key in ("xs", "ys"))
    assert (phis[0], phis[-1], len(phis)) == (approx(-pi), approx(pi), 65)
    ring, end = view.data["curve-chosen"], circle_of(values, view.result.orbit.path.states[-1])
    assert (ring["x"][0], ring["y"][0]) == (values["phi"], approx(end, abs=4e-3))
    assert np.interp(values["phi"], phis, curve) == approx(end, abs=4e-3)
    assert view.numbers("curve", "θ⁻ = #:") == [shown(values["theta"])]
    if "for every φ" in view.text["curve"]:
        assert view.numbers("curve", "θ⁺ = # for every φ") * len(curve) == approx(curve, abs=6e-4)
    else:
        assert view.numbers("curve", "θ⁺ from # to #") == approx([curve.min(), curve.max()], abs=6e-4)


@pytest.mark.parametrize(
    "values", [{"D": 300.0, "digits": 10.0}, {"I13": 1e-3, "I23": 1e-3}, {"I13": 5e-324, "I23": -5e-324}], ids=str
)
def test_a_map_that_takes_long_is_left_out_and_the_page_says_so(values):
    view = View(BALL, values, refusing=True)
    if view.result.map is None:
        assert view.text["curve"].endswith("Omitted: too many steps.")
        (note,) = view.report.notes
        assert note.endswith("larger |I13| or |I23|, or a smaller 𝒟.")
        assert " ".join(view.data["curve-message"]["text"][0].split()) == note
        assert "curve-ball" not in view.data or not len(view.data["curve-ball"]["xs"])
    else:
        assert np.all(np.isfinite(view.result.map.theta_plus))
        # If only the draft is possible it stays, and the background's message becomes the note.
        assert view.result.map.phis.size == (33 if view.refused else 65)
        assert all(sentence.endswith("larger |I13| or |I23|, or a smaller 𝒟.") for sentence in view.refused)
    assert len(view.data["data-orbit"]["t"]) > 10


# ---- the ball with a field --------------------------------------------------------------------------------------


def field(name):
    return example("ball-section", name, refusing=True)


every_field = pytest.mark.parametrize("name", [one.name for one in SECTION.presets])
# A periodic orbit has another caption, and is held by "test_periodic.py" and "test_branched.py".
every_chosen_orbit = pytest.mark.parametrize(
    "name", [one.name for one in SECTION.presets if one.values.get("periodic", NONE) == NONE]
)


@every_field
def test_the_chosen_orbit_and_its_points_are_those_of_the_energy_in_the_caption(name):
    view = field(name)
    values, orbit = view.values, view.result.orbit.path
    E = values["h"] - hypot(values["b1"], values["b2"])
    assert view.numbers("omega", "E = #.") == [shown(E)]
    assert energy_of(values, orbit.states) == approx(np.full(len(orbit.times), E), abs=2e-6)
    start, closed = orbit.states[0], values["periodic"] != NONE
    # Next to the chosen place, or there.
    assert angles(start[None])[0] == approx((values["psi"], values["delta"]), abs=1e-4 if closed else 1e-12)
    assert 0.4 < np.max(np.abs(view.columns("data-orbit", "omega1", "omega2"))) / view.axes["omega"][1] < 1.0
    # A periodic orbit has marks of its own; where it is known at once, points of another one were never sent.
    own = view.points("own")
    if closed:
        assert not len(own)
        return
    # The first points of the chosen orbit, where all of them are shown.
    if values["drop"] == "all":
        assert own[:3] == approx(angles(first_returns(values, start, 3)), abs=1e-4)
    assert np.array_equal(view.columns("returns-own", "x", "y"), np.column_stack([own[:-1, 0], own[1:, 0]]))
    assert view.data["section-chosen"]["x"] == [values["psi"]]


@every_chosen_orbit
def test_the_numbers_in_the_caption_of_the_section_are_those_of_its_points(name):
    view = field(name)
    own = view.points("own")
    points, found, all_cells = view.numbers("section", "# points of the orbit in # of # cells")
    expected = view.values["count"] / (1 if view.values["drop"] == "all" else 2)
    assert (points, all_cells) == (len(own), 1024) == (expected, 1024)
    # In single precision a point may fall into the next cell.
    assert found == approx(len(occupied(own)), abs=2)
    kept = view.values["I13"] == view.values["I23"] == 0.0
    assert ("The flow preserves volume." in view.text["section"]) == kept
    assert len(view.data["section-others"]["x"]) == 20 * expected
    # Proved properties of the motion are stated for these bodies only.
    plain = kept and view.values["b3"] == 0.0
    symmetric = kept and view.values["I11"] == view.values["I22"] and view.values["b1"] == view.values["b2"] == 0.0
    said = view.text["returns"]
    assert (
        "A single point: every returning orbit is periodic. Proved by the symmetry γ₃ → −γ₃, t → −t" in said
    ) == plain
    assert ("A curve, because of an additional integral. ω₁γ₁ + ω₂γ₂ is constant." in said) == symmetric
    if symmetric:
        w1, w2, g1, g2, _ = view.result.orbit.path.states[0]
        assert view.quantities("ω₁γ₁ + ω₂γ₂ = #, an integral") == approx([w1 * g1 + w2 * g2], rel=6e-4)


@pytest.mark.parametrize("start", [0.05, 1.0, -2.0])
def test_where_the_energy_forbids_a_place_the_start_moves_to_the_edge_and_it_is_said(start):
    values = {**SECTION.defaults(), "h": 0.3, "psi": start}
    admitted, notes = SECTION.admit(values)
    # b = (½, 0, …): E = −0.2 forbids |ψ| < arccos(−0.4).
    half = acos(-0.4)
    if abs(start) < half:
        assert abs(admitted["psi"]) == approx(half, abs=5e-3)
        assert copysign(1.0, admitted["psi"]) == copysign(1.0, start)
        assert f"ψ = {start:g}".replace("-", "−") in notes[0]
    else:
        assert (admitted["psi"], notes) == (start, [])
    result = SECTION.compute(admitted, SECTION.pictures, False)
    assert np.all(np.cos(result.section.chosen_points[:, 0]) <= -0.4 + 1e-3)
    stage_view = View(SECTION, {"h": 0.3, "psi": 3.0})
    xs = np.array(stage_view.data["section-forbidden"]["xs"]).reshape(3, 4)
    assert sorted(xs[1, :2]) == approx([-half, half], abs=1e-6)


def test_a_section_that_takes_long_is_left_out_and_the_page_says_so(monkeypatch):
    monkeypatch.setattr("hess_explorer.scenes.ball_section._MOST_STEPS", 100)
    view = View(SECTION, {"psi": 1.2345, "count": 300.0})
    reason = (
        "The section is omitted, because 300 crossings take an orbit more than 100 steps here: choose fewer crossings."
    )
    assert view.report.notes == [reason]
    for picture in ("section", "returns"):
        assert view.text[picture].endswith("Omitted: too many steps.")
        assert " ".join(view.data[f"{picture}-message"]["text"][0].split()) == reason
        assert not len(view.data.get(f"{picture}-own", {}).get("x", ()))
    assert len(view.data["data-orbit"]["t"]) > 10
