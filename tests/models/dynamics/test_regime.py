"""Kinds of motions and dynamics known by other means: Möbius matrix, integrable cases, long runs."""

import math
from functools import partial

import numpy as np
from pytest import mark
from scipy.optimize import brentq

from hess_mechanics import (
    HeavyBody,
    HessBody,
    SuslovBody,
    circle_map,
    f_max,
    return_map,
)
from hess_mechanics.dynamics.point_sets import SetDistance
from hess_mechanics.dynamics.regime import Dynamics, MotionKind, Regime, dynamics_of, regime
from hess_mechanics.suslov_hess.torus_section import TorusSection
from support.deviations import deviations
from support.diagrams import spread
from support.mechanics import apart, scipy_crossings
from support.suslov import field, permanent_rotations
from support.thorough import examples

REVERSAL = SuslovBody(1.0, 3.0, 0.6, 0.6, 1.0, 0.7, 0.3)
REVERSAL_E = 1.743


@mark.chaotic
def test_where_volume_is_kept_dynamics_are_conservative_and_curves_stay_curves():
    P = return_map(SuslovBody(1.5, 0.7, 0.0, 0.0, 1.4, -1.3, 0.8), E=1.5, accuracy="standard")
    sea = dynamics_of(P, (1.0, 1.0), 100, 2400, 300.0)
    assert (sea.motion.kind, sea.motion.divergence, sea.verdict) == (MotionKind.CHAOTIC, 0.0, "conservative")
    assert deviations([one.overlap for one in sea.comparisons], 0.8, of_each=True) > 5.0
    assert deviations([one.distance / (one.grain + one.error) for one in sea.comparisons], 1.0, of_each=True) < -5.0
    curve = regime(return_map(SuslovBody(1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0), E=0.4), (0.3, 1.2), duration=300.0)
    # I11 = I22 with b along e: integrable (`QuarticBody.integrable`).
    assert (curve.kind, curve.volume) == (MotionKind.QUASI_PERIODIC, 0)
    assert curve.map_.section.integrable == "the integrable case I₁₁ = I₂₂, b along e"


@mark.chaotic
def test_a_sea_whose_volume_shrinks_is_not_conservative_as_the_number_says():
    """DOP853 with its own divergence: −0.00690 ± 0.00031 over t = 2·10⁵."""
    P = return_map(SuslovBody(1.5, 1.7, 0.1, -0.3, -1.7, 1.0, 2.0), E=-0.9089144, accuracy="standard")
    seas = [dynamics_of(P, (-1.0063 + 1e-9 * i, 1.1872), 500, 1500, 12_000.0) for i in range(6)]
    assert {sea.motion.kind for sea in seas} == {MotionKind.CHAOTIC}
    found = [sea.motion.divergence for sea in seas]
    assert deviations(found, 0.0) < -5.0
    for sea in seas:
        assert abs(sea.motion.divergence + 0.0069) <= 5.0 * math.hypot(sea.motion.divergence_error, 0.00031)
        # One motion may be too short to tell, but none may say that volume is kept or grows.
        assert (sea.verdict, sea.motion.volume) in (("mixed", -1), ("not told apart", 0))
    # Over a short time such motions are not told apart, and that is said with a bound.
    short = [regime(P, place, duration=50.0) for place in spread(P.section, 36)]
    assert deviations(np.array([one.volume == 0 for one in short]), 0.25) > 5.0
    untold = [one for one in short if one.volume == 0]
    assert deviations([one.bound for one in untold], 0.0069) > 5.0


