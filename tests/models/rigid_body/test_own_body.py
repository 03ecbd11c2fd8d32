"""A body of one's own against the paper's systems and against equations with the multiplier as an unknown."""

import numpy as np
from pytest import approx, fixture, mark, raises
from scipy.integrate import solve_ivp

from hess_mechanics import ModelError, OwnBody, Polynomial, SuslovBody, solve
from hess_mechanics.errors import InvalidParameter, NotPositiveDefinite
from support.mechanics import ROOT, without_jit

TENSOR = (1.5, 1.0, 1.2, 0.1, 0.4, 0.2)
FIELD = Polynomial(((1, 0, 0), (0, 1, 0), (0, 0, 1)), (0.3, -0.5, 1.0))
BENT = Polynomial(((2, 0, 0), (1, 1, 2), (0, 0, 3)), (0.7, -0.4, 0.6))
SHAPE = Polynomial(((1, 0, 0), (1, 1, 0), (0, 2, 0)), (0.8, 0.6, -0.3))
OMEGA, VERTICAL = (0.5, 0.9, -0.3), (0.6, 0.0, 0.8)
TIMES = np.linspace(0.0, 10.0, 21)

BODIES = {
    "gyrostat": OwnBody(TENSOR, FIELD, (0.0, 0.0, 1.0), (0.3, -0.2, 0.8)),
    "driven": OwnBody(TENSOR, FIELD, (0.3, -0.2, 1.0), (0.1, 0.2, 0.3), (0.4, 0.1, -0.6), 1.3),
    "shaped": OwnBody(TENSOR, FIELD, (0.0, 0.0, 1.0), (0.1, 0.2, 0.3), (0.4, 0.1, -0.6), 1.3, SHAPE),
    "bent": OwnBody(TENSOR, BENT, (1.0, 0.5, -0.3)),
    "free": OwnBody(TENSOR, BENT, None, (0.2, 0.1, 0.0)),
}
SLANTED = OwnBody((1.5, 1.0, 1.2, 0.0, 0.4, 0.1), FIELD, (0.0, 0.0, 2.0))
TOP = OwnBody((3.0, 2.0, 1.0, 0.0, 0.0, 0.0))
MOTIONS = {
    **{name: (body, OMEGA, TIMES) for name, body in BODIES.items()},
    "slanted": (SLANTED, (0.5, 0.4, 9.0), TIMES),
    # On the separatrix: 2E I2 = M² for ω2 = 0.
    "top": (TOP, (np.sqrt(0.75), 0.0, 1.5), np.linspace(0.0, 4.0, 9)),
}
SEEN = ("gyrostat", "shaped")
WITHOUT_JIT = """
import json, runpy, sys
sys.path[:0] = [sys.argv[1]]
test = runpy.run_path(sys.argv[2])
from hess_mechanics import section, solve
orbits, sections = {}, {}
for name, (body, omega, times) in test["MOTIONS"].items():
    found = solve(body, body.start(omega, test["VERTICAL"]), times, "precise")
    orbits[name] = found.states.tolist(), max(found.drift.values())
for name in test["SEEN"]:
    body = test["BODIES"][name]
    found = section(body, body.start(test["OMEGA"], test["VERTICAL"]), body.surface, 30.0, "precise")
    sections[name] = found.times.tolist(), found.states.tolist()
json.dump([orbits, sections], sys.stdout)
"""


@fixture(scope="module")
def uncompiled():
    """Orbits (states, drift) and sections (times, states) by name: compiled, each body would take ten seconds."""
    return without_jit(WITHOUT_JIT, str(ROOT / "tests"), __file__)


def matrix(tensor):
    I11, I22, I33, I12, I13, I23 = tensor
    return np.array([[I11, I12, I13], [I12, I22, I23], [I13, I23, I33]])


def shape(body, t):
    return body.shape(np.cos(body.frequency * t), np.sin(body.frequency * t), 0.0)


def rates(body):
    """The equations with ω̇ and λ as four unknowns; the gradient of U by differences."""
    inertia = matrix(body.inertia)

    def gradient(gamma, step=1e-5):
        return np.array([(body.potential(*(gamma + e)) - body.potential(*(gamma - e))) for e in step * np.eye(3)]) / (
            2 * step
        )

    def of(t, y):
        omega, gamma = y[:3], y[3:]
        K = np.array(body.momentum) + np.array(body.drive) * shape(body, t)
        rate = np.array(body.drive) * (shape(body, t + 1e-5) - shape(body, t - 1e-5)) / 2e-5
        N = np.cross(inertia @ omega + K, omega) + np.cross(gamma, gradient(gamma)) - rate
        if body.constraint is None:
            return np.concatenate([np.linalg.solve(inertia, N), np.cross(gamma, omega)])
        a = np.array(body.constraint)
        whole = np.block([[inertia, -a[:, None]], [a[None], np.zeros((1, 1))]])
        return np.concatenate([np.linalg.solve(whole, [*N, 0.0])[:3], np.cross(gamma, omega)])

    return of


