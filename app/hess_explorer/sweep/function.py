"""Turn a user's function into a computation: its parameters, and the numbers that it returns."""

from __future__ import annotations

import inspect
import math
import sys
import textwrap
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from hess_explorer.compute.cells import UserError
from hess_explorer.sweep.plan import Axis, SweepPlan
from hess_mechanics.catalogue import Computation, NoValue, Number
from hess_mechanics.catalogue.declared import real
from hess_mechanics.errors import InvalidParameter, ModelError
from hess_mechanics.numerics.accuracy import Kind, Level

_ACCURACY = "accuracy"
"""A parameter of this name receives the accuracy of the sweep."""
_BOUNDS = (-sys.float_info.max, sys.float_info.max)
_TRIALS = 16
"""Maximum number of cells at which a function is called to learn its fields."""

Function = Callable[..., Any]


def _with_names(function: Function, own: str, takes_accuracy: bool) -> Callable[..., dict[str, float]]:
    """Return a function that returns the numbers of `function` by name; a single number is called `own`."""

    def call(accuracy: Level, **cell: float) -> dict[str, float]:
        try:
            found = function(**cell, **({_ACCURACY: accuracy} if takes_accuracy else {}))
            named = found._asdict() if hasattr(found, "_asdict") else {own: found}
            return {name: float(value) for name, value in named.items()}
        except (ModelError, ArithmeticError):
            raise
        except Exception as error:
            raise UserError(f"{type(error).__name__}: {error}") from error

    return call


def _number(name: str, title: str) -> Number:
    def read(values: Mapping[str, float]) -> float:
        value = values.get(name, math.nan)
        if math.isnan(value):
            raise NoValue(f"{name} is missing or NaN.")
        return value

    return Number(name, title, read)


def computation_of(
    function: Function, over: Mapping[str, Axis], fixed: Mapping[str, float], accuracy: str
) -> tuple[Computation, str]:
    """Return a user's function as a computation, and its source code, or its name if the source is not available.

    The parameters of the computation are the swept and fixed ones, and those with a number as default.  The function
    is called at one cell, or at up to 16 until one has a result, to learn the names of its numbers.

    Parameters
    ----------
    function : callable
        Takes numbers by name, and returns a number or a named tuple of numbers.
    over : mapping of str
        Values of the swept parameters, see `Axis`.
    fixed : mapping of str to float
        Values of fixed parameters.
    accuracy : str
        Name of the level that a parameter `accuracy` of the function receives.

    Raises
    ------
    InvalidParameter
        If the function fails at all cells that are tried, or an axis or a fixed value is not allowed.
    WorkLimit
        If the sweep has too many cells.
    """
    inner = function.func if isinstance(function, partial) else function
    name = str(getattr(inner, "__name__", ""))
    name = name if name.isidentifier() else "value"
    try:
        signature = dict(inspect.signature(function).parameters)
    except (TypeError, ValueError):
        signature = {}
    call = _with_names(function, name, signature.pop(_ACCURACY, None) is not None)
    defaults = {each: one.default for each, one in signature.items() if type(one.default) in (int, float)}
    parameters = (
        real(each, each, float(value), *_BOUNDS, each)
        for each, value in {**defaults, **dict.fromkeys((*over, *fixed), 0.0)}.items()
    )
    what = Computation(name, name, function, tuple(parameters), {}, Kind.MAP, call=call)
    title = (inspect.getdoc(inner) or name).partition("\n")[0]
    fields = _fields(what, SweepPlan.of(what, (), accuracy, over, fixed))
    try:
        source = textwrap.dedent(inspect.getsource(inner))
    except (OSError, TypeError):
        source = name
    return replace(what, numbers={each: _number(each, title) for each in fields}), source


def _fields(what: Computation, plan: SweepPlan) -> tuple[str, ...]:
    """Return the names of the numbers that a function returns at the first cell with a result, of up to 16."""
    failed: Exception | None = None
    for cell in np.unique(np.linspace(0, plan.cells - 1, _TRIALS).astype(int)):
        columns = plan.columns(np.array([cell]))
        try:
            return (*what.compute({name: column.item() for name, column in columns.items()}, plan.accuracy),)
        except (ModelError, ArithmeticError, UserError) as error:
            failed = failed or error
    raise InvalidParameter(
        f"{what.name} failed at all cells that were tried (first: {failed}): it must accept its parameters by name "
        "and return a number or a named tuple of numbers."
    )