@mark.parametrize(
    ("apart", "touching", "unsettled", "verdict"),
    [
        (6, 0, 2, "dissipative"),
        (5, 0, 3, "not told apart"),
        (7, 1, 0, "not told apart"),
        (0, 8, 0, "mixed"),
    ],
)
def test_orbits_on_their_way_tell_nothing_and_the_others_must_agree(apart, touching, unsettled, verdict):
    P = return_map(REVERSAL, E=REVERSAL_E)
    shrinks = Regime(P, MotionKind.CHAOTIC, np.zeros((1, 2)), 1.0, divergence=-0.1, divergence_error=0.01)
    kinds = (
        *[SetDistance(3.0, 0.01, 0.01, 0.0, True)] * apart,
        *[SetDistance(0.5, 0.01, 0.01, 0.1, True)] * touching,
        *[SetDistance(1.0, 0.2, 0.9, 0.0, False)] * unsettled,
    )
    assert Dynamics(shrinks, shrinks.points, shrinks.points, kinds).verdict == verdict


def test_what_is_not_seen_to_return_does_not_within_the_time_waited():
    """The motion comes to a permanent rotation, which has γ3 = 0 and never crosses γ1 = 0."""
    P = return_map(REVERSAL, E=REVERSAL_E, plane=1, accuracy="draft")
    found = regime(P, (1.0, 1.0))
    assert found.kind is MotionKind.NO_RETURN
    # The start lies on the plane, so a crossing at t = 0 is the start itself.
    start = P.state_at(found.points[-1] if len(found.points) else np.array([1.0, 1.0]))
    times, _ = scipy_crossings(
        partial(field, REVERSAL), start, lambda y: y[2], found.duration, 1, rtol=1e-10, atol=1e-11
    )
    assert not np.any(times > 1e-3)


@mark.parametrize(
    ("moments", "r", "mu", "f", "case"),
    [
        ((1.0, 0.625, 0.25), (0.0, 0.0, 1.0), 0.0, 0.7, "Euler"),
        ((1.0, 1.0, 2.0), (0.0, 0.0, 1.0), 1.0, 0.5, "Lagrange"),
        ((1.0, 1.0, 2.0), (1.0, 0.0, 0.0), 1.0, 0.5, "Kovalevskaya"),
        ((1.0, 1.0, 4.0), (1.0, 0.0, 0.0), 1.0, 0.0, "Goryachev"),
        # A body next to it is in no such case.
        ((1.0, 0.99, 3.0), (0.6, 0.0, 0.8), 1.0, 0.0, ""),
    ],
)
def test_integrable_cases_are_named(moments, r, mu, f, case):
    named = HeavyBody(moments, r, mu).integrable_at(f)
    assert case in named and bool(named) == bool(case)


def test_permanent_rotations_attract_and_repel_apart_from_each_other():
    found = dynamics_of(return_map(REVERSAL, E=REVERSAL_E, accuracy="standard"), (1.0, 1.0), 300, 64, 200.0)
    exact = np.array(list(permanent_rotations(REVERSAL, REVERSAL_E)))
    psi = np.arctan2(exact[:, 3], exact[:, 2])
    for places in (found.attractor, found.repeller):
        assert apart(places[-1, 0], psi).min() < 1e-3
    # ω is along γ or against it: δ is 0 or π.
    senses = np.cos([found.attractor[-1, 1], found.repeller[-1, 1]])
    assert abs(senses.prod() + 1.0) < 1e-3
    assert found.verdict == "dissipative"
    assert found.distance > 1.0
    rates = REVERSAL.I23 * exact[:, 0] / REVERSAL.I22 - REVERSAL.I13 * exact[:, 1] / REVERSAL.I11
    assert found.motion.kind is MotionKind.FIXED_POINT
    assert np.abs(rates - found.motion.divergence).min() <= 3.0 * found.motion.divergence_error


# ---- verdicts that are not too sure ---------------------------------------------------------------------------------


def torus(a, h, f):
    return return_map(HessBody(1.0, a, -math.hypot(1.0, a)), h=h, f=f)


def random_tori(count, kind):
    """Draw tori whose circle map is of this kind, well inside, with a phase."""
    draw = np.random.default_rng(51)
    while count:
        a, h, f, phi = draw.uniform((0.05, -0.95, 0.02, -3.0), (1.0, 2.5, 1.0, 3.0))
        exact = circle_map(a, h, f * f_max(h), "precise")
        if exact.kind == kind:
            count -= 1
            yield exact, phi