@mark.parametrize("name", BODIES)
def test_motions_are_those_of_the_equations_with_the_multiplier_and_keep_their_integrals(uncompiled, name):
    body, (states, drift) = BODIES[name], uncompiled[0][name]
    start = body.start(OMEGA, VERTICAL)
    fine = np.linspace(0.0, 10.0, 4001)
    along = solve_ivp(rates(body), (0.0, 10.0), start[:6], "DOP853", fine, rtol=1e-10, atol=1e-11).y
    assert np.abs(np.array(states)[:, :6] - along.T[::200]).max() < 1e-7
    assert drift < 1e-9
    if body.is_driven:
        # The work of the drive, by quadrature along the other solution.
        power = -np.gradient(shape(body, fine), fine, edge_order=2) * (np.array(body.drive) @ along[:3])
        assert states[-1][8] == approx(np.trapezoid(power, fine), abs=1e-5)


def test_with_the_constraint_along_the_third_axis_it_is_the_suslov_problem(uncompiled):
    found = np.array(uncompiled[0]["slanted"][0])
    suslov = solve(SuslovBody(1.5, 1.0, 0.4, 0.1, 0.3, -0.5, 1.0), (0.5, 0.4, *VERTICAL), TIMES, "precise").states
    assert found[:, [0, 1, 3, 4, 5]] == approx(suslov, abs=1e-9)
    assert np.abs(found[:, 2]).max() < 1e-14


def test_the_euler_top_turns_about_the_middle_axis_as_its_closed_form_says(uncompiled):
    # ω2 = w tanh(nt), w = 3/2, n = w √((3 − 2)(2 − 1)/(3·1)).
    _, (first, _, _), t = MOTIONS["top"]
    found, n = np.array(uncompiled[0]["top"][0]), np.sqrt(0.75)
    assert found[:, 1] == approx(np.sign(found[1, 1]) * 1.5 * np.tanh(n * t), abs=1e-8)
    assert found[:, 0] == approx(first / np.cosh(n * t), abs=1e-8)


def test_a_driven_body_is_seen_once_in_each_period_and_another_one_where_the_third_component_passes_zero(uncompiled):
    times, states = uncompiled[1]["shaped"]
    assert times == approx(2 * np.pi / 1.3 * np.arange(1, 7), abs=1e-9)
    body = BODIES["shaped"]
    exact = solve_ivp(
        rates(body), (0.0, 30.0), body.start(OMEGA, VERTICAL)[:6], "DOP853", times, rtol=1e-10, atol=1e-11
    ).y.T
    assert np.array(states)[:, :6] == approx(exact, abs=1e-6)
    times, states = uncompiled[1]["gyrostat"]
    assert len(times) > 1
    (w1, w2, _), (g1, g2, g3) = np.array(states)[:, :3].T, np.array(states)[:, 3:].T
    assert np.abs(g3).max() < 1e-9
    assert np.all(g1 * w2 - g2 * w1 > 0.0)


def test_numbers_in_a_potential_do_not_change_the_equations_and_other_terms_do():
    other = OwnBody(TENSOR, Polynomial(FIELD.exponents, (1.0, 2.0, 3.0)), (0.0, 0.0, 1.0))
    assert other.system is BODIES["gyrostat"].system
    assert BODIES["bent"].system is not other.system


@mark.parametrize(
    ("make", "message", "error"),
    [
        (lambda: OwnBody((1.0, 1.0, 1.0, 2.0, 0.0, 0.0)), "not positive definite: choose larger", NotPositiveDefinite),
        (lambda: OwnBody(TENSOR, constraint=(0.0, 0.0, 0.0)), "a of the constraint is 0", InvalidParameter),
        (lambda: OwnBody(TENSOR).start((1.0, 0.0, 0.0), (0.0, 0.0, 0.0)), "vertical γ is 0", InvalidParameter),
        (lambda: Polynomial(((4, 3, 0),), (1.0,)), "at most 6", InvalidParameter),
    ],
)
def test_what_is_no_body_is_refused(make, message, error):
    with raises(error, match=message) as found:
        make()
    assert isinstance(found.value, ModelError)
