"""diffrax: Runge–Kutta methods in JAX, compiled by XLA; an ensemble is mapped over its orbits."""

from functools import cache

import diffrax
import jax
import jax.numpy as jnp
import numpy as np

from hess_mechanics import systems

from ..method import Method, half_decades, version
from ..moebius import field
from ..works import MapWorkload, MotionWorkload
from .states import preparing

jax.config.update("jax_enable_x64", True)

_SOLVERS = {"Dopri8": diffrax.Dopri8, "Tsit5": diffrax.Tsit5}
_MAX_STEPS = 1_000_000


def _ladders(work):
    return [tuple((name, tolerance) for tolerance in half_decades(3, 14)) for name in _SOLVERS]


def _rates(work):
    if isinstance(work, MapWorkload):
        return lambda t, y, args: jnp.stack(field(y, 0.5 * work.a))
    return lambda t, y, args: jnp.stack(systems()["suslov"].field(y, work.parameters))


@cache
def _solver(work, name):
    """(initial (n, d), times, tolerance) → states (n, times, d), compiled once for all tolerances."""
    term, solver = diffrax.ODETerm(_rates(work)), _SOLVERS[name]()

    def one(initial, times, tolerance):
        solution = diffrax.diffeqsolve(
            term,
            solver,
            0.0,
            times[-1],
            None,
            initial,
            saveat=diffrax.SaveAt(ts=times),
            max_steps=_MAX_STEPS,
            stepsize_controller=diffrax.PIDController(rtol=tolerance, atol=tolerance),
            throw=False,
        )
        return solution.ys

    if isinstance(work, MotionWorkload) and len(work.initial) > 1:
        return jax.jit(jax.vmap(one, in_axes=(0, None, None)))
    return jax.jit(lambda initial, times, tolerance: one(initial[0], times, tolerance)[None])


def _run(work, initial, times, setting, finish):
    name, tolerance = setting
    solve = _solver(work, name)
    arguments = initial, times, np.float64(tolerance)

    def run():
        return finish(np.asarray(solve(*arguments)))

    run()
    return run


METHOD = Method(
    "diffrax",
    version("diffrax"),
    _ladders,
    preparing(_run),
    without={"D": "it can stop at one event, but not list all of them"},
)
