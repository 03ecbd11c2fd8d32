"""Sections of a system given by its field alone: Hénon–Heiles, and the tools that take a return map."""

import numpy as np
from pytest import approx, fixture, mark, raises
from scipy.integrate import solve_ivp

from hess_mechanics import (
    System,
    continued_orbit,
    lyapunov_spectrum,
    manifold,
    orbit_diagram,
    periodic_orbit,
    return_map,
    section_orbits,
    tube,
)  # fmt: skip
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
LORENZ = System("lorenz", lambda y, p: (10 * (y[1] - y[0]), y[0] * (28 - y[2]) - y[1], y[0] * y[1] - y[2]), "x y z")


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
    free = return_map(LORENZ.at(), surface=("z", 27.0))
    assert (free.names, free.section.solved) == (("x", "y"), ())


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


@mark.parametrize(
    ("given", "words"),
    [
        ({"integrals": {"L": 1.0}}, "has no integral L: choose one of E"),
        ({"E": E, "surface": ("z", 0.0)}, "has no variable z: choose one of x, y, px, py"),
        ({}, "has one or two coordinates among y, px, py"),
        ({"E": E, "coordinates": "y x"}, "has one or two coordinates among y, px, py"),
        ({"E": E, "coordinates": "y"}, "values of more or fewer integrals"),
    ],
)
def test_what_makes_no_section_is_refused(given, words):
    with raises(InvalidParameter, match=words):
        return_map(SYSTEM.at(), **given)
