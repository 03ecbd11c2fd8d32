"""The commands `orbit-diagram` and `regime`: against the Möbius matrix and Newton's method, and refused inputs."""

import math

import numpy as np
import pytest
from pytest import approx

from hess_mechanics import circle_map, level, turning_points
from support.command_line import replaced, typed

REFERENCE = level("reference")
TORUS = typed("--a 0.5 --h 1.5 --f 0.6 --at 0.3")
DIAGRAM = ["orbit-diagram", "hess", *TORUS, "--over", "h=1.3:1.7:5", "--transient", "60", "--crossings", "16"]
SUSLOV = typed("--I 1,2.11,0.6,0.6 --b=-1,-0.5,0.7 --E 0.681 --at 0.83,1.89")


def test_over_tori_an_orbit_comes_to_the_stable_limit_cycle_and_backward_to_the_other(answer):
    words = [*DIAGRAM, "--back", "--backward"]
    found = answer(*words)
    way, h, phi = (np.array(found[name]) for name in ("way", "h", "φ"))
    assert np.unique(h) == approx([1.3, 1.4, 1.5, 1.6, 1.7], abs=1e-12)
    for value in np.unique(h):
        seen = {name: phi[(way == name) & (h == value)] for name in ("there", "back", "backward")}
        assert all(len(some) == 16 and np.ptp(some) < 1e-8 for some in seen.values())
        assert abs(seen["there"][0] - seen["back"][0]) < 1e-8
        assert abs(seen["there"][0] - seen["backward"][0]) > 0.1
    # The stable limit cycle, where the map contracts.
    place = repr(float(phi[(way == "there") & (h == 1.5)][-1]))
    orbit = answer("periodic", "hess", *replaced(TORUS, "--at", place), "--period", "1")
    exact = min(one.multiplier for one in circle_map(0.5, 1.5, 0.6, REFERENCE).fixed_points)
    assert orbit["multipliers"][0][0] == approx(exact, rel=1e-9)
    assert found["hysteresis"] == []
    assert found["gaps"] == {"there": [], "back": [], "backward": []}
    assert set(found["period"]) == {1}


def test_a_doubling_is_where_newtons_method_finds_the_multiplier_minus_one(answer):
    found = answer(
        "orbit-diagram",
        "suslov",
        *SUSLOV,
        "--over",
        "I22=2.11,2.2",
        "--crossings",
        "12",
        "--doublings",
        "1",
        "--accuracy",
        "standard",
    )
    assert dict(zip(found["I22"], found["period"], strict=True)) == {2.11: 1, 2.2: 2}
    (doubling,) = found["doublings"]
    words = replaced(["periodic", "suslov", *SUSLOV, "--period", "1"], "--I", f"1,{doubling['value']!r},0.6,0.6")
    orbit = answer(*replaced(words, "--at", ",".join(map(repr, doubling["place"]))))
    assert min(value for value, _ in orbit["multipliers"]) == approx(-1.0, abs=1e-6)
    assert (doubling["period"], found["ended"], found["limit"]) == (1, "After 1 doublings.", None)


def test_on_a_torus_the_mean_divergence_is_that_of_the_multiplier_and_attractor_and_repeller_are_the_cycles(answer):
    found = answer("regime", "hess", *TORUS, "--dynamics", "--transient", "60", "--crossings", "64", "--t", "100")
    stable = min(circle_map(0.5, 1.5, 0.6, REFERENCE).fixed_points, key=lambda one: one.multiplier)
    # Three integrals and the motion itself neither grow nor shrink: what is left is the multiplier, once in a period.
    rate = math.log(stable.multiplier) / turning_points(1.5, 0.6).period
    assert abs(found["divergence"] - rate) <= 3.0 * found["divergence_error"]
    assert (found["kind"], found["period"], found["volume"], found["verdict"]) == ("fixed point", 1, -1, "dissipative")
    which, phi = np.array(found["set"]), np.array(found["φ"])
    for kind, name in (("stable", "attractor"), ("unstable", "repeller")):
        place = repr(float(phi[which == name][-1]))
        orbit = answer("periodic", "hess", *replaced(TORUS, "--at", place), "--period", "1")
        assert orbit["kind"] == f"{kind} node"
        assert abs(orbit["φ"][0] - float(place)) < 1e-7


@pytest.mark.parametrize(
    "words, said",
    [
        (replaced(DIAGRAM, "--over", "mass=1:2:3"), "There is no mass here to change: choose one of a, h, f"),
        (replaced(DIAGRAM, "--crossings", "20000"), "At most 20000 crossings"),
        (replaced(replaced(DIAGRAM, "--over", "h=1:2:100"), "--crossings", "19000"), "at most 1000000 places"),
        (["regime", "suslov", *replaced(SUSLOV, "--E", "-9")], "choose E above"),
    ],
)
def test_what_is_wrong_is_one_sentence(refusal, words, said):
    assert said in refusal(*words)