def test_no_winding_torus_shrinks_or_grows_and_longer_runs_agree(monkeypatch):
    monkeypatch.setattr(TorusSection, "measure", "")
    # On the first one this was wrong once.
    issued = circle_map(0.445, -0.24, 0.476, "precise")
    for exact, phi in ((issued, -2.9), (issued, 1.0), *random_tori(examples(4), "elliptic")):
        P = torus(exact.a, exact.h, exact.f)
        for t in (200.0, 800.0):
            found = regime(P, (phi,), duration=t)
            # There is a smooth invariant measure: the mean is exactly 0.
            assert found.volume == 0, (exact, phi, t, found.divergence, found.divergence_error)
            assert found.kind in (MotionKind.QUASI_PERIODIC, MotionKind.UNDECIDED, MotionKind.SETTLING)


def test_the_measure_of_a_winding_torus_is_used_and_named():
    found = dynamics_of(torus(0.445, -0.24, 0.476), (-2.9,), 300, 200, 200.0)
    assert (found.motion.kind, found.motion.volume, found.motion.divergence) == (MotionKind.QUASI_PERIODIC, 0, 0.0)
    assert found.verdict == "conservative"
    assert "smooth invariant measure" in found.motion.measure
    # Next to a limit cycle there is none.
    assert torus(0.5, 1.5, 0.6).section.measure == ""


def test_on_locked_tori_volume_shrinks_as_the_multiplier_of_the_cycle_says():
    for exact, phi in random_tori(examples(4), "hyperbolic"):
        P, rate = torus(exact.a, exact.h, exact.f), exact.fixed_points[0].log_multiplier / exact.period
        for t in (200.0, 800.0):
            found = regime(P, (phi,), duration=t)
            assert abs(found.divergence - rate) <= 3.0 * found.divergence_error
            if found.kind is MotionKind.FIXED_POINT and rate < -0.01:
                assert found.volume == -1


def test_a_reversor_that_takes_a_motion_to_itself_is_named():
    body = SuslovBody(1.5, 1.7, 0.03, -0.05, -0.3, 0.2, 2.0)
    found = regime(return_map(body, E=0.5), (2.66, 1.58))
    assert found.kind is MotionKind.QUASI_PERIODIC
    assert not found.map_.preserves_volume
    assert "the reversor ω1, ω2, t → −" in found.measure
    # Attractors are mirrored to repellers.
    assert regime(return_map(REVERSAL, E=REVERSAL_E), (1.0, 1.0)).measure == ""


def test_an_orbit_that_nearly_closes_is_not_periodic():
    a, h, f = 0.3879079101373818, -0.7743996457233353, 0.05754693484816638
    rho = circle_map(a, h, f, "reference").rotation_number
    assert 1e-6 < abs(602.0 * rho - round(602.0 * rho)) < 1e-4
    found = regime(torus(a, h, f), (-2.4161720749348596,))
    assert (found.kind, found.period) == (MotionKind.QUASI_PERIODIC, 0)


def test_a_slow_passage_is_no_fixed_point(monkeypatch):
    """Just outside the Arnold tongue the map moves by less than 1e-4 where the cycles have met, and returns later."""
    monkeypatch.setattr(TorusSection, "measure", "")
    a = brentq(lambda a: circle_map(a, 1.5, 0.6, "reference").trace - (2.0 - 1e-8), 0.05, 0.5, xtol=1e-15)
    P = torus(a, 1.5, 0.6)
    steps = np.linspace(-math.pi, math.pi, 2001)[:, None]
    slow = steps[np.abs(apart(P.image(steps)[:, 0], steps[:, 0])).argmin()]
    slowest = P.orbit(slow, 2000)
    slowest = slowest[np.abs(np.diff(slowest[:, 0])).argmin()]
    assert abs(P.image(slowest)[0] - slowest[0]) < 1e-4
    assert regime(P, slowest, transient=0).kind not in (MotionKind.FIXED_POINT, MotionKind.PERIODIC)
