"""Sections of a system given by its field alone: Hénon–Heiles, and the tools that take a return map."""

import re

import numpy as np
from pytest import approx, fixture, mark, raises
from scipy.integrate import quad

from hess_mechanics import (
    System,
    continued_orbit,
    lyapunov_exponent,
    lyapunov_spectrum,
    megno,
    megno_map,
    orbit_diagram,
    periodic_orbit,
    return_map,
    section,
    section_points,
)  # fmt: skip
from hess_mechanics.dynamics.ensemble import complete
from hess_mechanics.dynamics.megno_map import ENDED, NOWHERE
from hess_mechanics.dynamics.plane_section import AnglePlane
from hess_mechanics.dynamics.sampling import sampled_orbit
from hess_mechanics.errors import InvalidParameter, NoReturn, OutsideRegion, WorkLimit
from hess_mechanics.numerics.accuracy import STANDARD
from support.henon_heiles import SYSTEM
from support.mechanics import scipy_crossings, scipy_states

E = 1 / 12
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
    assert (section.names, section.dependent_variables, section.surface.normal) == (
        ("y", "py"),
        ("px",),
        (1.0, 0.0, 0.0, 0.0),
    )
    assert dict(section.constants) == {"lam": 1.0, "E": E}
    states, there = section.states_at(np.array([0.1, 0.2, 0.9]), np.array([0.05, 0.0, 0.5]))
    assert there.tolist() == [True, True, False]
    x, y, px, py = states[0]
    assert (x, y, py) == (0.0, 0.1, 0.05)
    assert px == approx(np.sqrt(2 * E - y**2 - py**2 + 2 * y**3 / 3), rel=1e-14)
    assert section.points_of(states)[1].tolist() == [0.2, 0.0]


def test_the_image_of_a_place_is_the_next_crossing_by_another_integrator(returns):
    start = returns.state_at(np.array([0.1, 0.05]))

    times, states = scipy_crossings(
        lambda y: SYSTEM.field(y, (1.0,)), start, lambda y: y[0], 20.0, 1, rtol=1e-13, atol=1e-13
    )
    crossing = states[times > 1.0][0]
    assert returns.image((0.1, 0.05)) == approx(crossing[[1, 3]], abs=1e-10)


def test_a_straight_orbit_is_found_and_continued(returns):
    """On the straight orbits y = ±x/√3 through the origin py² is a quarter of p²: py = √(E/2) there."""
    orbit = periodic_orbit(returns, (0.0, 0.2), 1)
    assert orbit.points[0] == approx([0.0, np.sqrt(E / 2)], abs=1e-9)
    assert np.prod(orbit.multipliers) == approx(1.0, abs=1e-9)
    branch = continued_orbit(returns, orbit, "E", 0.1, points=4)
    assert branch.values[-1] > E
    for value, (place,) in zip(branch.values, branch.points, strict=True):
        assert place == approx([0.0, np.sqrt(value / 2)], abs=1e-9)


def test_a_driven_pendulum_has_a_stroboscopic_map(start=(-3.0, -2.0)):
    strobe = return_map(DRIVEN.at(), surface=("phase", 5.0))
    assert (strobe.names, strobe.turns) == (("theta", "v"), (2 * np.pi, np.inf))
    period = 2 * np.pi / 0.7
    (found,) = scipy_states(DRIVEN, (*start, 5.0), (0.2, 0.5, 0.7), [period])
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


@mark.parametrize(("sense", "end"), [(1, 300.0), (-1, -300.0), (0, 300.0), (0, -300.0)])
def test_a_uniform_rotation_passes_an_angle_once_a_turn(sense, end):
    """A single step of its series would take it round many times."""
    turning = DRIVEN.at(friction=0.0, force=0.0, W=-2.0)
    found = section(turning, (0.0, 0.0, 0.5), AnglePlane(2, 1.0, sense), end, "precise")
    # As time grows the angle falls.
    expected = np.arange(1, 100) * np.pi - 0.25 if end > 0 else -np.arange(100) * np.pi - 0.25
    assert found.times == approx([] if sense > 0 else expected[np.abs(expected) < 300.0], abs=1e-9)


