"""Fields whose Taylor series deceive: no result is "ok" and wrong by more than three times its error estimate.

The truth is a closed form, a quadrature, or SciPy at 1e-13 with small steps.
"""

from functools import cache
from itertools import pairwise
from math import cos, erf, exp, hypot, inf, pi, sin, sqrt

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import expit, sici

from hess_mechanics import LEVELS, Plane, System, ensemble, section, solve
from hess_mechanics.dynamics.system import Problem
from hess_mechanics.dynamics.variation import tangent
from hess_mechanics.errors import InvalidParameter, ModelError, MotionEnds, WorkLimit
from hess_mechanics.numerics import functions as f


def step_at(_, p, start, t):
    """u(t) of u̇ = −u + expit((1 − τ)/width), u(0) = 1."""
    ends = sorted({0.0, t, *np.clip(1.0 + p[0] * np.array([-40, -10, -3, -1, 0, 1, 3, 10, 40]), 0.0, t)})
    return exp(-t) + sum(
        quad(lambda s: exp(s - t) * expit((1 - s) / p[0]), *part, epsabs=1e-14, epsrel=1e-13)[0]
        for part in pairwise(ends)
    )


def quarter(d):
    """A quarter of the period of a spring whose energy is v²/2 + √(x² + d²), from x = 1 at rest."""
    rate = lambda s: sqrt(2 * (hypot(1.0, d) + hypot(1.0 - s * s, d)) / (2.0 - s * s))  # noqa: E731
    # By s² = 1 − x, with which dx/v has no pole.
    return sum(quad(rate, *part, epsabs=1e-14)[0] for part in pairwise((0.0, 0.9, 0.99, 0.999, 1.0)))


def friction_at(_, p, start, t):
    eps, v0 = p[0], start[1]
    v = eps * np.arcsinh(np.sinh(v0 / eps) * exp(-t / eps)) if v0 / eps < 700 else max(0.0, v0 - t)
    edges = sorted({v, min(v0, max(v, 40 * eps)), v0})
    x = sum(quad(lambda w: w / np.tanh(w / eps) if w else eps, a, b, epsabs=1e-14)[0] for a, b in pairwise(edges))
    return x, v


def pulse_at(_, p, start, t):
    s, at = p
    shifted = lambda x: erf((x - at - s * s / 2) / s)  # noqa: E731
    return (exp(-t) + exp(at + s * s / 4 - t) * (shifted(t) - shifted(0.0)) / 2,)


def stiff_at(_, p, start, t):
    """v̇ = −k (v − cos t), v(0) = 0."""
    k = p[0]
    return ((k * cos(t) + sin(t) - k * exp(-k * t)) * k / (k * k + 1),)


