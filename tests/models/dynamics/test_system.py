"""Conformance: properties of every registered system, and the symmetries of each."""

import json
import math
import os
import re
import subprocess
import sys
from dataclasses import replace

import numpy as np
import sympy
from hypothesis import given
from hypothesis import strategies as st
from pytest import approx, mark, raises

from hess_mechanics import SuslovBody, System, level, return_map, solve, unit_vector
from hess_mechanics.dynamics.orbit import MAX_SAMPLES
from hess_mechanics.errors import InvalidParameter, ModelError, NotPositiveDefinite, WorkLimit, WrongScaling
from support.mechanics import ROOT, SYSTEMS, every_system, some_systems
from support.refusals import refused


def test_the_registry_finds_every_module_that_defines_a_system():
    files = (ROOT / "models/hess_mechanics").rglob("*.py")
    assert len(SYSTEMS) == sum(bool(re.search(r"^SYSTEM = System\(", path.read_text(), re.M)) for path in files)


@every_system
def test_integrals_are_constant_along_the_field_symbolically(system):
    y = sympy.symbols(system.variables, real=True)
    p = sympy.symbols(system.parameters, real=True)
    rates = system.field(y, p)
    for name, integral in system.integrals(y, p).items():
        rate = sum(sympy.diff(integral, variable) * dy for variable, dy in zip(y, rates, strict=True))
        assert sympy.simplify(rate) == 0, name
        assert sympy.diff(integral, y[0]) != 0 or sympy.diff(integral, y[-1]) != 0, f"{name} says nothing"


WITHOUT_JIT = """
import json, sys
import numpy as np
import hess_mechanics
from hess_mechanics import level
results = {}
for name, system in hess_mechanics.systems().items():
    assert not hasattr(system.orbit, "py_func"), "the JIT is on"
    for grade in ("draft", "reference"):
        orbit = hess_mechanics.solve(*system.example_motion, [0.0, 1.0, 5.0], level(grade))
        results[f"{name} {grade}"] = [float(x) for x in orbit.states.ravel().tolist()]
    # Of the systems whose scenes have compiled these; all are derived by the same code.
    if name not in ("suslov", "ball", "euler-poisson"):
        continue
    body, state = system.example_motion
    if name == "ball":
        starts = [[x * (1 + 0.01 * i) for x in state] for i in range(9)]
        many = hess_mechanics.ensemble(body, starts, [0.5, 1.0], level("standard"))
        results[f"{name} ensemble"] = [float(x) for x in many.states.ravel().tolist()]
    last = hess_mechanics.solve(body, state, [0.1 * i for i in range(201)], level("draft")).states[:, -1]
    plane = hess_mechanics.Plane((0.0,) * (len(state) - 1) + (1.0,), offset=0.5 * (last.min() + last.max()), sense=0)
    found = hess_mechanics.section(body, state, plane, 20.0, level("standard"))
    assert len(found.times) > 1
    results[f"{name} section"] = [float(x) for x in [*found.times.tolist(), *found.states.ravel().tolist()]]
for a, h, f in ((0.5, 1.5, 0.6), (0.7, -0.9, 0.05), (60.0, 1.0, 0.9)):
    m = hess_mechanics.circle_map(a, h, f, level("precise"))
    values = [*m.matrix, m.log_scale, m.rotation_number, m.period]
    results[f"circle map {a} {h} {f}"] = [float(x) for x in values]
found = hess_mechanics.rotation_numbers(0.5, np.array([0.1, 0.6]), np.array([0.05, 0.3]), level("standard"))
results["rotation numbers"] = [float(x) for x in found.rho.tolist()]
boundary = hess_mechanics.tongue_boundary(0.5, level("draft"), 5)
results["lock boundary"] = [float(x) for x in boundary.ravel().tolist()]
json.dump(results, sys.stdout)
"""