@mark.parametrize(
    ("given", "words"),
    [
        ({"integrals": {"L": 1.0}}, "has no integral L. Allowed names: E"),
        ({"E": E, "surface": ("z", 0.0)}, "has no variable z. Allowed names: x, y, px, py"),
        ({"E": E, "coordinates": "y x"}, "has one or two coordinates among y, px, py"),
        ({"E": E, "coordinates": "y"}, "values of more or fewer integrals"),
        ({"E": E, "surface": "y"}, "surface = 'y' is not a sequence of 2. Write it like .'x', 1.5."),
        ({"E": E, "window": [(0.0, 1.0), (1.0, 0.0)]}, "a lower and a higher number for each of y, py"),
        ({"E": E, "longest": -1.0}, "choose a positive number"),
    ],
)
def test_what_makes_no_section_is_refused(given, words):
    with raises(InvalidParameter, match=words):
        return_map(SYSTEM.at(), **given)


AROUND = System(
    "around",
    lambda y, p: (
        p[0] * (y[0] - p[1] * np.sin(y[1])) - (y[0] - p[1] * np.sin(y[1])) ** 3 + p[1] * p[2] * np.cos(y[1]),
        p[2],
    ),
    "x φ",
    {"mu": -0.2, "A": 0.7, "W": 1.0},
    example=(0.1, 0.3),
    angles="φ",
)
"""Around the orbit x = A sin φ, u = x − A sin φ obeys u̇ = μu − u³: a pitchfork at μ = 0."""


def test_a_periodic_orbit_of_a_strobe_is_continued_to_a_branch_point_with_its_time():
    """A symmetry that shifts the phase is not sought, so that it is no pitchfork; the period is that of the drive."""
    strobe = return_map(AROUND.at(), surface=("φ", 0.5))
    orbit = periodic_orbit(strobe, 0.3, 1)
    assert orbit.points[0] == approx([0.7 * np.sin(0.5)], abs=1e-9)
    assert orbit.multipliers[0] == approx(np.exp(-0.2 * 2 * np.pi), rel=1e-8)
    assert orbit.time == orbit.to_pandas().attrs["time"] == approx(2.0 * np.pi, rel=1e-12)
    (found,) = continued_orbit(strobe, orbit, "mu", 0.2).bifurcations
    # The equations are singular there: how far the bracket closes, and so the error, depends on roundings.
    assert found.kind == "branch point" and abs(found.value) <= found.error < 0.05 and abs(found.value) < 1e-6
    table = continued_orbit(strobe, orbit, "W", 1.5, points=4).to_pandas()
    assert len(table) == 4
    assert table["time"].to_numpy() == approx(2.0 * np.pi / table["W"].to_numpy(), rel=1e-12)


def test_a_section_is_crossed_in_both_directions():
    """The pendulum passes 0.3 upwards and, at the other end of the swing, downwards, with opposite velocities."""
    given = {"surface": ("theta", 0.3), "coordinates": "v phase"}
    pendulum = DRIVEN.at(friction=0.0, force=0.0)
    up, down = (return_map(pendulum, **given, sense=sense) for sense in (1, -1))
    assert (up.state_at((0.5, 0.0))[1], down.state_at((-0.5, 0.0))[1]) == (0.5, -0.5)
    for one, v in ((up, 0.5), (down, -0.5)):
        assert one.image((v, 0.0))[0] == approx(v, abs=1e-9)
        with raises(OutsideRegion):
            one.image((-v, 0.0))
    back = return_map(pendulum, **given, backward=True)
    assert back.image(up.image((0.5, 0.0))) == approx([0.5, 0.0], abs=1e-9)
    with raises(InvalidParameter, match=r"or −1 \(decreasing\)"):
        return_map(pendulum, **given, sense=0)


def test_a_slow_return_is_waited_for_if_that_is_wished():
    slow = DRIVEN.at(W=1e-4)
    with raises(NoReturn, match="a larger `longest`"):
        return_map(slow, surface=("phase", 0.0)).image((0.1, 0.0))
    patient = return_map(slow, surface=("phase", 0.0), longest=1e5, accuracy="draft")
    assert patient.time_of((0.1, 0.0)) == approx(2e4 * np.pi, rel=1e-9)
    assert patient.wait((0.1, 0.0)) == approx(1e5)


