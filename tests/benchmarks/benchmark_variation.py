"""The transition matrix beside heyoka's variational run: `python tests/benchmarks/benchmark_variation.py`.

Both find y(T) and ∂y(T)/∂y(0); the error is the largest of the matrix beside its largest entry, against our reference
level.  For each tolerance the least of many times, one after the other by turns.  Needs heyoka: pip install heyoka.

2026-11-23, two shared cores, Suslov, T = 200: 0.33 ms for 9e-8, 0.47 for 9e-11; heyoka 7.13.2 0.96 ms for 4e-7, 1.61
for 6e-10, 2.28 for 9e-13: 3.4 and 3.8 times as long at equal error, on a busy machine.  With all five columns, as the
spectrum has them, it was 0.43 and 0.62 ms in the same run: 2.6 and 3.0 times.
"""

from __future__ import annotations

import time

import heyoka
import numpy as np

from hess_mechanics import systems
from hess_mechanics.dynamics.system import Problem
from hess_mechanics.dynamics.variation import followed

ROUNDS, T = 15, 200.0


def ours(name):
    """The run of one tolerance: (matrix, seconds)."""
    system = systems()[name]
    state, p = system.example
    problem = Problem(np.array([state]), np.array(p), 1.0, np.ones(len(state)))
    at = np.array([T])

    def run(tolerance, order):
        begun = time.perf_counter()
        found = followed(system, problem, at, order, tolerance, 10**6)
        return found[2][0], time.perf_counter() - begun

    return run


def theirs(name, tolerance):
    """The same by heyoka, with numbers in the place of parameters."""
    system = systems()[name]
    state, p = system.example
    d = len(state)
    variables = heyoka.make_vars(*(f"x{i}" for i in range(d)))
    equations = list(zip(variables, system.field(variables, p), strict=True))
    varied = heyoka.var_ode_sys(equations, heyoka.var_args.vars, order=1)
    integrator = heyoka.taylor_adaptive(varied, state, tol=tolerance)
    first = integrator.state.copy()

    def run():
        begun = time.perf_counter()
        integrator.time = 0.0
        integrator.state[:] = first
        integrator.propagate_until(T)
        return integrator.state[d:].reshape(d, d).copy(), time.perf_counter() - begun

    return run


def main() -> None:
    """Measure and print a table."""
    print(f"heyoka {heyoka.__version__}, T = {T}, least of {ROUNDS}")
    for name in ("suslov", "ball", "euler-poisson"):
        run = ours(name)
        exact, _ = run(1e-17, 24)
        size = np.abs(exact).max()
        settings = ((1e-5, 12), (1e-8, 16), (1e-11, 20), (1e-14, 22))
        peers = [(10.0**-n, theirs(name, 10.0**-n)) for n in (6, 9, 12, 15)]
        rows = {}
        for _ in range(ROUNDS):
            for setting in settings:
                found, seconds = run(*setting)
                rows.setdefault(("here", *setting), []).append((seconds, np.abs(found - exact).max() / size))
            for tolerance, peer in peers:
                found, seconds = peer()
                rows.setdefault(("heyoka", tolerance), []).append((seconds, np.abs(found - exact).max() / size))
        for key, values in rows.items():
            print(f"{name:14s} {key!s:24s} {min(values)[0] * 1e3:8.3f} ms  error {values[0][1]:.1e}", flush=True)


if __name__ == "__main__":
    main()
