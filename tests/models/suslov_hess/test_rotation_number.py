"""The rotation number over a, h, f: against motions and iterations, closed forms and the reference values."""

from math import pi, sin

import numpy as np
from pytest import approx, mark

from hess_mechanics import circle_map, f_max
from hess_mechanics.errors import WorkLimit
from hess_mechanics.numerics.accuracy import DRAFT, PRECISE, REFERENCE, STANDARD
from hess_mechanics.suslov_hess.rotation_number import (
    MAX_POINTS,
    PLANES,
    ParameterLine,
    Torus,
    parameter_at,
    perturbed_rotation,
    return_error,
    tongue_curve,
    values_at,
)
from support.refusals import refused
from support.rotation_number import displacement


def iterated(a, h, f, epsilon=0.0, count=10_000):
    """Turns per return of Θ(φ + ε sin 3φ), by counting."""
    lifted = displacement(a, h, f)
    phi = 0.3
    for _ in range(count):
        first = phi + epsilon * sin(3.0 * phi)
        phi = first + float(lifted(first))
    return (phi - 0.3) / (2.0 * pi * count)


# ---- ρ and where it locks ----------------------------------------------------------------------------------------


def test_values_are_those_of_the_circle_map_of_each_torus():
    rng = np.random.default_rng(1)
    tori = np.column_stack([rng.choice([0.1, 0.5, 1.0], 20), rng.uniform(-0.9, 3.0, 20), rng.uniform(-2.0, 2.0, 20)])
    found = values_at(*tori.T, STANDARD)
    possible = [abs(f) <= f_max(h) for _, h, f in tori]
    assert 5 < sum(possible) < 20
    assert found.possible.tolist() == np.isfinite(found.rho).tolist() == possible
    maps = [circle_map(*torus, REFERENCE) for torus in tori[possible]]
    assert found.rho[possible] == approx([one.rotation_number for one in maps], abs=1e-6)
    assert found.trace[possible] == approx([one.trace for one in maps], rel=1e-6)
    assert found.locked[possible].tolist() == [one.kind == "hyperbolic" for one in maps]


def test_at_the_separatrix_there_is_no_map():
    h, f = np.array([1.0, 1.0, 1.0 + 1e-6, -1.0, -5.0, 0.0]), np.array([0.0, 1e-12, 0.0, 0.0, 0.0, 3.0])
    assert values_at(0.5, h, f, DRAFT).possible.tolist() == [False, False, True, False, False, False]


@mark.parametrize("plane", PLANES)
def test_on_the_lock_curve_the_trace_is_two_and_to_one_side_it_locks(plane):
    torus = Torus(0.5, 0.8, 0.7)
    window = (0.3, 0.9, 0.0, 2.0) if plane != "h, f" else (-1.0, 4.0, -3.0, 3.0)
    curve = tongue_curve(plane, torus, window, REFERENCE, points=7)
    assert len(curve) >= 5
    names = plane.split(", ")
    # In (h, f) it runs from the edge of the region to the saddle, and locks to the right.
    across = 0 if plane == "h, f" else 1
    for place in curve[1:-1]:
        here = torus.with_values(**dict(zip(names, place.tolist(), strict=True)))
        assert values_at(**vars(here), accuracy=REFERENCE).trace[0] == approx(2.0, abs=1e-9)
        beside = (place + step * np.eye(2)[across] for step in (-1e-3, 1e-3))
        sides = [torus.with_values(**dict(zip(names, point.tolist(), strict=True))) for point in beside]
        assert [bool(values_at(**vars(side), accuracy=PRECISE).locked[0]) for side in sides] == [False, True]


# ---- rational numbers --------------------------------------------------------------------------------------------


@mark.parametrize(
    ("p", "q", "name", "torus", "low", "high"),
    [
        (-1, 4, "f", Torus(0.5, 0.5, 0.8), 0.0, 1.2),
        (-1, 3, "h", Torus(0.5, 0.0, 0.5), -0.9, 0.9),
        (-1, 4, "a", Torus(0.0, 0.5, 0.6), 0.0, 2.0),
    ],
)
def test_at_a_rational_number_every_orbit_is_periodic_and_not_elsewhere(p, q, name, torus, low, high):
    place = parameter_at(p / q, ParameterLine(name, torus, low, high), REFERENCE)
    assert low < place < high
    found = torus.with_values(**{name: place})
    assert iterated(*vars(found).values(), count=1000 * q) == approx(p / q, abs=1e-6)
    assert return_error(found, q, REFERENCE) < 1e-12
    # No smaller number of returns, and not beside it.
    assert min(return_error(found, n, REFERENCE) for n in range(1, q)) > 0.1
    assert return_error(found.with_values(**{name: place + 1e-4}), q, REFERENCE) > 1e-5


@mark.parametrize(
    ("rho", "name", "torus", "low", "high"),
    [
        (0.25, "f", Torus(0.5, 0.5, 0.5), 0.01, 1.2),
        (-0.25, "h", Torus(0.5, 5.0, 2.0), 4.0, 6.0),
        # Across f = 0 below the saddle ρ jumps from −½ to ½, over all other numbers.
        (0.1, "f", Torus(0.5, 0.3, 0.0), -0.1, 0.1),
    ],
)
def test_where_no_torus_has_the_number_none_is_found(rho, name, torus, low, high):
    assert parameter_at(rho, ParameterLine(name, torus, low, high), STANDARD) is None


# ---- the other family --------------------------------------------------------------------------------------------


@mark.parametrize(("torus", "epsilon"), [((0.5, 0.5, 0.5), 0.25), ((1.2, 0.9, -0.8), -0.33)])
def test_the_other_family_has_the_rotation_number_of_plain_iteration(torus, epsilon):
    # Both signs of f: its mirror image changes the sign of ε.
    assert perturbed_rotation(*torus, epsilon, PRECISE)[0] == approx(iterated(*torus, epsilon), abs=1.2e-4)


def test_the_other_family_locks_at_rational_numbers_and_this_one_does_not():
    h, around = 0.5, np.linspace(0.05, 0.9, 1201)
    other = perturbed_rotation(0.5, h, around, 0.3, STANDARD)
    plateau = np.abs(other + 1.0 / 3.0) < 1e-6
    assert plateau.sum() > 5
    # One stretch without gaps, over which the number of this family changes all the time.
    first, last = np.flatnonzero(plateau)[[0, -1]]
    assert plateau[first : last + 1].all()
    own = values_at(0.5, h, around[first : last + 1], PRECISE).rho
    assert np.min(np.abs(np.diff(own))) > 1e-5
    assert np.ptp(own) > 0.005
    # The number goes up along f, outside of the plateau too.
    assert np.all(np.diff(other) > -1e-4)


# ---- what is refused ---------------------------------------------------------------------------------------------


test_what_cannot_be_is_refused_in_a_sentence = refused(
    (lambda: values_at(0.5, np.zeros(MAX_POINTS + 1), 0.1, DRAFT), "choose fewer points", WorkLimit),
    (lambda: perturbed_rotation(0.5, 0.5, 0.1, 1.0 / 3.0, DRAFT), r"choose \|ε\| < 1/3"),
)
