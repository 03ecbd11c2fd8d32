"""The command `periodic`: periodic orbits, branches and manifolds against exact ones, and refused inputs."""

import numpy as np
import pytest
from pytest import approx

from hess_mechanics import HeavyBody, circle_map, critical_a, level
from hess_mechanics.euler_poisson.hess_isomorphism import Bridge
from support.command_line import replaced, typed

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
    assert header == ["a", "φ", "real1", "imag1", "time", "kind", "error"]
    assert [float(row[0]) for row in rows] == found["a"]
    assert facts["bifurcations"] == found["bifurcations"]


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
        ([*CYCLE, "--along", "a=0.3", "--manifolds", "1"], "not allowed with"),
        ([*CYCLE, "--manifolds", "1"], "Manifolds need a section with two coordinates"),
        (replaced(CYCLE, "--period", "5"), "none of period 5"),
        (replaced(QUARTIC, "--at", "5,0"), "No motion crosses the section at q = 5"),
    ],
)
def test_what_is_wrong_is_one_sentence(refusal, words, said):
    assert said in refusal(*words)
