"""Exponents and transition matrix beside heyoka's variational run: `python tests/benchmarks/benchmark_variation.py`.

Exponents: the run of `lyapunov_spectrum`, and `lyapunov_spectrum` as it is called, with its samples and errors; beside
heyoka's run, which begins with the same neighbours.  They are made orthogonal at the ends of as many stretches of time,
or of more where some would come to be 1e6 times as long as others; of heyoka only the integration is counted, not what
Python does between two pieces of it.  The error is the largest of the growth of all directions until the end.
Transition matrix: y(T) and ∂y(T)/∂y(0); the error is that of the matrix beside its largest entry.  Both against the
mean of the most exact runs of both, which also says how exact these are.

For each level the least of many times, one run after the other by turns; heyoka's time at our error is read off the
line through its own points, both axes logarithmic.  Needs heyoka: pip install heyoka.

2026-11-23, heyoka 7.13.2, two shared cores with other work on them, at draft, standard, precise, reference:

    Suslov, exponents, T = 2000        2.46, 3.55, 4.92, 8.63 ms; heyoka takes 3.4, 4.8, 4.5, 3.9 times as long
        `lyapunov_spectrum` as it is called     4.54, 5.39, 7.23, 11.0 ms; 1.8, 3.1, 3.1, 3.1 times
    Suslov, matrix, T = 200            0.57, 0.40, 0.53, 0.89 ms; 1.5, 3.0, 3.5, 3.9 times
    Euler–Poisson, exponents, T = 200  0.59, 0.71, 1.00, 1.81 ms; 3.1, 3.0, 3.5, 3.4 times
        `lyapunov_spectrum` as it is called     2.92, 3.09, 3.20, 4.30 ms; 0.6, 0.7, 1.8, 1.4 times
    Euler–Poisson, matrix, T = 20      0.19, 0.15, 0.17, 0.23 ms; 1.0, 1.6, 2.1, 2.6 times
    ball, exponents, T = 2000          15, 24, 40, 77 ms; 4.9, 6.4, 7.8, 4.2 times
        `lyapunov_spectrum` as it is called     22, 38, 53, 98 ms; 3.3, 3.9, 6.8, 3.3 times
    ball, matrix, T = 200              1.2, 1.5, 2.4, 9.3 ms; 9, 9, 11, 10 times

Those of Euler–Poisson and of the ball with four tolerances of heyoka only, and on the busiest machine.  Around the run,
`lyapunov_spectrum` itself takes 2 ms for its samples and errors: over a short time that is most of it.
"""

from __future__ import annotations

import time

import heyoka
import numpy as np

from hess_mechanics import LEVELS, level, lyapunov_spectrum, systems
from hess_mechanics.dynamics.spectrum import LIMIT, first_frame
from hess_mechanics.dynamics.system import Problem
from hess_mechanics.dynamics.variation import followed, neighbours

ROUNDS, PARTS = 25, 15
TOLERANCES = tuple(10.0**-n for n in (5, 7, 9, 11, 13, 15))
TIMES = {"suslov": 2000.0, "ball": 2000.0, "euler-poisson": 200.0}
"""For exponents: the motion of Euler–Poisson is chaotic, and no run has digits left later.  Matrices take a tenth."""


def timed(run):
    """Its result, and the seconds that it takes."""

    def measured():
        begun = time.perf_counter()
        return run(), time.perf_counter() - begun

    return measured


def integrator(system, problem, tolerance):
    """heyoka's, with numbers in the place of parameters."""
    d = len(system.variables)
    variables = heyoka.make_vars(*(f"x{i}" for i in range(d)))
    equations = list(zip(variables, system.field(variables, problem.parameters.tolist()), strict=True))
    return heyoka.taylor_adaptive(
        heyoka.var_ode_sys(equations, heyoka.var_args.vars, order=1), problem.states[0].tolist(), tol=tolerance
    )


def their_growth(run, start, frame, end, parts):
    """The growth (d,) of the directions of a frame, seconds, and how much longer one is than another at most."""
    d = start.size
    run.time = 0.0
    run.state[:d], run.state[d:] = start, frame.ravel()
    grown, seconds, worst = np.zeros(d), 0.0, 1.0
    for i in range(1, parts + 1):
        begun = time.perf_counter()
        run.propagate_until(end * i / parts)
        seconds += time.perf_counter() - begun
        frame, lengths = np.linalg.qr(run.state[d:].reshape(d, d))
        sizes = np.abs(np.diagonal(lengths))
        grown += np.log(sizes)
        run.state[d:] = frame.ravel()
        worst = max(worst, sizes.max() / sizes.min())
    return np.sort(grown), seconds, worst


