"""Crossings of a plane: each found once and in the right place, for every registered system."""

import math
from itertools import product

import numpy as np
from pytest import approx, mark, raises
from scipy.optimize import brentq

from hess_mechanics import Level, Plane, Status, level, section, solve
from hess_mechanics.dynamics.plane_section import MAX_CROSSINGS
from hess_mechanics.errors import InvalidParameter, WorkLimit
from support.mechanics import EQUILIBRIA, SYSTEMS, every_level, every_system, scipy_crossings, some_systems
from support.refusals import refused
from support.thorough import sample


def axis(system, component):
    return tuple(np.eye(len(system.variables))[component])


def rate(system, parameters, normal, state):
    """d(normal·y)/dt."""
    return float(np.dot(normal, system.field(tuple(state), tuple(parameters))))


def random_motions(system, count, seed, end=10.0):
    """(random numbers, state, parameters, normal, heights at 401 times up to `end`), about the example."""
    random = np.random.default_rng(seed)
    for _ in range(count):
        state, parameters = (np.array(values) * random.uniform(0.5, 1.5, len(values)) for values in system.example)
        state *= random.choice([-1.0, 1.0], state.size)
        normal = random.normal(size=state.size)
        if random.random() < 0.3:
            normal = np.array(axis(system, random.integers(state.size)))
        normal /= np.linalg.norm(normal)
        along = solve(system.at(parameters), state, np.linspace(0.0, end, 401), "standard")
        yield random, state, parameters, normal, along.states @ normal


def turning_heights(system, state, parameters, normal, heights, end):
    """The heights at which the orbit turns, to round-off."""

    def at(t):
        return solve(system.at(parameters), state, [t], "reference").states[0]

    times = np.linspace(0.0, end, heights.size)
    rises = np.diff(heights)
    for i in np.flatnonzero(rises[:-1] * rises[1:] < 0.0):
        low, high = times[i], times[i + 2]
        if rate(system, parameters, normal, at(low)) * rate(system, parameters, normal, at(high)) < 0.0:
            yield float(normal @ at(brentq(lambda t: rate(system, parameters, normal, at(t)), low, high)))


@some_systems
def test_crossings_are_those_that_an_integrator_of_another_family_finds(system):
    found = 0
    for random, state, parameters, normal, heights in random_motions(system, 20, seed=1):
        offset = float(np.quantile(heights, random.uniform(0.05, 0.95)))
        result = section(system.at(parameters), state, Plane(tuple(normal), offset, 0), 10.0, "precise")
        times, states = scipy_crossings(
            lambda y, p=parameters: system.field(y.tolist(), p),
            state,
            lambda y, normal=normal, offset=offset: normal @ y - offset,
            10.0,
            max_step=0.05,
        )
        assert len(result.times) == len(times)
        # Roots of the very polynomial that their states come from.
        assert np.max(np.abs(result.states @ normal - offset), initial=0.0) < 1e-13
        for t, other, y, expected in zip(result.times, times, result.states, states, strict=True):
            # A height that is wrong by 1e-9 moves the crossing by that over the speed.
            speed = abs(rate(system, parameters, normal, expected))
            assert abs(t - other) * speed < 1e-9
            assert np.max(np.abs(y - expected)) * min(1.0, speed) < 1e-8
        found += len(times)
    assert found > 40


def crossings_by_kernel(system, state, parameters, normal, offset, end, tolerance):
    times, states = np.empty(10_000), np.empty((10_000, state.size))
    found, steps = system.crossing(
        state, parameters, normal, offset, 0, end, 18, tolerance, np.inf, 1_000_000, times, states
    )
    return times[:found], states[:found], steps


@some_systems
@every_level
def test_a_section_keeps_its_promise_and_its_error_estimate_is_on_the_safe_side(system, name):
    for random, state, parameters, normal, heights in random_motions(system, 4, seed=4):
        plane = Plane(tuple(normal), float(np.quantile(heights, random.uniform(0.2, 0.8))), 0)
        result = section(system.at(parameters), state, plane, 10.0, name)
        # Not the level `reference`, which would say of itself that it is right.
        times, states, _ = crossings_by_kernel(system, state, parameters, normal, plane.offset, 10.0, 1e-20)
        assert len(result.times) == len(times)
        error = np.max(np.abs(result.states - states), initial=0.0)
        assert error <= 10 * result.error_estimate
        # In units in which the fastest motion has ω = 1.
        promise = level(name).promise * system.frequency(state, parameters)
        assert max(error, result.error_estimate) <= promise or result.status is not Status.OK


