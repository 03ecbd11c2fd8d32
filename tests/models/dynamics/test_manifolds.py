"""Manifolds of saddles of maps with known ones, the points on them as dense as asked, and where they cross."""

import math

import numpy as np
from pytest import approx, mark, raises

from hess_mechanics.dynamics.manifolds import crossings_of, heights_at, manifold, split
from hess_mechanics.dynamics.periodic import find_periodic
from hess_mechanics.errors import InvalidParameter, NoReturn, NotConverged
from support.maps import arnold, bent_saddle, henon, pendulum, pitchfork

HENON = henon(1.4)
SADDLE = find_periodic(HENON, (0.6, 0.2), 1)


def length_of_parabola(x):
    return 0.5 * x * math.hypot(1.0, 2.0 * x) + 0.25 * math.asinh(2.0 * x)


@mark.parametrize("side", [1, -1])
@mark.parametrize("stretch", [2.5, -1.7])
def test_the_manifolds_of_a_bent_saddle_are_its_parabola_and_its_axis(side, stretch):
    m = bent_saddle(stretch)
    saddle = find_periodic(m, (0.1, 0.2), 1)
    unstable = manifold(m, saddle, 4.0, side=side)
    x, y = unstable.points.T
    assert np.abs(y - x * x).max() <= unstable.error_estimate < 1e-12
    assert side * x[-1] > 1.5
    assert 4.0 <= length_of_parabola(abs(x[-1])) < 4.1
    assert unstable.length == approx(length_of_parabola(abs(x[-1])), abs=4e-3)
    assert unstable.multiplier == approx(2.5 if stretch > 0 else 1.7**2, abs=1e-12)
    # W(τ + 1) = F(W(τ)): where x is multiplied.
    assert unstable.point_at(3.3)[0] / unstable.point_at(2.3)[0] == approx(unstable.multiplier, abs=1e-12)
    assert heights_at(unstable, 0, 1.1 * side) == approx([1.21], abs=1e-13)
    assert heights_at(unstable, 1, 1.21) == approx([1.1 * side], abs=1e-13)
    with raises(NotConverged, match="greater length"):
        heights_at(unstable, 0, 5.0)
    stable = manifold(m, saddle, 2.0, stable=True, side=side)
    assert np.abs(stable.points[:, 0]).max() <= stable.error_estimate < 1e-12
    assert side * stable.points[-1, 1] >= 2.0


def test_points_are_as_dense_as_the_curvature_asks():
    counts = []
    for sagitta in (1e-2, 1e-4):
        curve = manifold(HENON, SADDLE, 12.0, sagitta=sagitta, longest=1.0)
        counts.append(len(curve.points))
        # A finer curve tells how far the polyline is from what it stands for.
        middles = [curve.point_at(0.5 * sum(curve.parameters[i : i + 2])) for i in range(1, len(curve.points) - 1)]
        chords = np.diff(curve.points[1:], axis=0)
        away = np.array(middles) - curve.points[1:-1]
        off = np.abs(chords[:, 0] * away[:, 1] - chords[:, 1] * away[:, 0]) / np.linalg.norm(chords, axis=1)
        assert off.max() <= sagitta
    assert counts[0] < 0.6 * counts[1]
    assert curve.end_reason == "At its length."


def test_homoclinic_points_of_henon_are_homoclinic():
    unstable = manifold(HENON, SADDLE, 6.0)
    stable = [manifold(HENON, SADDLE, 6.0, stable=True, side=side) for side in (1, -1)]
    found = [one for branch in stable for one in crossings_of(unstable, branch)]
    assert len(found) >= 2
    for one in found[:4]:
        assert one.error < 1e-9
        assert one.angle > 1e-3
        assert one.is_certain
        # It comes from the saddle and goes there.
        place = one.point
        closest = min(float(np.abs((place := HENON.image(place)) - SADDLE.points[0]).max()) for _ in range(12))
        assert closest < 1e-3
        back = one.point
        away = min(float(np.abs((back := HENON.inverse().image(back)) - SADDLE.points[0]).max()) for _ in range(14))
        assert away < 1e-3


@mark.parametrize(("ripple", "there"), [(0.0, False), (0.1, True)])
def test_curves_that_run_together_do_not_cross_for_certain(ripple, there):
    m = pendulum(0.0, 1.5, ripple)
    saddle = find_periodic(m, (0.01, 0.01), 1)
    unstable, stable = (manifold(m, saddle, 2.0, stable=stable, sagitta=1e-3) for stable in (False, True))
    found = [one for one in crossings_of(unstable, stable) if one.is_certain]
    assert bool(found) is there
    # (x, y) → (y, x) takes one curve to the other: of a homoclinic point that is its own image the places are equal.
    own = [one for one in found if abs(one.point[0] - one.point[1]) < 0.02]
    assert len(own) == there
    for one in own:
        assert abs(one.point[0] - one.point[1]) <= 2.0 * one.error < 1e-8


def test_separatrices_split_in_proportion_to_a_perturbation(mu=1.5):
    gaps = []
    for epsilon in (0.0, 1e-4, 2e-4):
        m = pendulum(epsilon, mu)
        saddle = find_periodic(m, (0.01, 0.01), 1)
        unstable, stable = (manifold(m, saddle, 3.0, stable=stable, sagitta=1e-4) for stable in (False, True))
        if not epsilon:
            x, y = unstable.points.T
            assert np.abs(x * x + y * y + x * x * y * y - 2.0 * mu * x * y).max() < 1e-11
        gaps.append(split(unstable, stable, 0, 0.5))
    assert abs(gaps[0][0]) <= gaps[0][1] < 1e-11
    assert abs(gaps[1][0]) > 1e3 * gaps[1][1]
    assert gaps[2][0] / gaps[1][0] == approx(2.0, abs=1e-2)


def test_what_has_no_manifolds_is_refused():
    with raises(InvalidParameter, match="choose a saddle"):
        manifold(henon(0.1), find_periodic(henon(0.1), (0.6, 0.2), 1), 1.0)
    with raises(InvalidParameter, match="does not have two coordinates"):
        manifold(arnold(0.1), find_periodic(arnold(0.1), (0.3,), 1), 1.0)
    m = bent_saddle()
    saddle = find_periodic(m, (0.1, 0.2), 1)
    with raises(InvalidParameter, match="side = 2: choose 1"):
        manifold(m, saddle, 1.0, side=2)
    assert manifold(m, saddle, 1e9, most=40).end_reason == "After 40 points."
    cut = manifold(m, saddle, 12.0, returns=400)
    assert (cut.end_reason, 0.0 < cut.length < 12.0) == ("After 400 returns of the map.", True)
    with raises(NoReturn):
        manifold(pitchfork(1.5), find_periodic(pitchfork(1.5), (0.01, 0.0), 1), 1.0, stable=True)
