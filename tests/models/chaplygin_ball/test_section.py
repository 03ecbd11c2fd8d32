"""The section of the ball with a field: its coordinates, its points, and the claims of the scene's examples."""

from math import cos, hypot, pi, sin

import numpy as np
from pytest import approx, mark, raises

from hess_explorer.scenes import scenes
from hess_mechanics import lyapunov_spectrum
from hess_mechanics.chaplygin_ball.ball_section import BallSection
from hess_mechanics.chaplygin_ball.equations import SYSTEM, BallBody
from hess_mechanics.dynamics.cells import occupied_cells
from hess_mechanics.dynamics.ensemble import ensemble
from hess_mechanics.dynamics.return_map import section_crossings
from hess_mechanics.dynamics.spectrum import lyapunov_exponent
from hess_mechanics.errors import OutsideRegion, WorkLimit
from support.ball import divergence, first_returns, occupied
from support.deviations import deviations
from support.mechanics import apart
from support.refusals import refused
from support.thorough import sample
from support.view import values_of

GENERAL = BallBody(1.5, 3.0, -0.3, 0.2, 1.0, 1.0, -0.7, 0.7)
PLAIN = BallBody(1.0, 3.0, 0.0, 0.0, 5.0, 0.5, 0.0, 0.8)
WHOLE = BallSection(PLAIN, 1.5)
bodies = mark.parametrize(
    "body",
    [GENERAL, BallBody(1.0, 2.0, 0.1, 0.2, 0.0, 0.0, 0.0, 1.0)],
    ids=["general", "no inner ball"],
)

SCENE = scenes()["ball-section"]


def example(name):
    """The ball of an example of the scene and its energy E, h above the lowest one of the plane γ3 = 0."""
    values = SCENE.defaults() | values_of(SCENE, name)
    body = BallBody(*(values[key] for key in ("I11", "I22", "I13", "I23", "D", "b1", "b2", "b3")))
    return body, values["h"] - hypot(body.b1, body.b2)


# ---- coordinates ------------------------------------------------------------------------------------------------


@bodies
def test_a_state_of_the_section_has_its_energy_and_its_coordinates(body):
    random = np.random.default_rng(1)
    for _ in range(50):
        E = random.uniform(0.1, 3.0) + hypot(body.b1, body.b2)
        psi, delta = random.uniform(-pi, pi), random.uniform(1e-6, pi - 1e-6)
        section = BallSection(body, E)
        state = section.state_at(psi, delta)
        assert SYSTEM.integrals(state, body.parameters) == approx({"E": E, "F1": 1.0}, rel=1e-13)
        w1, w2, g1, g2, g3 = state
        assert (g1, g2, g3) == approx((cos(psi), sin(psi), 0.0), abs=1e-15)
        # γ̇3 = γ1ω2 − γ2ω1 = |ω| sin δ.
        assert g1 * w2 - g2 * w1 == approx(hypot(w1, w2) * sin(delta), rel=1e-9)
        assert SYSTEM.field(state, body.parameters)[4] > 0.0
        assert section.points_of(np.array([state]))[0] == approx((psi, delta), abs=1e-9)


test_what_is_no_point_of_the_section_is_refused = refused(
    (lambda: WHOLE.state_at(0.0, pi), "No motion crosses the section", OutsideRegion),
    (lambda: BallSection(PLAIN, -0.5).forbidden, r"choose E above -0\.5", OutsideRegion),
    (lambda: section_crossings(WHOLE, WHOLE.spread(9), 40, "draft", max_steps=60), "more than 60 steps", WorkLimit),
)


@mark.parametrize(("angle", "share"), [(2.0, -0.5), (-3.0, 0.999)])
def test_the_forbidden_band_is_where_the_potential_exceeds_the_energy(angle, share):
    body = BallBody(1.0, 2.0, 0.3, 0.1, 1.0, 0.8 * cos(angle), 0.8 * sin(angle), -0.4)
    section = BallSection(body, 0.8 * share)
    middle, half = section.forbidden
    psi = np.linspace(-pi, pi, 500)
    forbidden = body.b1 * np.cos(psi) + body.b2 * np.sin(psi) > section.E
    assert np.array_equal(forbidden, apart(psi, middle) < half)
    with raises(OutsideRegion, match="a larger energy"):
        section.state_at(middle, 1.0)
    assert section.state_at(middle + half + 1e-3, 1.0)


@mark.parametrize("E", [-0.49, 0.499, 5.0])
def test_starts_cover_what_the_energy_allows(E):
    section = BallSection(PLAIN, E)
    found = np.array(section.spread(200))
    assert SYSTEM.integrals(found.T, PLAIN.parameters)["E"] == approx(E, abs=1e-13)
    psi, delta = section.points_of(found).T
    half = 0.0 if section.forbidden is None else section.forbidden[1]
    # PLAIN's b points to ψ = 0: so does the middle of the band.
    gaps = np.diff([half, *np.sort(np.mod(psi, 2.0 * pi)), 2.0 * pi - half])
    assert gaps.min() >= 0.0
    assert gaps.max() <= 4.0 * (2.0 * pi - 2.0 * half) / 200
    assert np.diff(np.sort(delta)).max() <= 4.0 * pi / 200


# ---- points -----------------------------------------------------------------------------------------------------


@bodies
def test_the_first_crossings_are_those_of_another_integrator(body):
    section = BallSection(body, 1.5)
    (start,) = section.spread(1)
    points = section_crossings(section, [start], 4, "precise").states[0]
    assert np.max(np.abs(points - first_returns(vars(body), start, 4))) <= 1e-7


# ---- what the examples are --------------------------------------------------------------------------------------


@mark.chaotic
def test_mixed_some_orbits_lie_on_curves_and_others_fill_a_sea():
    section = BallSection(*example("Mixed"))
    body, starts = section.body, section.spread(80)
    points = section_crossings(section, starts, 1200, "standard")
    assert max(points.drift.values()) <= 1e-4
    assert all(len(states) == 1200 for states in points.states)
    # A curve once round passes 32 cells or a few more.  An orbit of the sea may stay beside an island until the end.
    places = [section.points_of(states[600:]) for states in points.states]
    counts = np.array([len(occupied(one)) for one in places])
    assert counts.tolist() == [occupied_cells(one, section.window) for one in places]
    curve, sea = counts <= 80, counts >= 120
    assert deviations(curve, 0.2) > 5.0
    assert deviations(sea, 0.1) > 5.0
    exponents = np.array([lyapunov_spectrum(body, start, 1500.0).values[0] for start in starts])
    assert deviations(exponents[curve] < 0.006, 0.4) > 5.0
    assert deviations(exponents[sea] > 0.006, 0.4) > 5.0


@mark.chaotic
@mark.parametrize("name", sample(["Strange attractor", "A wider strange"], 1))
def test_on_an_attractor_neighbours_part_and_volume_shrinks(name):
    section = BallSection(*example(name))
    body, starts = section.body, section_crossings(section, section.spread(32), 200, "standard").states
    states = np.array([one[-1] for one in starts])
    along = ensemble(body, states, np.linspace(0.0, 1500.0, 6001)[1:], "draft").states
    # Both by far more than they scatter from start to start.
    assert deviations([divergence(body, orbit.T).mean() for orbit in along], 0.0) < -5.0
    assert deviations([lyapunov_exponent(body, state, 300.0).value for state in states], 0.01) > 5.0