def exponents(system, problem, integrators, span):
    """The runs of both, by name, each returning its growths in order and its seconds; and a remark."""
    state, p = system.example
    start, frame, end = problem.states[0], first_frame(system, problem)[0], span * problem.nu
    parts = PARTS
    while their_growth(integrators[1e-9], start, frame, end, parts)[2] > 1e6:
        parts *= 2

    def run(level):
        steps, _, frames, logs, _ = neighbours(
            system, start, frame, problem.parameters, np.array([end]), level.order, level.tolerance, 10**6, LIMIT, True
        )
        assert steps > 0
        return np.sort(logs[0] + np.log(np.abs(np.diagonal(np.linalg.qr(frames[0])[1]))))

    ours = {f"run, {name}": timed(lambda one=one: run(one)) for name, one in LEVELS.items()}
    ours |= {
        f"spectrum, {name}": timed(
            lambda name=name: np.sort(lyapunov_spectrum(system.at(p), state, span, level(name)).rates[-1] * span)
        )
        for name in LEVELS
    }
    theirs = {
        tolerance: lambda one=one: their_growth(one, start, frame, end, parts)[:2]
        for tolerance, one in integrators.items()
    }
    return ours, theirs, f"; heyoka's neighbours are made orthogonal {parts} times"


def matrices(system, problem, integrators, span):
    """The same of the transition matrix."""
    end, d = span * problem.nu, len(system.variables)

    def here(level):
        return followed(system, problem, np.array([end]), level.order, level.tolerance, 10**6)[2][0]

    def there(run):
        run.time = 0.0
        run.state[:d], run.state[d:] = problem.states[0], np.eye(d).ravel()
        run.propagate_until(end)
        return run.state[d:].reshape(d, d).copy()

    ours = {name: timed(lambda one=one: here(one)) for name, one in LEVELS.items()}
    return ours, {tolerance: timed(lambda one=one: there(one)) for tolerance, one in integrators.items()}, ""


def measured(what, ours, theirs, remark, beside):
    """Print a table of times and errors; beside : what errors are divided by."""
    runs = {**ours, **theirs}
    found = {key: run()[0] for key, run in runs.items()}
    best = found[next(key for key in ours if "reference" in key)], found[TOLERANCES[-1]]
    exact, apart = sum(best) / 2.0, np.abs(best[0] - best[1]).max() / beside(best[0])
    errors = {key: np.abs(one - exact).max() / beside(exact) for key, one in found.items()}
    times = dict.fromkeys(runs, np.inf)
    for _ in range(ROUNDS):
        for key, run in runs.items():
            times[key] = min(times[key], run()[1])
    print(f"{what}: the most exact of both differ by {apart:.1e}{remark}")
    line = sorted((np.log(errors[key]), np.log(times[key])) for key in theirs)
    for key in theirs:
        print(f"  heyoka {key:.0e}: {times[key] * 1e3:.3f} ms, error {errors[key]:.1e}")
    for key in ours:
        same = np.exp(np.interp(np.log(errors[key]), *zip(*line, strict=True)))
        print(
            f"  {key}: {times[key] * 1e3:.3f} ms, error {errors[key]:.1e}; heyoka {same * 1e3:.3f} ms, "
            f"{same / times[key]:.2f} ×",
            flush=True,
        )


def main() -> None:
    """Measure and print all tables."""
    print(f"heyoka {heyoka.__version__}, least of {ROUNDS}")
    for name, span in TIMES.items():
        system = systems()[name]
        problem = Problem.of(system.at(system.example[1]), [system.example[0]])
        integrators = {tolerance: integrator(system, problem, tolerance) for tolerance in TOLERANCES}
        measured(f"{name}, exponents, T = {span:g}", *exponents(system, problem, integrators, span), lambda exact: 1.0)
        measured(
            f"{name}, matrix, T = {0.1 * span:g}",
            *matrices(system, problem, integrators, 0.1 * span),
            lambda exact: np.abs(exact).max(),
        )


if __name__ == "__main__":
    main()
