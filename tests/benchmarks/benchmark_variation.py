"""Exponents and transition matrix beside heyoka's variational run: `python tests/benchmarks/benchmark_variation.py`.

All exponents: `spectrum` as it is called, samples and errors of exponents included, beside a run of heyoka that begins
with the same neighbours and makes them orthogonal at the ends of the same stretches of time, or more often where two
directions of the frame would be 1e4 times as long as each other.  The error is the largest of the growth of all
directions until the end.  Transition matrix: y(T) and ∂y(T)/∂y(0); the error is that of the matrix beside its largest
entry.  Both against the mean of the most exact runs of both, which also says how exact these are.

For each level the least of many times, one run after the other by turns; heyoka's time at our error is read off the
line through its own points, both axes logarithmic.  Needs heyoka: pip install heyoka.
"""

from __future__ import annotations

import time

import heyoka
import numpy as np

from hess_mechanics import LEVELS, level, spectrum, systems
from hess_mechanics.dynamics.spectrum import first_frame
from hess_mechanics.dynamics.system import Problem
from hess_mechanics.dynamics.variation import followed

ROUNDS, T, LONG, PARTS, LIMIT = 15, 200.0, 2000.0, 15, 1e4
TOLERANCES = tuple(10.0**-n for n in (5, 7, 9, 11, 13, 15))


def integrator(system, problem, tolerance):
    """heyoka's, with numbers in the place of parameters."""
    d = len(system.variables)
    variables = heyoka.make_vars(*(f"x{i}" for i in range(d)))
    equations = list(zip(variables, system.field(variables, problem.parameters.tolist()), strict=True))
    return heyoka.taylor_adaptive(heyoka.var_ode_sys(equations, heyoka.var_args.vars, order=1),
                                  problem.states[0].tolist(), tol=tolerance)


def their_growth(run, start, frame, end, parts):
    """The growth (d,) of the directions of a frame, and the largest condition before it is made orthogonal."""
    d = start.size
    run.time = 0.0
    run.state[:d], run.state[d:] = start, frame.ravel()
    grown, worst = np.zeros(d), 1.0
    for i in range(1, parts + 1):
        run.propagate_until(end * i / parts)
        moved = run.state[d:].reshape(d, d)
        frame, lengths = np.linalg.qr(moved)
        grown += np.log(np.abs(np.diagonal(lengths)))
        run.state[d:] = frame.ravel()
        worst = max(worst, np.abs(np.diagonal(lengths)).max() / np.abs(np.diagonal(lengths)).min())
    return grown, worst


def exponents(system):
    """The runs of both, by name, each returning its growths in order; and how often heyoka's frame is renewed."""
    state, p = system.example
    problem = Problem.of(system, [state], p)
    frame, end = first_frame(system, problem)[0], LONG * problem.nu
    parts, run = PARTS, integrator(system, problem, 1e-9)
    while their_growth(run, problem.states[0], frame, end, parts)[1] > LIMIT:
        parts *= 2

    def here(name):
        return lambda: np.sort(spectrum(system, state, p, LONG, level(name)).rates[-1] * LONG)

    def there(tolerance):
        run = integrator(system, problem, tolerance)
        return lambda: np.sort(their_growth(run, problem.states[0], frame, end, parts)[0])

    return {name: here(name) for name in LEVELS}, {t: there(t) for t in TOLERANCES}, f"; {parts} times orthogonal"


def matrices(system):
    """The same of the transition matrix."""
    state, p = system.example
    problem = Problem.of(system, [state], p)
    end, d = T * problem.nu, len(state)

    def here(name):
        asked = level(name)
        return lambda: followed(system, problem, np.array([end]), asked.order, asked.tolerance, 10**6)[2][0]

    def there(tolerance):
        run = integrator(system, problem, tolerance)

        def moved():
            run.time = 0.0
            run.state[:d], run.state[d:] = problem.states[0], np.eye(d).ravel()
            run.propagate_until(end)
            return run.state[d:].reshape(d, d).copy()

        return moved

    return {name: here(name) for name in LEVELS}, {t: there(t) for t in TOLERANCES}, ""


def measured(what, ours, theirs, remark, beside):
    """Print a table of times and errors; beside : what errors are divided by."""
    runs, times = {**ours, **theirs}, {}
    found = {key: run() for key, run in runs.items()}
    best = found["reference"], found[TOLERANCES[-1]]
    exact, apart = sum(best) / 2.0, np.abs(best[0] - best[1]).max() / beside(best[0])
    errors = {key: np.abs(one - exact).max() / beside(exact) for key, one in found.items()}
    for _ in range(ROUNDS):
        for key, run in runs.items():
            begun = time.perf_counter()
            run()
            times[key] = min(times.get(key, np.inf), time.perf_counter() - begun)
    print(f"{what}: the most exact of both differ by {apart:.1e}{remark}")
    line = sorted((np.log(errors[key]), np.log(times[key])) for key in theirs)
    for key in theirs:
        print(f"  heyoka {key:.0e}: {times[key] * 1e3:8.3f} ms, error {errors[key]:.1e}")
    for key in ours:
        same = np.exp(np.interp(np.log(errors[key]), *zip(*line, strict=True)))
        print(f"  {key:10s} {times[key] * 1e3:8.3f} ms, error {errors[key]:.1e}: heyoka {same * 1e3:.3f} ms, "
              f"{same / times[key]:.2f} ×", flush=True)


def main() -> None:
    """Measure and print all tables."""
    print(f"heyoka {heyoka.__version__}, least of {ROUNDS}, exponents over T = {LONG:g}, matrices over {T:g}")
    for name in ("suslov", "ball", "euler-poisson"):
        measured(f"{name}, exponents", *exponents(systems()[name]), lambda exact: 1.0)
        measured(f"{name}, matrix", *matrices(systems()[name]), lambda exact: np.abs(exact).max())


if __name__ == "__main__":
    main()
