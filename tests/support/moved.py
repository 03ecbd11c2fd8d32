"""Starts moved by a few units in the last place: a statement about a chaotic motion holds for every one of them."""

from contextlib import contextmanager
from dataclasses import replace

import numpy as np

FARTHEST = 23
"""Units in the last place by which a component moves at most."""


@contextmanager
def moved_starts(seed):
    """Move every start of an integration, in units in which states are O(1), by factors that depend on the seed.

    Each component has its factor, never 1, so that equal starts stay equal, whatever the threads and the order of the
    orbits are, and 0 stays 0: a motion in an invariant plane remains there.  All motions but those of closed forms, of
    circle maps and of the ball and body without a field, none of which is chaotic, begin with `Problem.of`.
    """
    from hess_mechanics.dynamics.system import Problem

    draw = np.random.default_rng(seed)
    factors = 1.0 + draw.integers(1, FARTHEST + 1, 64) * draw.choice([-1.0, 1.0], 64) * 2.0**-52
    plain = Problem.__dict__["of"]

    def of(cls, body, states):
        problem = plain.__func__(cls, body, states)
        return replace(problem, states=problem.states * factors[: problem.states.shape[1]])

    Problem.of = classmethod(of)
    try:
        yield
    finally:
        Problem.of = plain


def from_moved_starts(compute, count=16):
    """Return what a function computes from each of so many starts that are moved by a few ulps."""
    found = []
    for seed in range(count):
        with moved_starts(seed):
            found.append(compute())
    return found
