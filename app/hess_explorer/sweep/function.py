"""A function of the user as a quantity, with the parameters of its signature and the fields of its results."""

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

from hess_explorer.sweep.grid import Axis, SweepGrid
from hess_explorer.sweep.quantity import CellArrays, CellResults, Outcome, Outcomes, Quantity, refused
from hess_mechanics.errors import InvalidParameter, ModelError
from hess_mechanics.numerics.accuracy import Level
from hess_mechanics.numerics.results import Array
from hess_mechanics.parameters import Parameter

__all__ = ["quantity_of", "sendable"]

_LEVEL = "level"
"""A parameter of this name receives the level of the sweep."""
_RESERVED = ("status", "error")
"""Names of other variables of the Dataset."""
_BOUNDS = (-sys.float_info.max, sys.float_info.max)
_BY_NAME = (inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.KEYWORD_ONLY)
_TRIALS = 16
"""Maximum number of cells at which a function is called to learn its fields."""

Function = Callable[..., Any]


@dataclass(frozen=True)
class _Calls:
    """`Quantity.compute` of a function; fields : those of its named tuples, empty for a number."""

    function: Function
    takes_level: bool
    fields: tuple[str, ...] = ()

    def call(self, cell: Mapping[str, float], level: Level) -> Any:
        return self.function(**cell, **({_LEVEL: level} if self.takes_level else {}))

    def __call__(self, cells: CellArrays, level: Level) -> CellResults:
        count = next(iter(cells.values())).size
        values = np.full((count, len(self.fields)) if self.fields else count, np.nan)
        status: Outcomes = np.full(count, Outcome.OK, np.uint8)
        why: dict[int, str] = {}
        for i, cell in enumerate(_rows(cells)):
            try:
                values[i] = _numbers(self.call(cell, level), self.fields)
            except (ModelError, ArithmeticError) as error:
                status[i], why[i] = refused(error, cell)
            # Not logged as an error of this package: call the function to see it.
            except Exception as error:
                status[i], why[i] = Outcome.FAILED, f"{type(error).__name__}: {error}"
            else:
                if np.isnan(values[i]).any():
                    status[i] = Outcome.NO_VALUE
        return CellResults(values, np.full(count, np.nan), status, why)


def quantity_of(
    function: Function, over: Mapping[str, Axis], fixed: Mapping[str, float], level: Level, most: int
) -> Quantity:
    """Return a function as a quantity; it is called at one cell, or at a few until one has a result.

    Raises `InvalidParameter`, `WorkLimit`.
    """
    name = _name(function)
    defaults = _defaults(function, (*over, *fixed))
    calls = _Calls(function, _LEVEL in defaults)
    defaults.pop(_LEVEL, None)
    what = Quantity(
        name,
        name,
        name,
        "",
        (inspect.getdoc(_inner(function)) or "").partition("\n")[0],
        tuple(
            Parameter(each, each, each, math.nan if value is None else value, (0.0, 1.0), 0.1, _BOUNDS)
            for each, value in defaults.items()
        ),
        calls,
        needed=tuple(each for each, value in defaults.items() if value is None),
        source=_source(function),
    )
    fields = _fields(calls, SweepGrid.of(what, over, fixed, most), level)
    if taken := {*fields, *(() if fields else (name,))} & {*defaults, *_RESERVED}:
        raise InvalidParameter(f"{name} returns {min(taken)!r}, the name of another variable: choose another name.")
    return replace(what, parts=fields, compute=replace(calls, fields=fields))


def sendable(what: Quantity, same_process: bool) -> str | bytes | Quantity:
    """Return a quantity as a `Chunk` carries it: by its name, or pickled with the text of functions of a notebook.

    Raises `InvalidParameter`.
    """
    if what.source is None or same_process:
        return what.name if what.source is None else what
    import cloudpickle

    try:
        return bytes(cloudpickle.dumps(what))
    # Whatever the objects that the function uses raise.
    except Exception as error:
        raise InvalidParameter(
            f"{what.name} cannot be sent to other processes ({error}): leave out workers=, or define it without what "
            "cannot be pickled, such as open files and locks."
        ) from error


def _defaults(function: Function, given: tuple[str, ...]) -> dict[str, float | None]:
    """Return the parameters of a function that a sweep can give, with their numbers, None without one.

    given : names of the sweep, for functions with `**kwargs` or with defaults that are no numbers.
    """
    name = _name(function)
    try:
        signature = dict(inspect.signature(function).parameters)
    except (TypeError, ValueError):
        signature = {}
    kinds = {one.kind for one in signature.values()}
    if not signature or inspect.Parameter.POSITIONAL_ONLY in kinds:
        raise InvalidParameter(f"{name} has no named parameters: wrap it, as in `def f(x): return {name}(x)`.")
    found: dict[str, float | None] = {}
    for each, one in signature.items():
        if one.kind in _BY_NAME:
            if _is_number(one.default):
                found[each] = float(one.default)
            elif one.default is inspect.Parameter.empty or each in given or each == _LEVEL:
                found[each] = None
    if inspect.Parameter.VAR_KEYWORD in kinds:
        found |= {each: None for each in given if each not in found}
    return found


def _fields(calls: _Calls, grid: SweepGrid, level: Level) -> tuple[str, ...]:
    """Return the fields of a function's results, none for numbers, from the first cell that has one."""
    failed: Exception | None = None
    for index in sorted(set(np.linspace(0, grid.cells - 1, _TRIALS).astype(int).tolist())):
        try:
            found = calls.call(grid.cell(index), level)
        except Exception as error:
            failed = failed or error
            continue
        fields = tuple(getattr(found, "_fields", ()))
        try:
            _numbers(found, fields)
        except TypeError as error:
            raise InvalidParameter(f"{_name(calls.function)} {error}.") from None
        return fields
    raise InvalidParameter(
        f"{_name(calls.function)} failed at all cells that were tried; first: {type(failed).__name__}: {failed}."
    ) from failed


def _rows(cells: Mapping[str, Array]) -> list[dict[str, float]]:
    columns = zip(*(column.tolist() for column in cells.values()), strict=True)
    return [dict(zip(cells, row, strict=True)) for row in columns]


def _numbers(found: Any, fields: tuple[str, ...]) -> float | tuple[float, ...]:
    """Return a result as numbers.  Raises `TypeError` with the end of a sentence about the function."""
    if tuple(getattr(found, "_fields", ())) != fields:
        raise TypeError("returns other fields than at the first cell")
    return tuple(map(_number, found)) if fields else _number(found)


def _number(found: Any) -> float:
    if isinstance(found, (Real, np.bool_)) or (isinstance(found, np.ndarray) and found.shape == ()):
        return float(found)
    raise TypeError(f"returns {type(found).__name__}: let it return a number or a named tuple of numbers")


def _is_number(value: Any) -> bool:
    return isinstance(value, Real) and not isinstance(value, bool) and math.isfinite(value)


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
    """Return the text of a function, empty where there is none."""
    try:
        return textwrap.dedent(inspect.getsource(_inner(function)))
    except (OSError, TypeError):
        return ""
