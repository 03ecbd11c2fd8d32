"""Kinds of motions and of dynamics where they are known: tori by the Möbius matrix, permanent rotations, seas."""

from __future__ import annotations

import math

import numpy as np
import pytest

from hess_mechanics import HessBody, SuslovBody, circle_map, level, return_map, spectrum, systems
from hess_mechanics.dynamics.regime import Kind, dynamics_of, regime
from hess_mechanics.errors import InvalidParameter
from support.suslov import permanent_rotations

SUSLOV = systems()["suslov"]
REVERSAL = SuslovBody(1.0, 3.0, 0.6, 0.6, 1.0, 0.7, 0.3)
REVERSAL_E = 1.743
STRANGE = SuslovBody(1.0, 2.5, 0.6, 0.6, -1.0, -0.5, 0.7)
STRANGE_E = 0.681
PLAIN = SuslovBody(1.5, 0.7, 0.0, 0.0, 1.4, -1.3, 0.8)


@pytest.mark.parametrize(("a", "h", "f", "kind"), [
    (0.5, 1.5, 0.6, Kind.FIXED_POINT), (0.1, 0.8, 0.6, Kind.QUASI_PERIODIC)])
def test_on_a_torus_the_trace_of_the_moebius_matrix_decides(a, h, f, kind):
    exact = circle_map(a, h, f, level("reference"))
    assert exact.kind == ("hyperbolic" if kind is Kind.FIXED_POINT else "elliptic")
    found = regime(return_map(HessBody(1.0, a, -math.hypot(1.0, a)), h=h, f=f), (0.3,), t=100.0)
    assert found.kind is kind
    assert found.period == (1 if kind is Kind.FIXED_POINT else 0)


def test_a_strange_attractor_is_chaotic_and_shrinks_as_its_exponents_say():
    P = return_map(STRANGE, E=STRANGE_E, accuracy="standard")
    found = regime(P, (1.0, 1.0), t=2000.0)
    assert (found.kind, found.volume) == (Kind.CHAOTIC, -1)
    # The motion is now and then regular for long: after t = 2000 λ is 0 to three errors on every second one.
    exponents = spectrum(SUSLOV, P.state_at(found.places[-1]), STRANGE.parameters, 16_000.0)
    assert exponents.signs[0] == "+"
    assert abs(found.divergence - exponents.values.sum()) <= 3.0 * (
        found.divergence_error + math.hypot(*exponents.errors))
    assert "shrinks" in found.sentence
    # Backwards in time volume grows.
    assert regime(P.inverse(), (1.0, 1.0), t=300.0).kind is Kind.CHAOTIC


def test_where_volume_is_kept_dynamics_are_conservative_and_curves_stay_curves():
    P = return_map(PLAIN, E=1.5, accuracy="standard")
    # Each orbit is another sample of the sea.
    for psi in (1.0, 1.001, 1.002):
        sea = dynamics_of(P, (psi, 1.0), 100, 2000, 300.0)
        assert sea.divergence == 0.0
        assert (sea.verdict, sea.apart.equal) == ("conservative", True)
    curve = regime(return_map(SuslovBody(1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0), E=0.4), (0.3, 1.2), t=300.0)
    # I11 = I22 with b along e: integrable (`QuarticBody.integrable`).
    assert (curve.kind, curve.volume) == (Kind.QUASI_PERIODIC, 0)


def test_permanent_rotations_attract_and_repel_apart_from_each_other():
    found = dynamics_of(return_map(REVERSAL, E=REVERSAL_E, accuracy="standard"), (1.0, 1.0), 300, 64, 200.0)
    exact = np.array(list(permanent_rotations(REVERSAL, REVERSAL_E)))
    psi = np.arctan2(exact[:, 3], exact[:, 2])
    for places in (found.attractor, found.repeller):
        away = np.abs(np.angle(np.exp(1j * (places[-1, 0] - psi))))
        assert away.min() < 1e-3
    assert found.verdict == "dissipative"
    assert found.apart.distance > 1.0


def test_what_cannot_be_told_is_refused():
    P = return_map(PLAIN, E=1.5)
    with pytest.raises(InvalidParameter, match="from 8 to 50000"):
        dynamics_of(P, (1.0, 1.0), kept=2)
    with pytest.raises(InvalidParameter, match="looked at"):
        regime(P, (1.0, 1.0), kept=0)
