"""The workloads of a peer that returns the states of all orbits at all times."""

import numpy as np

from ..moebius import half_period, start, theta_after


def preparing(run):
    """The function that prepares a run of any workload, which is compiled when it returns.

    run(work, initial, times, setting, finish) returns a compiled function without arguments, which integrates and
    passes the states (orbits, times, variables) to `finish`.
    """

    def dense(work, setting):
        return run(work, work.initial, work.times, setting, lambda states: states[0])

    def ends(work, setting):
        return run(work, work.initial, work.times, setting, lambda states: states[:, -1])

    def circle_map(work, setting):
        theta = theta_after(work.phi)
        return run(work, start(work)[None], np.array([half_period(work)]), setting, lambda out: theta(out[0, -1]))

    ways = {"A": dense, "A2": ends, "B": ends, "B2": ends, "C": circle_map}
    return lambda work, setting, threads=1: ways[work.name](work, setting)