@every_system
@mark.parametrize("direction", [1.0, -1.0])
def test_a_start_on_a_plane_is_not_a_crossing_and_the_next_ones_are(system, direction):
    for _, state, parameters, normal, _ in random_motions(system, 8, seed=6):
        plane = Plane(tuple(normal), float(normal @ state), 0)
        on_it = section(system.at(parameters), state, plane, 10.0 * direction, "reference")
        # The same orbit from a little earlier crosses the plane there, and then where it does from there.
        before = solve(system.at(parameters), state, [-1e-3 * direction], "reference").states[0]
        earlier = section(system.at(parameters), before, plane, 10.001 * direction, "reference")
        slow = min(abs(rate(system, parameters, normal, y)) for y in (state, *on_it.states))
        assert earlier.times - 1e-3 * direction == approx([0.0, *on_it.times], rel=0, abs=1e-12 / min(1.0, slow))


@every_system
@mark.parametrize("end", [20.0, -20.0])
def test_a_motion_from_rest_does_not_cross_the_plane_it_is_released_from(system, end):
    # γ̇ = 0 there: the height of γ begins with t².
    state, parameters = (np.array(values) for values in system.example)
    state[: system.angular_velocities] = 0.0
    soon = math.copysign(0.05, end)
    later = solve(system.at(parameters), state, [soon], "reference").states[0]
    for component in range(system.angular_velocities, state.size):
        plane = Plane(axis(system, component), state[component], 0)
        # On return to rest it may touch the plane again: there round-off decides.
        times, others = (
            found.times[[abs(rate(system, parameters, plane.normal, y)) > 1e-6 for y in found.states]]
            for found in (
                section(system.at(parameters), start, plane, until, "reference")
                for start, until in ((state, end), (later, end - soon))
            )
        )
        assert times == approx(others + soon, rel=0, abs=1e-11)


@every_system
def test_nothing_is_crossed_at_an_equilibrium_nor_in_a_span_of_length_zero(system):
    for (state, parameters), ends in ((EQUILIBRIA[system.name], (-10.0, 1e200)), (system.example, (0.0,))):
        for component, end, height in product(range(len(state)), ends, (0.0, 0.5)):
            plane = Plane(axis(system, component), state[component] + height, 0)
            result = section(system.at(parameters), state, plane, end, "precise")
            assert (len(result.times), result.status) == (0, Status.OK)


@mark.parametrize(("system", "sense"), sample(product(SYSTEMS.values(), [1, -1, 0]), 4))
def test_a_run_that_finds_other_crossings_than_the_more_exact_one_is_replaced_by_it(system, sense):
    # Next to a turning one of them may have two crossings more; if only those of one sense are counted, one more.
    careless = Level("draft", 1e-3, 1e-4, 10)
    state, parameters = (np.array(values) for values in system.example)
    along = solve(system.at(parameters), state, np.linspace(0.0, 20.0, 401), "standard").states
    tried = 0
    for component, normal in enumerate(np.eye(state.size)):
        turnings = turning_heights(system, state, parameters, normal, along[:, component], 20.0)
        for offset in (turning + depth for turning in turnings for depth in (1e-4, -1e-4, 1e-5, -1e-5)):
            plane = Plane(tuple(normal), offset, sense)
            found, exact = (section(system.at(parameters), state, plane, 20.0, one) for one in (careless, "reference"))
            assert len(found.times) == len(exact.times), (component, offset)
            tried += 1
    assert tried > 20


test_a_plane_that_is_none_raises_a_sentence = refused(
    (lambda: Plane((0.0,) * 5), "normal of the plane is 0"),
    (lambda: Plane((np.nan, 1.0)), "normal of the plane is 0"),
    (lambda: Plane((1.0, 0.0), -np.inf), "offset is not finite"),
    (lambda: Plane((1.0, 0.0), 0.0, -2), "-2: choose 1"),
)


@some_systems
def test_what_cannot_be_computed_raises_a_sentence(system):
    plane, too_long = Plane(axis(system, 0)), r"more than \d+ steps, which reach t = .*: choose a shorter time span"
    given = {"plane": plane, "duration": 20.0, "accuracy": "precise"}
    given["max_steps"] = section(*system.example_motion, **given).cost.steps
    for wrong, error, words in (
        ({"plane": Plane((1.0,))}, InvalidParameter, f"give {len(system.variables)} for"),
        ({"crossings": MAX_CROSSINGS + 1}, WorkLimit, f"between 1 and {MAX_CROSSINGS}"),
        ({"duration": 1e308}, WorkLimit, too_long),
        # Enough for each run alone but not for all.
        ({"max_steps": given["max_steps"] - 1}, WorkLimit, too_long),
    ):
        with raises(error, match=words):
            section(*system.example_motion, **{**given, **wrong})
