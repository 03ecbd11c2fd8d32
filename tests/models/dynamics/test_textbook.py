"""Systems of textbooks, given by their fields alone, against an integrator of another family."""

import numpy as np
from pytest import approx, mark

from hess_mechanics import System, solve
from hess_mechanics.numerics.functions import cos, exp, log, sin, sqrt
from support.mechanics import scipy_states
from support.thorough import sample


def double_pendulum(y, p):
    a, b, u, v = y
    s, c = sin(a - b), cos(a - b)
    rest = 2 + 2 * s**2
    return (
        u,
        v,
        -(3 * p[0] * sin(a) + p[0] * sin(a - 2 * b) + 2 * s * (v**2 + u**2 * c)) / rest,
        2 * s * (2 * u**2 + 2 * p[0] * cos(a) + v**2 * c) / rest,
    )


def kepler(y, p):
    x, y_, u, v = y
    cube = (x**2 + y_**2) ** 1.5
    return u, v, -p[0] * x / cube, -p[0] * y_ / cube


def toda(y, p):
    q1, q2, q3 = y[:3]
    a, b, c = exp(q1 - q2), exp(q2 - q3), exp(q3 - q1)
    return *y[3:], c - a, a - b, b - c


SYSTEMS = [
    (
        System(
            "double pendulum",
            double_pendulum,
            "a b u v",
            {"g": 1.0},
            (1.5, 0.5, 0.0, 0.3),
            integrals=lambda y, p: {
                "E": y[2] ** 2 + y[3] ** 2 / 2 + y[2] * y[3] * cos(y[0] - y[1]) - p[0] * (2 * cos(y[0]) + cos(y[1]))
            },
        ),
        15.0,
    ),
    (
        System(
            "Kepler, Cartesian",
            kepler,
            "x y u v",
            {"k": 1.0},
            (0.5, 0.0, 0.0, 1.7),
            integrals=lambda y, p: {
                "E": (y[2] ** 2 + y[3] ** 2) / 2 - p[0] / sqrt(y[0] ** 2 + y[1] ** 2),
                "L": y[0] * y[3] - y[1] * y[2],
            },
        ),
        30.0,
    ),
    (
        System(
            "Duffing, driven",
            lambda y, p: (y[1], -p[0] * y[1] + y[0] - y[0] ** 3 + p[1] * cos(y[2]), p[2]),
            "x v τ",
            {"δ": 0.3, "γ": 0.5, "ω": 1.2},
            (0.5, 0.1, 0.0),
        ),
        30.0,
    ),
    (
        System(
            "Lotka–Volterra",
            lambda y, p: (y[0] * (p[0] - p[1] * y[1]), y[1] * (p[3] * y[0] - p[2])),
            "x y",
            {"a": 1.0, "b": 0.5, "c": 1.2, "d": 0.4},
            (1.0, 2.0),
            integrals=lambda y, p: {"V": p[3] * y[0] - p[2] * log(y[0]) + p[1] * y[1] - p[0] * log(y[1])},
        ),
        30.0,
    ),
    (
        System(
            "Toda",
            toda,
            "q1 q2 q3 p1 p2 p3",
            example=(0.5, 0.0, -0.3, 0.4, -0.5, 0.1),
            integrals=lambda y, p: {
                "E": sum(v**2 for v in y[3:]) / 2 + exp(y[0] - y[1]) + exp(y[1] - y[2]) + exp(y[2] - y[0])
            },
        ),
        30.0,
    ),
]
"""Each with a time span over which errors stay small."""

TEXTBOOK = {system.name: (system, span) for system, span in SYSTEMS}


def test_each_keeps_its_integrals_along_the_plain_field():
    for system, _ in TEXTBOOK.values():
        state, p = system.example
        step = 1e-5 * np.array(system.field(state, p))
        ahead, behind = (system.integrals(np.array(state) + sign * step, p) for sign in (1, -1))
        for name in ahead:
            assert ahead[name] == approx(behind[name], abs=1e-10), (system.name, name)


@mark.parametrize("name", sample(TEXTBOOK, 1))
def test_orbits_agree_with_an_independent_integrator(name):
    system, span = TEXTBOOK[name]
    times = np.linspace(0.0, span, 9)
    expected = scipy_states(system, *system.example, times, 1e-13, 1e-13)
    found = solve(*system.example_motion, times, "reference")
    size = max(1.0, float(np.abs(expected).max()))
    assert np.abs(found.states - expected).max() < 3e-8 * size
    assert found.error_estimate < 1e-9 * size
    assert max(found.drift.values(), default=0.0) < 1e-11