FIELDS = {
    # field, variables, truth of the leading variables, (parameters, start, time) of each motion
    "friction": (lambda y, p: (y[1], -f.tanh(y[1] / p[0])), "x v", friction_at,
                 [((eps,), (0.0, 2.0), t) for eps, t in ((0.1, 10.0), (0.01, 10.0), (0.001, 10.0), (0.01, 1.0))]),
    "kinked spring": (lambda y, p: (y[1], -y[0] / f.sqrt(y[0] ** 2 + p[0] ** 2)), "x v", lambda _, p, start, t: start,
                      [((d,), (1.0, 0.0), 4 * quarter(d)) for d in (0.0, 1e-2, 1e-3)]),
    "pulse": (lambda y, p: (-y[0] + f.exp(-(((y[1] - p[1]) / p[0]) ** 2)) / (p[0] * sqrt(pi)), 1), "u tau", pulse_at,
              [((s, at), (1.0, 0.0), at + 1.0)
               for s, at in ((0.1, 1.0), (0.02, 1.0), (0.005, 1.0), (1e-3, 1.0), (1e-4, 1.0), (0.005, 199.0))]),
    "step": (lambda y, p: (-y[0] + 1 / (1 + f.exp((y[1] - 1) / p[0])), 1), "u tau",
             step_at, [((s,), (1.0, 0.0), 2.0) for s in (0.01, 1e-3, 1e-4)]),
    "stiff": (lambda y, p: (-p[0] * (y[0] - f.cos(y[1])), 1), "v tau", stiff_at,
              [((k,), (0.0, 0.0), 2.0) for k in (10.0, 1e3, 1e4)]),
    "large constant": (lambda y, p: (y[1], -((y[0] + p[0]) - p[0])), "x v",
                       lambda _, p, start, t: (start[0] * cos(t), -start[0] * sin(t)),
                       [((c,), (1e-6, 0.0), 1.0) for c in (1e8, 1e4)]),
    "sinc": (lambda y, p: (f.sin(y[1]) / y[1], 1), "u tau",
             lambda _, p, start, t: (sici(start[1] + t)[0] - sici(start[1])[0],),
             [((), (0.0, a), 2.5) for a in (-1.0, -1.0 + 1e-9, -1e-3)]),
    "high power": (lambda y, p: (y[1] ** 40, 1), "x tau", lambda *_: (1 / 41,), [((), (0.0, 0.0), 1.0)]),
    "almost not analytic": (lambda y, p: (f.exp(-1 / y[1] ** 2), 1), "x tau",
                            lambda _, p, start, t: (quad(lambda x: exp(-1 / x**2) if x else 0.0, start[1], 1.0,
                                                         points=[0.0], epsabs=1e-14)[0],),
                            [((), (0.0, a), 1.0 - a) for a in (0.02, -1.0 / 3)]),
    "square root": (lambda y, p: (-f.sqrt(y[0]),), "x", lambda _, p, start, t: (1 / 16 if t < 2.0 else inf,),
                    [((), (1.0,), 1.5), ((), (1.0,), 2.5)]),
}  # fmt: skip
ROWS = [(name, *motion) for name, (*_, motions) in FIELDS.items() for motion in motions]
REFUSED = {("square root", ()), ("step", (1e-3,)), ("step", (1e-4,))}
"""A motion that ends, and functions that exceed the range of double precision."""


@cache
def system(name, parameters):
    field, variables, *_ = FIELDS[name]
    return System(name, field, variables, [f"p{i}" for i in range(parameters)])


@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"{row[0]}-{row[1:]}")
def test_no_result_is_ok_and_wrong_and_standard_is_right(row):
    name, parameters, start, t = row
    field, _, truth, _ = FIELDS[name]
    expected = np.array(truth(field, parameters, start, t))
    is_refused = (name, parameters) in REFUSED
    for level in LEVELS:
        try:
            found = solve(system(name, len(parameters)).at(parameters), start, [t], level)
        except ModelError:
            assert level != "standard" or is_refused
            continue
        error = np.abs(found.states[-1, : expected.size] - expected).max()
        allowed = 3.0 * found.error_estimate + 1e-12 * max(1.0, np.abs(expected).max())
        assert error < allowed or found.status != "ok", (level, found.states[-1], expected, found.error_estimate)
        if level == "standard" and not is_refused:
            assert found.status == "ok" and error <= 2e-6


# ---- the same for sections, ensembles and exponents ------------------------------------------------------------------


def test_a_section_and_an_ensemble_of_a_kinked_spring_are_right(d=1e-3):
    body = system("kinked spring", 1).at((d,))
    found = section(body, (1.0, 0.0), Plane((1.0, 0.0), 0.0, 0), 6.0, "precise")
    np.testing.assert_allclose(found.times, quarter(d) * np.array([1, 3]), atol=1e-8)
    both = ensemble(body, [(1.0, 0.0), (-1.0, 0.0)], [4 * quarter(d)], "precise")
    np.testing.assert_allclose(both.states[:, -1], [(1.0, 0.0), (-1.0, 0.0)], atol=1e-8)


def test_neighbours_see_a_pulse_as_the_orbit_does():
    """u̇ = (pulse(τ) − 1) u: ∂u(2)/∂u(0) = u(2)/u(0)."""

    def field(y, p):
        return y[0] * (f.exp(-(((y[1] - 1) / 0.005) ** 2)) / (0.005 * sqrt(pi)) - 1), 1

    problem = Problem.of(System("growth", field, "u tau").at(), [(1.0, 0.0)])
    found = tangent(problem, problem.states[0], np.eye(2), np.array([2.0]), LEVELS["precise"], inf)
    np.testing.assert_allclose([found.states[0, 0], found.vectors[0, 0, 0]], exp(-1.0), rtol=1e-8)


# ---- limits ----------------------------------------------------------------------------------------------------------