def test_an_orbit_diagram_from_outside_of_the_section_is_refused(returns):
    with raises(OutsideRegion, match=r"section at y = 0\.1, py = 5:"):
        orbit_diagram(returns, "E", [0.08, 0.09], (0.1, 5.0), transient=5, crossings=5)


def test_what_is_no_point_of_a_section_is_refused(returns):
    for use in (returns.state_at, returns.image, returns.with_derivative, returns.time_of, returns.wait):
        for place in (0.1, (0.1, 0.2, 0.3), "x", None, (10**400, 0.1)):
            with raises(InvalidParameter, match="give 2 numbers, y, py"):
                use(place)
    for angles, words in (("q", "the angle q must be a variable"), ("v", "v is not an angle: a full turn changes")):
        with raises(InvalidParameter, match=words):
            System("pendulum", lambda y, p: (y[1], -np.sin(y[0])), "theta v", angles=angles)


def test_points_lie_in_a_window_that_crosses_half_a_turn():
    """A window that begins at 2 has them from 2 to 2 + 2π, up to full turns."""
    window = [(2.0, 2.0 + 2.0 * np.pi), (-3.0, 3.0)]
    here = return_map(DRIVEN.at(), surface=("phase", 0.0), coordinates="theta v", window=window).section
    states = np.linspace(-20.0, 20.0, 401)[:, None] * [1.0, 0.0, 0.0]
    places = here.points_of(states)
    assert (places[:, 0] >= 2.0).all()
    assert (places[:, 0] <= 2.0 + 2.0 * np.pi).all()
    assert np.exp(1j * places[:, 0]) == approx(np.exp(1j * states[:, 0]))


def escape(start, until):
    """The time at which another integrator sees a motion escape, None if it does not; near a pole y is 6/τ²."""
    times, _ = scipy_crossings(
        lambda y: SYSTEM.field(y, [1.0]), start, lambda y: np.abs(y[:2]).max() - 1e8, until, most=True, rtol=1e-11
    )
    return float(times[0]) if times.size else None


def test_a_motion_that_escapes_keeps_what_comes_before_and_loses_no_other():
    """Above the energy 1/6 of the saddles."""
    map_ = return_map(SYSTEM.at(), E=0.2, coordinates="y py", window=[(-0.6, 1.2), (-0.7, 0.7)], accuracy="standard")
    here, found = map_.section, megno_map(map_, (6, 4), duration=12.0)
    assert {NOWHERE, ENDED} < set(found.kind.ravel().tolist())
    for i, j in np.argwhere(found.kind != NOWHERE):
        motion = here.states_at(found.x[[j]], found.y[[i]])[0][0]
        time = escape(motion, 12.0)
        assert (found.kind[i, j] == ENDED) == np.isnan(found.values[i, j]) == (time is not None)
        assert found.ends[i, j] == approx(time or 12.0, abs=1e-3)
        if time is None:
            stays = motion
        else:
            start, end = motion, time
    # Exponents and the return map say when and where.
    place = here.points_of(start[None])[0]
    for ends in (
        lambda: lyapunov_exponent(SYSTEM.at(), start, 100.0),
        lambda: lyapunov_spectrum(SYSTEM.at(), start, 100.0),
        lambda: complete(megno(SYSTEM.at(), [start], 100.0)),
        lambda: map_.orbit(place, 100),
    ):
        with raises(WorkLimit, match=r"reached .* at t = .*escapes") as caught:
            ends()
        assert float(re.search(r"t = ([\d.]+)", str(caught.value))[1]) == approx(end, abs=1e-3)
    both = section_points(SYSTEM.at(), [start, stays], here.surface, 40.0, STANDARD, 5)
    assert [bool(reason) for reason in both.reasons] == [True, False]
    crossed, _ = scipy_crossings(lambda y: SYSTEM.field(y, [1.0]), start, lambda y: y[0], end - 0.5, 1)
    assert [len(states) for states in both.states] == [len(crossed), 5]
    assert both.drift["E"] < 1e-6
    drawn = sampled_orbit(SYSTEM.at(), tuple(start), 100.0, (300.0,) * 4, STANDARD)
    assert (str(drawn.status), drawn.states.shape[1]) == ("incomplete", 4)
    assert end - 1.5 < drawn.times[-1] < end
    assert f"t = {end:.2f}"[:7] in drawn.reason
