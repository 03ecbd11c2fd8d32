"""The command `periodic`: periodic orbits, branches and manifolds against exact ones, and refused inputs."""

from math import pi, sin, sqrt

import numpy as np
import pytest
from pytest import approx
from scipy.integrate import quad

from hess_mechanics import HeavyBody, circle_map, critical_a, level
from hess_mechanics.euler_poisson.hess_isomorphism import Bridge
from support.command_line import replaced, typed
from support.mechanics import followed

REFERENCE = level("reference")
CYCLE = typed("periodic hess --a 0.7 --h 0.5 --f 0.6 --at 1 --period 1")
QUARTIC = typed("periodic quartic --I 2,1 --b3 1 --h 0.8 --at 0.05,0.05 --period 1")


def test_a_limit_cycle_has_the_multiplier_of_the_moebius_matrix(answer):
    found = answer(*CYCLE)
    exact = circle_map(0.7, 0.5, 0.6, REFERENCE).fixed_points
    ((value, imaginary),) = found["multipliers"]
    assert imaginary == 0.0
    assert min(abs(value - one.multiplier) for one in exact) < 1e-9
    assert found["kind"] == ("stable node" if value < 1.0 else "unstable node")
    assert (found["period"], found["return"], len(found["φ"])) == (1, [0], 1)
    assert found["error_estimate"] < 1e-9
    assert found["notes"] == []


def test_a_branch_goes_through_the_fold_where_the_lock_ends(answer, as_table):
    words = [*CYCLE, "--along", "a=0.3"]
    found = answer(*words)
    (fold,) = found["bifurcations"]
    assert fold["kind"] == "fold"
    assert abs(fold["value"] - critical_a(0.5, 0.6, REFERENCE)) < 1e-9
    assert found["a"][0] == approx(0.7, abs=1e-12)
    assert {"stable node", "unstable node"} <= set(found["kind"])
    assert "a = 0.7" in found["ended"]
    # The same as a table.
    facts, header, rows = as_table(*words)
    assert header == ["a", "φ", "real1", "imag1", "kind", "error"]
    assert [float(row[0]) for row in rows] == found["a"]
    assert facts["bifurcations"] == found["bifurcations"]


def test_the_motion_along_the_short_axis_is_known_by_quadrature(answer):
    # q2 = 0: a point goes to and fro along q1, and q2 next to it obeys an equation of Hill's.
    found = answer(*QUARTIC)
    assert np.abs([found["q"], found["p"]]).max() < 1e-10

    def height(q):
        return 0.8 - 0.5 * q * q

    end = sqrt(2.0 * 1.8)
    # q = end sin u: 1 − γ3² = (1 − γ3)(1 + γ3), of which the second is ½(end² − q²).
    time = 4.0 * quad(lambda u: sqrt(2.0 / (1.0 - height(end * sin(u)))), 0.0, pi / 2.0, epsabs=1e-13)[0]

    def hill(_, y):
        q, v, a, da, b, db = y
        return [v, height(q) * q, da, 0.5 * height(q) * a, db, 0.5 * height(q) * b]

    speed = sqrt(1.0 - 0.8**2)
    (end,) = followed(hill, [0.0, speed, 1.0, 0.0, 0.0, 1.0], [time], rtol=1e-12)
    assert end[:2] == approx([0.0, speed], abs=1e-9)
    trace = end[2] + end[5]
    values = np.array([complex(*one) for one in found["multipliers"]])
    assert complex(values.sum()).real == approx(trace, rel=1e-9)
    assert complex(values.prod()).real == approx(1.0, abs=1e-9)
    assert found["kind"] == ("elliptic" if abs(trace) < 2.0 else "saddle" if trace > 2.0 else "saddle with reflection")
    assert len(found["symmetric"]) > 0


def test_the_separatrices_of_a_saddle_have_the_length_that_is_given(answer, as_table):
    body = HeavyBody.hess((1.0, 1.6, 4.0), 1.0)
    h, f = Bridge.of_heavy(body).from_units_of_b(1.5, 0.6)
    words = [
        "periodic",
        "euler-poisson",
        "--A",
        ",".join(map(repr, body.a)),
        "--r",
        ",".join(map(repr, body.r)),
        "--mu",
        repr(body.mu),
        "--h",
        repr(h),
        "--f",
        repr(f),
        "--at=-0.122,0.1206",
        "--period",
        "1",
        "--manifolds",
        "0.6",
    ]
    found = answer(*words)
    assert found["kind"] == "saddle"
    names, sides = np.array(found["manifold"]), np.array(found["side"])
    for name in ("stable", "unstable"):
        for side in (1, -1):
            assert np.array(found["length"])[(names == name) & (sides == side)].max() >= 0.6
    assert found["ended"] == ["At its length."] * 4
    _, header, rows = as_table(*words)
    assert header == ["manifold", "side", "length", "l", "L/G"]
    assert len(rows) == len(names)


@pytest.mark.parametrize(
    "words, said",
    [
        ([*CYCLE, "--along", "a"], "write it like E=2.5"),
        ([*CYCLE, "--along", "a=0.3", "--manifolds", "1"], "not allowed with"),
        ([*CYCLE, "--manifolds", "1"], "Manifolds need a section with two coordinates"),
        (replaced(CYCLE, "--period", "65"), "from 1 to 64"),
        (replaced(CYCLE, "--period", "5"), "none of period 5"),
        (replaced(QUARTIC, "--at", "5,0"), "No motion crosses the section at q = 5"),
        (replaced(QUARTIC, "--b3", "0"), "Choose b3 other than 0"),
    ],
)
def test_what_is_wrong_is_one_sentence(refusal, words, said):
    assert said in refusal(*words)
