"""Ensembles equal single orbits: for every registered system, on any number of threads."""

import re
from itertools import product

import numpy as np
from pytest import approx, mark, raises

from hess_mechanics import Status, ensemble, level, solve
from hess_mechanics.dynamics.ensemble import MAX_NUMBERS
from hess_mechanics.errors import ModelError, WorkLimit
from hess_mechanics.numerics.batch_kernels import LANES
from support.mechanics import EQUILIBRIA, SOME, every_level, some_systems
from support.thorough import sample

FORWARD = np.linspace(0.0, 10.0, 61)


def starts(system, count, seed=1):
    """States about the example's, shape (count, d)."""
    random = np.random.default_rng(seed)
    state = np.array(system.example[0])
    return state * random.uniform(0.5, 1.5, (count, state.size)) * random.choice([-1.0, 1.0], (count, state.size))


def one_by_one(system, states, times):
    return np.array([solve(system.at(system.example[1]), state, times, "reference").states for state in states])


def unit_of(system, states, parameters):
    """Return the unit of the error bound per variable; bounds hold in units where the fastest orbit has ω = 1."""
    nu = max(system.frequency(state, np.array(parameters)) for state in np.array(states))
    return np.where(np.arange(len(system.variables)) < system.angular_velocities, nu, 1.0)


TIMES = (FORWARD, -FORWARD, np.linspace(0.0, 5.0, 2001), [0.0], [0.0, 0.0, 1e-9, 1.0, 1.0, 7.0])


@every_level
@mark.parametrize(("system", "count", "times"), sample(product(SOME, (1, LANES - 1, LANES, 3 * LANES + 5), TIMES), 12))
def test_the_orbits_of_an_ensemble_are_those_of_solve(system, name, times, count):
    states = starts(system, count)
    result = ensemble(system.at(system.example[1]), states, times, name)
    assert result.states.shape == (count, len(times), len(system.variables))
    assert np.array_equal(result.times, times)
    assert result.status is Status.OK
    error = np.abs(result.states - one_by_one(system, states, times))
    # `solve` at its floor, too, errs: by round-off that the motion has had time to multiply.
    assert np.all(error <= (level(name).promise + 1e-13) * unit_of(system, states, system.example[1]))


@some_systems
@every_level
def test_the_result_depends_neither_on_the_threads_nor_on_the_order_of_the_orbits(system, name):
    # Three pieces of work for the threads, the last of them small; each orbit meets other neighbours in its lanes.
    states = starts(system, 150, seed=3)
    states[[7, 20, 149]] = states[0]
    body = system.at(system.example[1])
    one, two = (ensemble(body, states, FORWARD, name, threads=threads) for threads in (1, 2))
    assert np.array_equal(one.states, two.states)
    assert np.array_equal(one.errors, two.errors)
    assert (one.drift, one.status, one.cost.steps) == (two.drift, two.status, two.cost.steps)
    assert all(np.array_equal(one.states[i], one.states[0]) for i in (7, 20, 149))
    order = np.random.default_rng(4).permutation(150)
    other = ensemble(body, states[order], FORWARD, name, threads=2)
    assert np.array_equal(other.states, one.states[order])
    assert np.array_equal(other.errors, one.errors[order])


@some_systems
@every_level
def test_orbits_of_very_different_energies_go_together_with_estimates_of_their_own(system, name):
    # From a thousandth to thirty times the angular velocities: some take a step where others take hundreds.
    states = starts(system, 30, seed=7)
    states[:, : system.angular_velocities] *= np.geomspace(1e-3, 30.0, 30)[:, None]
    times, parameters = np.linspace(0.0, 3.0, 31), system.example[1]
    result = ensemble(system.at(parameters), states, times, name)
    assert result.status is Status.OK
    away = np.abs(result.states - one_by_one(system, states, times))
    assert np.all(away <= (level(name).promise + 1e-12) * unit_of(system, states, parameters))
    true = away.max(axis=(1, 2))
    assert np.all(true <= 10 * result.errors)
    # An estimate for each, and not one for all.
    assert np.ptp(result.errors) > 0.0
    # Estimates are not idle either, where more than round-off is to be estimated.
    if name != "reference":
        assert np.median(result.errors) <= 1000 * np.median(true)
    # The drift is the largest of all orbits.
    along = system.integrals(np.moveaxis(result.states, -1, 0), parameters)
    for key, initial in system.integrals(states.T, parameters).items():
        drift = np.abs(along[key] - initial[:, None]).max(axis=1) / np.maximum(1.0, np.abs(initial))
        assert result.drift[key] == approx(drift.max(), abs=1e-15)


@some_systems
def test_an_equilibrium_among_moving_orbits_stays_where_it_is(system):
    state, parameters = EQUILIBRIA[system.name]
    states = starts(system, 10, seed=10)
    states[[2, 9]] = state
    result = ensemble(system.at(parameters), states, FORWARD, "standard")
    assert np.all(result.states[[2, 9]] == state)


@some_systems
@mark.parametrize("threads", [1, 2])
def test_more_work_than_one_request_may_have_raises_a_sentence(system, threads):
    body, states = system.at(system.example[1]), starts(system, 70)
    for end in (-1e5, 1e308):
        found = ensemble(body, states, [end], "draft", threads=threads, max_steps=1000)
        assert {str(one) for one in found.statuses} == {"incomplete"} and np.all(np.abs(found.ends) < abs(end))
        for reason in found.reasons:
            assert re.search("more than 1000 steps, which reach t = .*: choose a shorter time span", reason)
    with raises(WorkLimit, match="are too many: choose fewer"):
        ensemble(body, states, np.linspace(0.0, 1.0, MAX_NUMBERS // states.size + 1), "draft")
    states[8, 0] = 1e155
    with raises(ModelError, match=r"choose (less extreme parameters|a shorter time span)"):
        ensemble(body, states, [1.0], "draft", threads=threads)
