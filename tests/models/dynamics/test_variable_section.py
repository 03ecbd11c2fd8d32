"""Sections of a system given by its field alone: Hénon–Heiles, and the tools that take a return map."""

import numpy as np
from pytest import approx, fixture, mark, raises
from scipy.integrate import quad, solve_ivp

from hess_mechanics import (
    System,
    continued_orbit,
    lyapunov_spectrum,
    manifold,
    orbit_diagram,
    periodic_orbit,
    return_map,
    section,
    section_orbits,
    tube,
)  # fmt: skip
from hess_mechanics.dynamics.section import AnglePlane
from hess_mechanics.errors import InvalidParameter

E = 1 / 12
SYSTEM = System(
    "henon-heiles",
    lambda y, p: (y[2], y[3], -y[0] - 2 * p[0] * y[0] * y[1], -y[1] - p[0] * (y[0] ** 2 - y[1] ** 2)),
    "x y px py",
    {"lam": 1.0},
    example=(0.0, 0.1, 0.35, 0.2),
    integrals=lambda y, p: {
        "E": (y[0] ** 2 + y[1] ** 2 + y[2] ** 2 + y[3] ** 2) / 2 + p[0] * (y[0] ** 2 * y[1] - y[1] ** 3 / 3)
    },
)
DRIVEN = System(
    "driven-pendulum",
    lambda y, p: (y[1], -np.sin(y[0]) - p[0] * y[1] + p[1] * np.cos(y[2]), p[2]),
    "theta v phase",
    {"friction": 0.2, "force": 0.5, "W": 0.7},
    example=(0.3, 0.0, 0.0),
    angles="theta phase",
)


@fixture(scope="module")
def returns():
    return return_map(SYSTEM.at(), E=E)


def test_a_section_has_defaults(returns):
    section = returns.section
    assert (section.names, section.solved, section.surface.normal) == (("y", "py"), ("px",), (1.0, 0.0, 0.0, 0.0))
    assert dict(section.constants) == {"lam": 1.0, "E": E}
    assert section.moved("lam", 0.5).parameters == (0.5,)
    states, there = section.states_at(np.array([0.1, 0.2, 0.9]), np.array([0.05, 0.0, 0.5]))
    assert there.tolist() == [True, True, False]
    x, y, px, py = states[0]
    assert (x, y, py) == (0.0, 0.1, 0.05)
    assert px == approx(np.sqrt(2 * E - y**2 - py**2 + 2 * y**3 / 3), rel=1e-14)
    assert section.places_of(states)[1].tolist() == [0.2, 0.0]
    free = return_map(DRIVEN.at(), surface=("v", 1.0))
    assert (free.names, free.section.solved) == (("theta", "phase"), ())


def test_the_image_of_a_place_is_the_next_crossing_by_another_integrator(returns):
    start = returns.state_at(np.array([0.1, 0.05]))

    def height(_, y):
        return y[0]

    height.direction = 1
    found = solve_ivp(
        lambda _, y: SYSTEM.field(y, (1.0,)), (0.0, 20.0), start, "DOP853", events=height, rtol=1e-13, atol=1e-13
    )
    crossing = next(y for t, y in zip(found.t_events[0], found.y_events[0], strict=True) if t > 1.0)
    assert returns.image((0.1, 0.05)) == approx(crossing[[1, 3]], abs=1e-10)


def test_a_straight_orbit_is_found_and_continued(returns):
    """On the straight orbits y = ±x/√3 through the origin py² is a quarter of p²: py = √(E/2) there."""
    orbit = periodic_orbit(returns, (0.0, 0.2), 1)
    assert orbit.places[0] == approx([0.0, np.sqrt(E / 2)], abs=1e-9)
    assert np.prod(orbit.multipliers) == approx(1.0, abs=1e-9)
    branch = continued_orbit(returns, orbit, "E", 0.1, points=4)
    assert branch.values[-1] > E
    for value, (place,) in zip(branch.values, branch.places, strict=True):
        assert place == approx([0.0, np.sqrt(value / 2)], abs=1e-9)