def test_kernels_without_the_jit_equal_the_compiled_ones_to_round_off():
    captured = []
    # Only the check that the JIT is off must go.
    here = re.sub(r" *assert not hasattr.*\n", "", WITHOUT_JIT)
    exec(here.replace("json.dump(results, sys.stdout)", "keep(results)"), {"keep": captured.append})
    (compiled,) = captured
    run = subprocess.run(
        [sys.executable, "-W", "error", "-c", WITHOUT_JIT],
        env={**os.environ, "NUMBA_DISABLE_JIT": "1", "PYTHONPATH": str(ROOT / "models")},
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert run.returncode == 0, run.stderr
    plain = json.loads(run.stdout)
    assert plain.keys() == compiled.keys()
    for key, values in compiled.items():
        assert plain[key] == approx(values, rel=1e-11, abs=1e-11), key


@every_system
def test_with_the_opposite_velocities_every_motion_goes_back(system):
    y, p = (sympy.symbols(names, real=True) for names in (system.variables, system.parameters))
    signs = [-1 if i < system.angular_velocities else 1 for i in range(len(y))]
    image = system.field([sign * value for sign, value in zip(signs, y, strict=True)], p)
    expected = [-sign * rate for sign, rate in zip(signs, system.field(y, p), strict=True)]
    assert [sympy.expand(left - right) for left, right in zip(image, expected, strict=True)] == [0] * len(y)


@some_systems
def test_a_wrong_scaling_is_refused_when_a_system_is_made(system):
    n = system.angular_velocities
    for wrong in (
        {"angular_velocities": n - 1},
        {"angular_velocities": n + 1},
        {"rescale": lambda y, p, nu: (y.copy(), p.copy())},
        {"rescale": lambda y, p, nu: (system.rescale(y, p, nu)[0], p)},
        {"unit": lambda p: 2.0 * system.unit(p)},
    ):
        with raises(WrongScaling, match=f"^{re.escape(system.title)}: in units of time 1/ν"):
            replace(system, **wrong)
    with raises(WrongScaling, match=f"so choose it from 0 to {len(system.variables)}"):
        replace(system, angular_velocities=len(system.variables) + 1)
    with raises(WrongScaling, match=r"take states \(d,\) and \(d, n\)"):
        replace(system, rescale=lambda y, p, nu: (y / np.full(len(y), nu), p))


@every_system
def test_the_frequency_bounds_every_angular_velocity_of_the_motion(system):
    state, parameters = (np.array(values) for values in system.example)
    orbit = solve(system.at(parameters), state, np.linspace(0.0, 50.0, 2001), "standard")
    fastest = np.max(np.linalg.norm(orbit.states[:, : system.angular_velocities], axis=1))
    # A bound, and one that is not idle.
    assert fastest <= system.frequency(state, parameters) <= 10 * fastest


@every_system
def test_round_off_does_not_grow_with_the_number_of_steps(system):
    # Compensated sums.  What is left, 3e-19 a step, is the rounding of the factors 1/(k+1) of the series,
    # the same in every step.
    orbit = solve(*system.example_motion, np.linspace(0.0, 30000.0, 50), "reference")
    assert orbit.cost.steps > 150_000
    assert max(orbit.drift.values()) < 4e-19 * orbit.cost.steps


@some_systems
def test_dense_output_does_not_depend_on_the_other_samples(system):
    many = np.linspace(0.0, 12.0, 481)
    dense = solve(*system.example_motion, many, "reference")
    sparse = solve(*system.example_motion, many[::60], "reference")
    alone = solve(*system.example_motion, [12.0], "reference")
    assert np.array_equal(dense.states[::60], sparse.states)
    assert np.array_equal(dense.states[-1:], alone.states)


@some_systems
def test_all_runs_of_one_request_share_one_budget_of_steps(system):
    freely = solve(*system.example_motion, [100.0], "standard")
    # Enough for the first run alone and for the second alone, but not for both.
    with raises(WorkLimit, match="choose a shorter time span"):
        solve(*system.example_motion, [100.0], "standard", max_steps=int(0.75 * freely.cost.steps))
    enough = solve(*system.example_motion, [100.0], "standard", max_steps=freely.cost.steps + 2)
    assert np.array_equal(enough.states, freely.states)


@some_systems
def test_what_cannot_be_computed_raises_a_sentence(system):
    state, parameters = system.example
    names, others = (re.escape(", ".join(some)) for some in (system.variables, system.parameters))
    for start, values, times, error, words in (
        (state, [np.nan, *parameters[1:]], [1.0], InvalidParameter, "finite number"),
        (state[:-1], parameters, [1.0], InvalidParameter, names),
        (state, parameters[:-1], [1.0], InvalidParameter, others),
        ([1e155, *state[1:]], parameters, [1.0], ModelError, r"choose (less extreme parameters|a shorter one)"),
        (state, parameters, [], InvalidParameter, "one or more finite numbers"),
        (state, parameters, [2.0, 1.0], InvalidParameter, "increasing times from 0 on"),
        # Beyond double range apart.
        (state, parameters, [1e308, -1e308], InvalidParameter, "increasing times from 0 on"),
        (state, parameters, [1e9], WorkLimit, "choose a shorter time span"),
        (state, parameters, np.zeros(MAX_SAMPLES + 1), WorkLimit, "at most 200000"),
    ):
        with raises(error, match=words):
            solve(system.at(values), start, times, "draft", max_steps=10_000)


SUSLOV_STATE, (_, _, *REST) = SYSTEMS["suslov"].example
test_what_means_nothing_is_refused = refused(
    *(
        (lambda I=I: solve(SYSTEMS["suslov"].at((*I, *REST)), SUSLOV_STATE, [1.0]), "choose I", NotPositiveDefinite)
        for I in ((0.0, 1.0), (1.0, -2.0))
    ),
    (lambda: unit_vector((0.0, 0.0, 0.0)), "nonzero"),
    (lambda: unit_vector((np.nan, 0.0, 1.0)), "not a finite number"),
    (lambda: SuslovBody(np.nan, 1.0, 0.0, 0.0), "I11"),
    (lambda: level("exact"), "draft, standard, precise, reference"),
)


@given(st.tuples(*[st.floats(-1e150, 1e150)] * 3).filter(any))
def test_unit_vectors_have_length_one_and_keep_their_direction(gamma):
    unit, note = unit_vector(gamma)
    length = math.hypot(*gamma)
    assert np.linalg.norm(unit) == approx(1.0, abs=1e-15)
    assert np.array(unit) * length == approx(np.array(gamma), rel=0, abs=1e-15 * length)
    assert (note is None) == (abs(length - 1) <= 1e-15)


HENON_HEILES = {
    "name": "henon-heiles",
    "field": lambda y, p: (y[2], y[3], -y[0] - 2 * y[0] * y[1], -y[1] - y[0] ** 2 + y[1] ** 2),
    "variables": "x y px py",
}


def test_name_field_and_variables_are_enough_for_a_system_but_not_for_a_body():
    system = System(**HENON_HEILES)
    assert (system.title, system.variables, system.parameters) == ("henon-heiles", ("x", "y", "px", "py"), ())
    assert system.example == ((0.1, 0.2, 0.3, 0.4), ())
    with raises(InvalidParameter, match=r"System\('henon-heiles'\) is not a body .* system.at\(…\)"):
        solve(system, system.example[0], 1.0)


@mark.parametrize(
    ("wrong", "words"),
    [
        ({"name": ""}, "not the name of a system"),
        ({"variables": ""}, "`variables` must be names"),
        ({"parameters": "x"}, "a name occurs twice"),
        ({"parameters": {"k": np.nan}}, "the parameters must be finite numbers, 1 of them: k"),
        ({"example": (1.0, 2.0)}, "must be finite numbers, 4 of them: x, y, px, py"),
        ({"integrals": lambda y, p: 3}, "`integrals` must return first integrals by name"),
        ({"angular_velocities": 1}, "belong together"),
        ({"field": lambda y, p: -y[0], "variables": "x"}, "not a sequence: return a rate"),
        ({"field": lambda y, p: (p[1] * y[0],), "variables": "x", "parameters": "k"}, "beyond its 1 variables"),
    ],
)
def test_what_does_not_fit_is_refused_when_a_system_is_made(wrong, words):
    with raises(ModelError, match=words):
        System(**{**HENON_HEILES, **wrong})


def test_a_system_of_one_variable_has_parameters_by_name_needs_no_brackets_and_has_no_section():
    """ẋ = −2x + 1 from 0.3."""
    decay = System("decay", lambda y, p: (-p[0] * y[0] + p[1],), "x", {"k": 2.0, "c": 1.0}, example=3.0)
    assert decay.example == ((3.0,), (2.0, 1.0))
    assert decay.at().parameters == (2.0, 1.0)
    assert decay.at((1.0, 2.0), k=4.0).parameters == (4.0, 2.0)
    assert solve(decay.at(), 0.3, 1.0).states[-1, 0] == approx(0.5 - 0.2 * math.exp(-2.0), rel=1e-9)
    for call, words in (
        (lambda: decay.at(q=1.0), "no parameter q. Allowed names: k, c"),
        (lambda: decay.at((1.0,)), "must be finite numbers, 2 of them: k, c"),
        (lambda: decay.at(c=math.inf), "must be finite numbers"),
        (lambda: return_map(decay.at()), "one variable has no section"),
    ):
        with raises(InvalidParameter, match=words):
            call()


def test_a_rate_may_be_a_plain_number():
    clock = System("clock", lambda y, p: (1, y[0]), "tau x")
    assert clock.rates(np.array([[2.0, 3.0], [4.0, 5.0]]), ()).tolist() == [[1.0, 2.0], [1.0, 4.0]]