def test_a_pulse_between_two_checks_is_missed_until_max_step_is_below_its_width():
    """The guide says so.  The pulse is a power of a sine that is small but for 0.02 of the period 100."""
    pulses = System("pulses", lambda y, p: (f.sin(pi * y[1] / 100) ** 100_000_000, 1), "u tau")
    # By Laplace's method, to a relative 1/(4e8).
    area = 100 / sqrt(5e7 * pi)
    missed, seen = (solve(pulses.at(), (0.0, 0.0), [100.0], max_step=step).states[-1, 0] for step in (None, 0.05))
    assert seen == pytest.approx(area, rel=1e-8) and missed < 0.5 * area


@pytest.mark.parametrize("level", LEVELS)
def test_limits_of_steps_can_be_given(level):
    motion = system("stiff", 1).at((10.0,)), (0.0, 0.0), [2.0], level
    freely, shortly = solve(*motion), solve(*motion, max_step=0.001)
    assert shortly.cost.steps > 2.0 / 0.001 > freely.cost.steps
    np.testing.assert_allclose(shortly.states, freely.states, atol=3 * freely.error_estimate + 1e-13)
    with pytest.raises(WorkLimit, match=r"needs more than 50 steps, which reach t = \d"):
        solve(*motion, max_step=0.001, max_steps=50)
    with pytest.raises(InvalidParameter, match=r"max_step = .* is not positive"):
        solve(*motion, max_step=0.0)


# ---- motions that end ------------------------------------------------------------------------------------------------


def explosion(y, p):
    return (y[0] * y[0],)


@pytest.mark.parametrize("level", LEVELS)
def test_one_orbit_that_escapes_leaves_the_others_complete(level):
    """ẏ = y²: y(t) = 1/(1/y(0) − t)."""
    t = np.array([0.5, 1.5])
    found = ensemble(System("explosion", explosion, "y").at(), [(-1.0,), (0.1,), (1.0,)], t, level)
    assert [str(one) for one in found.statuses] == ["ok", "ok", "incomplete"] and found.status == "incomplete"
    for i, start in enumerate((-1.0, 0.1)):
        np.testing.assert_allclose(found.states[i, :, 0], 1 / (1 / start - t), rtol=3 * LEVELS[level].promise + 1e-15)
    assert found.ends == pytest.approx([1.5, 1.5, 1.0], abs=LEVELS[level].promise + 1e-15)
    assert found.states[2, 0, 0] == pytest.approx(2.0, rel=1e-2) and np.isnan(found.states[2, 1, 0])
    assert found.last_states[2, 0] > 1e9 and np.isinf(found.errors[2]) and np.isfinite(found.error_estimate)
    assert [bool(reason) for reason in found.reasons] == [False, False, True]


ENDS = {
    "escape": (explosion, "y", (1.0,), 1.5, "y reached .* at t = 1: the motion escapes to infinity"),
    "logarithm": (lambda y, p: (-1.0, f.log(y[0])), "s x", (1.0, 0.0), 2.0, "At t = 1 the field takes log of s"),
    "attraction": (lambda y, p: (y[1], -1 / y[0] ** 2), "r v", (1.0, 0.0), 2.0,
                   r"At t = 1\.11072 no step is short enough: the rate of"),
    "quotient": (lambda y, p: (y[0] / y[1], 0 * y[0]), "a b", (0.0, 0.0), 2.0, "the field divides by b, which is 0"),
    "root": (lambda y, p: (f.sqrt(y[0]),), "y", (0.0,), 2.0, r"At t = 0 the field divides by sqrt\(y\), which is 0"),
    "overflow": (lambda y, p: (f.exp(y[0]),), "y", (800.0,), 2.0, r"exceeds the range of double precision in exp\(y\)"),
}  # fmt: skip


@pytest.mark.parametrize("name", ENDS)
def test_an_error_names_the_time_the_variable_and_the_operation(name):
    field, variables, start, t, words = ENDS[name]
    body = System(name, field, variables).at()
    with pytest.raises(MotionEnds, match=words):
        solve(body, start, [t])
    # A section follows the motion by the same steps.
    if name in ("escape", "quotient"):
        with pytest.raises(MotionEnds, match=words):
            section(body, start, Plane((1.0, *start[1:]), -5.0), t, "precise")