def test_tools_take_a_system_of_ones_own(returns):
    for points in section_orbits(returns, orbits=3, crossings=10).orbits:
        y, py = points.T
        assert np.all(py**2 + y**2 - 2 * y**3 / 3 <= 2 * E + 1e-9)
    diagram = orbit_diagram(returns, "E", [0.08, 0.09], (0.1, 0.05), transient=5, kept=5)
    assert [len(places) for places in diagram.places] == [5, 5]
    saddle = periodic_orbit(returns, (-0.12, 0.0), 1)
    assert saddle.kind == "saddle"
    assert manifold(returns, saddle, 0.2).length >= 0.2
    spectrum = lyapunov_spectrum(*SYSTEM.example_motion, 100.0)
    assert (spectrum.values.size, spectrum.divergence) == (4, 0.0)
    assert spectrum.values.sum() == approx(0.0, abs=1e-9)
    assert tube(*SYSTEM.example_motion, [1.0]).width < 1e-18


@mark.parametrize("start", [(0.2, 0.5), (-3.0, -2.0)])
def test_a_driven_pendulum_has_a_stroboscopic_map(start):
    strobe = return_map(DRIVEN.at(), surface=("phase", 5.0))
    assert (strobe.names, strobe.turns) == (("theta", "v"), (2 * np.pi, np.inf))
    period = 2 * np.pi / 0.7
    found = solve_ivp(
        lambda _, y: DRIVEN.field(y, (0.2, 0.5, 0.7)), (0.0, period), (*start, 5.0), "DOP853", rtol=1e-12, atol=1e-12
    ).y[:, -1]
    theta, v = strobe.image(start)
    assert -np.pi <= theta <= np.pi
    assert (np.cos(theta), np.sin(theta), v) == approx((np.cos(found[0]), np.sin(found[0]), found[1]), abs=1e-8)
    # Liouville: areas shrink by the friction.
    assert np.linalg.det(strobe.with_derivative(start)[1]) == approx(np.exp(-0.2 * period), rel=1e-7)
    assert strobe.inverse().image((theta, v)) == approx(start, abs=1e-6)


def test_an_angle_passes_its_value_up_to_full_turns():
    """A pendulum that turns over has the period of the quadrature, and keeps its velocity at the value."""
    pendulum = DRIVEN.at(friction=0.0, force=0.0)
    returns = return_map(pendulum, surface=("theta", 3.0))
    assert returns.orbit((1.0, 0.0), 3)[:, 0] == approx(np.ones(3), abs=1e-8)
    period = quad(lambda a: 1 / np.sqrt(1 + 2 * np.cos(a) - 2 * np.cos(3.0)), 0.0, 2 * np.pi)[0]
    assert returns.time_of((1.0, 0.0)) == approx(period, rel=1e-9)
    # Small swings pass 0, and no full turn.
    assert return_map(pendulum, surface=("theta", 0.0)).image((0.1, 0.0))[0] == approx(0.1, abs=1e-9)


@mark.parametrize(("sense", "end"), [(1, 30.0), (-1, -30.0), (0, 30.0), (0, -30.0)])
def test_a_uniform_rotation_passes_an_angle_once_a_turn(sense, end):
    """A single step of its series would take it round many times."""
    turning = DRIVEN.at(friction=0.0, force=0.0, W=-2.0)
    found = section(turning, (0.0, 0.0, 0.5), AnglePlane(2, 1.0, sense), end, "precise")
    # As time grows the angle falls.
    expected = np.arange(1, 10) * np.pi - 0.25 if end > 0 else -np.arange(10) * np.pi - 0.25
    assert found.times == approx([] if sense > 0 else expected[np.abs(expected) < 30.0], abs=1e-9)


@mark.parametrize(
    ("angles", "words"), [("q", "the angle q must be a variable"), ("v", "v is no angle: after a full turn the field")]
)
def test_what_is_no_angle_is_refused(angles, words):
    with raises(InvalidParameter, match=words):
        System("pendulum", lambda y, p: (y[1], -np.sin(y[0])), "theta v", angles=angles)


@mark.parametrize(
    ("given", "words"),
    [
        ({"integrals": {"L": 1.0}}, "has no integral L: choose one of E"),
        ({"E": E, "surface": ("z", 0.0)}, "has no variable z: choose one of x, y, px, py"),
        ({"E": E, "coordinates": "y x"}, "has one or two coordinates among y, px, py"),
        ({"E": E, "coordinates": "y"}, "values of more or fewer integrals"),
    ],
)
def test_what_makes_no_section_is_refused(given, words):
    with raises(InvalidParameter, match=words):
        return_map(SYSTEM.at(), **given)
