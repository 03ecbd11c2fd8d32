"""A function of the user as a computation, with the parameters of its signature and the fields of its results."""

from __future__ import annotations

import inspect
import math
import sys
import textwrap
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from numbers import Real
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
_BY_NAME = (inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.KEYWORD_ONLY)
_TRIALS = 16
"""Maximum number of cells at which a function is called to learn its fields."""

Function = Callable[..., Any]


@dataclass(frozen=True)
class _Calls:
    """`Computation.call` of a function; fields : those of its named tuples, empty for a number."""

    function: Function
    takes_level: bool
    fields: tuple[str, ...] | None = None

    def __call__(self, accuracy: Level, **cell: float) -> Any:
        try:
            found = self.function(**cell, **({_LEVEL: accuracy} if self.takes_level else {}))
            fields = tuple(getattr(found, "_fields", ()))
            if self.fields not in (None, fields):
                raise TypeError("returns other fields than at the first cell")
            for each in found if fields else (found,):
                if not isinstance(each, (Real, np.bool_)) and not (isinstance(each, np.ndarray) and each.shape == ()):
                    name = type(each).__name__
                    raise TypeError(f"returns {name}: let it return a number or a named tuple of numbers")
        except (ModelError, ArithmeticError):
            raise
        except Exception as error:
            raise UserError(f"{type(error).__name__}: {error}") from error
        return found


def _number(name: str, title: str, field: str | None) -> Number:
    def read(found: Any) -> float:
        value = float(found if field is None else getattr(found, field))
        if math.isnan(value):
            raise NoValue(f"{name} is NaN.")
        return value

    return Number(name, title, read)


def plan_of(
    function: Function, over: Mapping[str, Axis], fixed: Mapping[str, float], level: str, most_cells: float
) -> Plan:
    """Return the plan of a function, which is called at one cell, or at a few until one has a result.

    Raises `InvalidParameter`, `WorkLimit`.
    """
    name = _name(function)
    defaults = _defaults(function, (*over, *fixed))
    calls = _Calls(function, _LEVEL in defaults)
    defaults.pop(_LEVEL, None)
    parameters = (Parameter(each, each, each, value, (0.0, 1.0), 0.1, _BOUNDS) for each, value in defaults.items())
    what = Computation(name, name, function, calls, tuple(parameters), {}, Kind.MAP, lambda found, exact: math.nan)
    plan = Plan.of(what, (), level, over, fixed, most_cells, _source(function))
    fields = _fields(calls, plan)
    title = (inspect.getdoc(_inner(function)) or name).partition("\n")[0]
    if taken := {*fields, *(() if fields else (name,))} & {*defaults, "status"}:
        raise InvalidParameter(f"{name} returns {min(taken)!r}, the name of another variable: choose another name.")
    numbers = {each: _number(each, title, each) for each in fields} or {name: _number(name, title, None)}
    what = replace(what, numbers=numbers, call=replace(calls, fields=fields))
    return replace(plan, computation=what, numbers=tuple(numbers))


def _fields(calls: _Calls, plan: Plan) -> tuple[str, ...]:
    """Return the fields of a function's results, none for numbers, from the first cell that has one."""
    failed: Exception | None = None
    for cell in sorted(set(np.linspace(0, plan.cells - 1, _TRIALS).astype(int).tolist())):
        try:
            columns = plan.columns(np.array([cell]))
            found = calls(as_level(plan.level), **{name: column.item() for name, column in columns.items()})
            return tuple(getattr(found, "_fields", ()))
        except Exception as error:
            failed = failed or error
    raise InvalidParameter(f"{plan.computation.key} failed at all cells that were tried; first: {failed}.")


def _defaults(function: Function, given: tuple[str, ...]) -> dict[str, float]:
    """Return the parameters of a function that a sweep can give, with their numbers, NaN without one.

    given : names of the sweep, for functions with `**kwargs` or with defaults that are no numbers.
    """
    try:
        signature = dict(inspect.signature(function).parameters)
    except (TypeError, ValueError):
        signature = {}
    kinds = {one.kind for one in signature.values()}
    if not signature or inspect.Parameter.POSITIONAL_ONLY in kinds:
        name = _name(function)
        raise InvalidParameter(f"{name} has no named parameters: wrap it, as in `def f(x): return {name}(x)`.")
    found: dict[str, float] = {}
    for each, one in signature.items():
        if one.kind in _BY_NAME:
            if isinstance(one.default, Real) and not isinstance(one.default, bool):
                found[each] = float(one.default)
            elif one.default is inspect.Parameter.empty or each in (*given, _LEVEL):
                found[each] = math.nan
    if inspect.Parameter.VAR_KEYWORD in kinds:
        found = dict.fromkeys(given, math.nan) | found
    return found


def _inner(function: Function) -> Function:
    """Return the function inside `functools.partial`."""
    while isinstance(function, partial):
        function = function.func
    return function


def _name(function: Function) -> str:
    inner = _inner(function)
    name = str(getattr(inner, "__name__", type(inner).__name__))
    return name if name.isidentifier() else "value"


def _source(function: Function) -> str:
    """Return the text of a function, or its name where there is none."""
    try:
        return textwrap.dedent(inspect.getsource(_inner(function)))
    except (OSError, TypeError):
        return _name(function)
