"""Properties of every run of every system: one orbit, several at once, the crossings of a plane."""

import numpy as np
from pytest import mark

from hess_mechanics import Level, Plane, Status, ensemble, section, solve
from support.mechanics import some_systems


def equator(system):
    """The plane in which the last component vanishes."""
    return Plane(tuple(np.eye(len(system.variables))[-1]))


RUNS = {
    "orbit": lambda system, level: solve(*system.example_motion, [20.0], level),
    "ensemble": lambda system, level: ensemble(system.at(system.example[1]), [system.example[0]] * 3, [20.0], level),
    "section": lambda system, level: section(*system.example_motion, equator(system), 20.0, level),
}
every_run = mark.parametrize("run", RUNS.values(), ids=RUNS)


@some_systems
@every_run
def test_a_level_that_cannot_keep_its_promise_says_so(run, system):
    for level, status in (
        (Level("standard", 1e-300, 1e-8, 14), Status.PROMISE_NOT_MET),
        (Level("reference", 1e-300, 1e-17, 24), Status.FLOOR),
    ):
        found = run(system, level)
        assert found.status is status
        assert np.isfinite(found.error_estimate)


@some_systems
@every_run
def test_a_run_that_misses_its_promise_is_replaced_by_a_tighter_one(run, system):
    # Steps far too long for the promise.
    found, truth = run(system, Level("standard", 1e-9, 1e-1, 14)), run(system, "reference")
    assert found.status is Status.OK
    assert found.states.shape == truth.states.shape > (0,)
    assert np.max(np.abs(found.states - truth.states)) <= 1e-9
