"""A function of the user as a computation, with the parameters of its calls and the fields of its results."""

from __future__ import annotations

import inspect
import math
import sys
import textwrap
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from hess_explorer.compute.cells import UserError
from hess_explorer.sweep.plan import Axis, Plan
from hess_mechanics.catalogue import Computation, NoValue, Number
from hess_mechanics.errors import InvalidParameter, ModelError
from hess_mechanics.numerics.accuracy import Kind, Level
from hess_mechanics.numerics.arguments import as_level
from hess_mechanics.parameters import Parameter

__all__ = ["plan_of"]

_LEVEL = "level"
"""A parameter of this name receives the level of the sweep."""
_BOUNDS = (-sys.float_info.max, sys.float_info.max)
_TRIALS = 16
"""Maximum number of cells at which a function is called to learn its fields."""

Function = Callable[..., Any]


@dataclass(frozen=True)
class _Call:
    """`Computation.call` of a function: returns its numbers by name."""

    name: str
    function: Function
    takes_level: bool

    def __call__(self, accuracy: Level, **cell: float) -> Any:
        try:
            found = self.function(**cell, **({_LEVEL: accuracy} if self.takes_level else {}))
            named = found._asdict() if hasattr(found, "_asdict") else {self.name: found}
            return {name: float(value) for name, value in named.items()}
        except (ModelError, ArithmeticError):
            raise
        except Exception as error:
            raise UserError(f"{type(error).__name__}: {error}") from error


def _number(name: str, title: str) -> Number:
    def read(found: Mapping[str, float]) -> float:
        value = found.get(name, math.nan)
        if math.isnan(value):
            raise NoValue(f"{name} is missing or NaN.")
        return value

    return Number(name, title, read)


def plan_of(
    function: Function, numbers: Sequence[str] | None, over: Mapping[str, Axis], fixed: Mapping[str, float], level: str
) -> Plan:
    """Return the plan of a function, which is called at one cell, or at a few until one has a result.

    Its parameters are those that the sweep gives, and those with a number as default.  Raises `InvalidParameter`,
    `WorkLimit`.
    """
    inner = function.func if isinstance(function, partial) else function
    name = str(getattr(inner, "__name__", ""))
    name = name if name.isidentifier() else "value"
    try:
        signature = dict(inspect.signature(function).parameters)
    except (TypeError, ValueError):
        signature = {}
    call = _Call(name, function, signature.pop(_LEVEL, None) is not None)
    defaults = {each: one.default for each, one in signature.items() if type(one.default) in (int, float)}
    parameters = (
        Parameter(each, each, each, float(value), (0.0, 1.0), 0.1, _BOUNDS)
        for each, value in {**defaults, **dict.fromkeys((*over, *fixed), 0.0)}.items()
    )
    what = Computation(name, name, function, tuple(parameters), {}, Kind.MAP, call=call)
    fields = _fields(call, Plan.of(what, (), level, over, fixed))
    title = (inspect.getdoc(inner) or name).partition("\n")[0]
    what = replace(what, numbers={each: _number(each, title) for each in fields})
    return Plan.of(what, numbers or fields, level, over, fixed, _source(inner, name))


def _fields(call: _Call, plan: Plan) -> tuple[str, ...]:
    """Return the names of a function's numbers, from the first cell that has a result."""
    failed: Exception | None = None
    for cell in np.unique(np.linspace(0, plan.cells - 1, _TRIALS).astype(int)):
        columns = plan.columns(np.array([cell]))
        try:
            return (*call(as_level(plan.level), **{name: column.item() for name, column in columns.items()}),)
        except (ModelError, ArithmeticError, UserError) as error:
            failed = failed or error
    raise InvalidParameter(
        f"{call.name} failed at all cells that were tried (first: {failed}): let it take its parameters by name, and "
        "return a number or a named tuple of numbers."
    )


def _source(function: Function, name: str) -> str:
    """Return the text of a function, or its name where there is none."""
    try:
        return textwrap.dedent(inspect.getsource(function))
    except (OSError, TypeError):
        return name
