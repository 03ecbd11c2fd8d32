"""The Chaplygin ball with Suslov's constraint, `eq29`: equations, measures, energies, the edges of all ranges."""

import math
from fractions import Fraction

import numpy as np
import sympy
from pytest import approx, mark, param

from hess_mechanics import ensemble
from hess_mechanics.chaplygin_ball.energy_surface import Strip, line_of_rest, omega_of_energy
from hess_mechanics.chaplygin_ball.equations import SYSTEM, BallBody
from hess_mechanics.errors import OutsideRegion
from support.ball import energy_of, rates
from support.refusals import refused


def random_body(random, field=True, decades=1.0):
    moments = 10.0 ** random.uniform(-decades, decades, 2)
    D = 10.0 ** random.uniform(-2 * decades, 2 * decades)
    return BallBody(*moments, *random.normal(size=2), D, *(random.normal(size=3) if field else np.zeros(3)))


def random_states(random, count):
    gamma = random.normal(size=(count, 3))
    return np.hstack([random.normal(size=(count, 2)), gamma / np.linalg.norm(gamma, axis=1)[:, None]])


# ---- equations --------------------------------------------------------------------------------------------------


def test_the_field_solves_the_matrix_equation():
    random = np.random.default_rng(1)
    for y in random_states(random, 200):
        body = random_body(random)
        assert SYSTEM.field(y, body.parameters) == approx(rates(vars(body))(0.0, y), rel=1e-11, abs=1e-11)
        energy = SYSTEM.integrals(y, body.parameters)["E"]
        assert energy == approx(energy_of(vars(body), y), rel=1e-12, abs=1e-12)


# ---- invariant measures -----------------------------------------------------------------------------------------


def liouville(density, **fixed):
    """div(density · field), exactly, at random rational points."""
    y = sympy.symbols(SYSTEM.variables)
    p = sympy.symbols(SYSTEM.parameters)
    values = dict(zip(SYSTEM.parameters, p, strict=True)) | {key: sympy.Integer(value) for key, value in fixed.items()}
    parameters = [values[name] for name in SYSTEM.parameters]
    rho = density(y, parameters)
    divergence = sum(sympy.diff(rho * rate, x) for x, rate in zip(y, SYSTEM.field(y, parameters), strict=True))
    at, random = sympy.lambdify((*y, *p), divergence, "math"), np.random.default_rng(3)
    for _ in range(5):
        yield at(*(Fraction(int(number), 7) for number in random.integers(1, 50, len((*y, *p)))))


WITHOUT = {"b1": 0, "b2": 0, "b3": 0}
PRINCIPAL = {"I13": 0, "I23": 0}


def singular(y, p):
    return 1 / (p[2] * y[0] + p[3] * y[1])


def standard(_, __):
    return sympy.Integer(1)


@mark.parametrize(
    ("density", "fixed", "holds"),
    [
        param(singular, WITHOUT, True, id="singular without field"),
        param(standard, PRINCIPAL, True, id="standard for a principal axis, with field"),
        param(singular, {}, False, id="singular with field"),
        param(standard, WITHOUT, False, id="standard without field"),
    ],
)
def test_liouvilles_equation(density, fixed, holds):
    values = list(liouville(density, **fixed))
    assert all((value == 0) == holds for value in values), values


# ---- energies and the strip -------------------------------------------------------------------------------------


def states_of_energy(body, h, count, random):
    """Random states (count, 5) with E = h of a ball without a field: all directions of ω and γ."""
    gamma = random_states(random, count)[:, 2:]
    turns = random.uniform(0.0, 2.0 * math.pi, count)
    directions = np.column_stack([np.cos(turns), np.sin(turns)])
    return np.array([[*omega_of_energy(body, u, g, h), *g] for u, g in zip(directions, gamma, strict=True)])


def test_the_strip_is_never_left():
    random = np.random.default_rng(4)
    for _ in range(20):
        body, h = random_body(random, field=False, decades=0.5), 10.0 ** random.uniform(-6.0, 6.0)
        strip = Strip(body, h)
        states = states_of_energy(body, h, 50, random)
        orbits = ensemble(body, states, np.linspace(0.0, 20.0, 60) / math.sqrt(h), "reference").states
        squares = orbits[..., :2] ** 2
        outer = squares @ [body.I11, body.I22]
        assert np.max(outer) <= 2 * h * (1 + 1e-12)
        assert np.min(squares @ [body.I11 + body.D, body.I22 + body.D]) >= 2 * h * (1 - 1e-12)
        for curve, added in ((strip.sigma1, 0.0), (strip.sigma2, body.D)):
            points = curve(random.uniform(0.0, 7.0, 30))
            assert points**2 @ [body.I11 + added, body.I22 + added] == approx(2 * h, rel=1e-13)


def test_motions_go_from_the_unstable_half_of_the_line_to_the_stable_one():
    body = BallBody(1.0, 1.5, 0.7, 1.2, 10.0)
    xi, eta = line_of_rest(body)
    assert (body.I13, body.I23) @ xi == approx(0.0, abs=1e-15)
    strip = Strip(body, 10.0)
    states = states_of_energy(body, 10.0, 40, np.random.default_rng(7))
    for end, half in ((-300.0, strip.unstable), (300.0, strip.stable)):
        omega = ensemble(body, states, [end], "precise").states[:, 0, :2]
        assert np.max(np.abs(omega @ eta)) < 1e-6
        ends = np.sort(half @ xi)
        assert np.all((omega @ xi >= ends[0] - 1e-9) & (omega @ xi <= ends[1] + 1e-9))
    # On it ω stays, on either half, for every γ.
    for omega in (*strip.unstable, *strip.stable):
        assert SYSTEM.field((*omega, 0.48, 0.6, 0.64), body.parameters)[:2] == approx((0.0, 0.0), abs=1e-13)


IN_FIELD, FREE, UP = BallBody(2.0, 1.0, 0.3, 0.5, 3.0, 0.0, 0.0, 1.0), BallBody(2.0, 1.0, 0.0, 0.0, 3.0), (0, 0, 1)


test_what_is_no_motion_or_no_ball_is_refused_in_a_sentence = refused(
    (lambda: omega_of_energy(IN_FIELD, (1.0, 0.0), UP, 0.99), "choose h above", OutsideRegion),
    (lambda: Strip(IN_FIELD, 1.0), "b1 = b2 = b3 = 0"),
    (lambda: Strip(FREE, 1.0).stable, "a nonzero I13 or I23"),
    (lambda: BallBody(1.0, 1.0, 0.0, 0.0, -1e-9), "𝒟 ≥ 0"),
)
