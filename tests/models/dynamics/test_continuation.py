"""Branches of periodic orbits of known maps: folds, flips, pitchforks and invariant curves where they have to be."""

from dataclasses import replace
from itertools import pairwise
from math import asin, pi, sqrt

import numpy as np
from pytest import approx, mark, raises

from hess_mechanics.dynamics.continuation import branch_from, extension
from hess_mechanics.dynamics.periodic import find_periodic
from hess_mechanics.errors import InvalidParameter, NotConverged
from support.maps import arnold, delayed_logistic, henon, pitchfork

B = 0.3


def branch(family, start, place, end, period=1, **options):
    return branch_from(family, find_periodic(family(start), place, period), "λ", start, end, **options)


def the(found, kind):
    (one,) = [one for one in found.bifurcations if one.kind == kind]
    return one


def test_a_branch_goes_through_a_fold_in_parts_and_on_past_where_it_began():
    # Fixed points φ = arcsin(ω/k) and π − arcsin(ω/k), which merge at ω = k = 0.8, from ω = 0.1 back to −0.5.
    parts = [branch(arnold, 0.1, (0.3,), 1.0, points=6, edge=-0.5, longest=0.05)]
    while parts[-1].heading is not None:
        parts.append(extension(arnold, parts[-1], 1.0, -0.5, points=6, longest=0.05))
    for before, after in pairwise(parts):
        assert after.values[0] == approx(before.values[-1], abs=1e-12)
        assert after.points[0] == approx(before.points[-1], abs=1e-12)
    values, phi, multipliers = (
        np.concatenate([getattr(one, name).reshape(-1) for one in parts])
        for name in ("values", "points", "multipliers")
    )
    assert len(parts) > 5
    assert np.abs(np.sin(phi) - values / 0.8).max() < 1e-12
    assert np.abs(multipliers - (1.0 - 0.8 * np.cos(phi))).max() < 1e-12
    # Never more than a step, λ in units of 1.5, the width of the range.
    assert np.hypot(np.diff(values) / 1.5, np.diff(phi)).max() < 0.06
    (fold,) = (one for part in parts for one in part.bifurcations)
    assert fold.kind == "fold"
    assert abs(fold.value - 0.8) <= fold.error < 1e-12
    assert abs(fold.points[0, 0] - pi / 2) < 1e-6
    assert (values[-1], phi[-1]) == approx((-0.5, pi + asin(0.625)), abs=1e-12)
    assert (parts[0].kinds[0], parts[-1].kinds[-1]) == ("stable node", "unstable node")


@mark.parametrize(
    ("kind", "start", "end", "period", "place", "exact"),
    [
        ("fold", 0.1, -1.0, 1, (0.6, 0.2), -0.25 * (1 - B) ** 2),
        ("flip", 0.5, 1.4, 2, (1.0, 0.0), (1 - B) ** 2 + 0.25 * (1 + B) ** 2),
    ],
)
def test_bifurcations_of_the_map_of_henon(kind, start, end, period, place, exact):
    found = branch(henon, start, place, end, period, points=60)
    one = the(found, kind)
    assert abs(one.value - exact) <= one.error + 1e-15
    assert one.error < 1e-8
    low, high = found.values[one.index : one.index + 2]
    assert kind == "fold" or low < exact < high
    assert found.errors.max() < 1e-13
    assert found.period == period


def test_an_invariant_curve_is_born():
    found = branch(delayed_logistic, 1.5, (0.3, 0.3), 2.5)
    one = the(found, "Neimark–Sacker")
    assert abs(one.value - 2.0) <= one.error < 1e-7
    assert one.multipliers == approx(np.exp(1j * pi / 3 * np.array([1, -1])), abs=1e-8)
    assert found.values[-1] == 2.5
    assert np.abs(found.points[:, 0, 0] - (1.0 - 1.0 / found.values)).max() < 1e-13
    assert (found.kinds[0], found.kinds[-1]) == ("stable focus", "unstable focus")


def mirrored(r):
    return replace(
        pitchfork(r), symmetries_of=lambda x, near: ["x → −x"] if np.abs(x[:, 0]).max() < 0.01 * near else []
    )


def test_a_pitchfork_is_one_only_where_a_symmetry_is_broken():
    found = branch(mirrored, 0.5, (0.1, 0.1), 1.5)
    assert [(one.kind, round(one.value, 9)) for one in found.bifurcations] == [("pitchfork", 1.0)]
    unaware = branch(pitchfork, 0.5, (0.1, 0.1), 1.5)
    assert [one.kind for one in unaware.bifurcations] == ["branch point"]
    # The branch that is born there, x² = r − 1, turns back in it and goes on as its own mirror image.
    other = branch(mirrored, 1.5, (0.7, 0.1), 0.5, points=80)
    (one,) = other.bifurcations
    assert abs(one.value - 1.0) <= one.error < 1e-2
    assert other.points[-1, 0, 0] == approx(-sqrt(0.5), abs=1e-9)
    assert np.abs(other.points[:, 0, 0] ** 2 - (other.values - 1.0)).max() < 1e-12
    # x → r x − x³ reflects at r = −1.
    assert the(branch(pitchfork, 0.5, (0.1, 0.1), -1.5), "flip").value == approx(-1.0, abs=1e-12)


def test_what_cannot_be_continued_is_refused():
    with raises(InvalidParameter, match="two different finite"):
        branch(arnold, 0.1, (0.3,), 0.1)
    with raises(NotConverged, match="Start at a slightly different value"):
        branch_from(arnold, find_periodic(arnold(0.1), (0.3,), 1), "λ", 0.9, 1.0)
