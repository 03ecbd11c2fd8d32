"""Validation of arguments: numbers, integers, pairs and points.  All functions raise `InvalidParameter`."""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable, Mapping, Sequence
from functools import cache, wraps
from numbers import Integral, Real
from types import NoneType, UnionType
from typing import Any, ParamSpec, TypeVar, Union, get_args, get_origin, get_type_hints

import numpy as np

from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.accuracy import LEVELS, Accuracy, Level, level

__all__ = [
    "as_a",
    "as_cells",
    "as_integer",
    "as_level",
    "as_level_name",
    "as_number",
    "as_pairs",
    "as_parts",
    "as_point",
    "check_arguments",
    "unit_vector",
]

P = ParamSpec("P")
T = TypeVar("T")
_MOST_CELLS = 100_000
_LARGEST, _SHOWN = 2**63 - 1, 40
_EXAMPLES = {str: "'x'", float: "1.5", int: "2"}
_WORDS: dict[type, str] = {bool: "True or False", str: "a text", NoneType: "None"}


def as_a(kind: type[T], body: object) -> T:
    """Return an argument if it is an instance of a class.

    Parameters
    ----------
    kind : type
        The class.
    body : object
        The argument.

    Returns
    -------
    object
        The argument.

    Raises
    ------
    InvalidParameter
        If it is an instance of another class.
    """
    if not isinstance(body, kind):
        raise InvalidParameter(f"{_short(body)} is not a {kind.__name__}: give a hess_mechanics.{kind.__name__}(…).")
    return body


def as_level(accuracy: Accuracy) -> Level:
    """Return an accuracy level, given as a `Level` or by its name.

    Parameters
    ----------
    accuracy : str or Level
        The level.

    Returns
    -------
    Level
        The level.

    Raises
    ------
    InvalidParameter
        If there is no level of this name.
    """
    return accuracy if isinstance(accuracy, Level) else level(accuracy)


def as_level_name(accuracy: Accuracy) -> str:
    """Return the name of one of the four levels, given by name or as the level itself.

    Parameters
    ----------
    accuracy : str or Level
        The level.

    Returns
    -------
    str
        Its name.

    Raises
    ------
    InvalidParameter
        If it is not one of the four levels, or if there is no level of this name.
    """
    result = as_level(accuracy)
    if LEVELS.get(result.name) != result:
        raise InvalidParameter(f"Only a named level is possible here: choose one of {', '.join(LEVELS)}.")
    return result.name


def as_number(name: str, value: Any) -> float:
    """Return a finite number as a float.

    Parameters
    ----------
    name : str
        Name of the argument, for the message.
    value : object
        The argument.

    Returns
    -------
    float
        The number.

    Raises
    ------
    InvalidParameter
        If it is not a finite real number; True, False and texts do not count as numbers.
    """
    if isinstance(value, bool) or not isinstance(value, Real):
        raise InvalidParameter(f"{name} = {_short(value)} is not a number; write it like 1.5 or -2e-3.")
    try:
        number = float(value)
    except OverflowError:
        number = math.inf
    if not math.isfinite(number):
        raise InvalidParameter(f"{name} is not a finite number; write one like 1.5 or -2e-3.")
    return number


def as_integer(name: str, value: Any, low: int, high: int) -> int:
    """Return an integer in a range.

    Parameters
    ----------
    name : str
        Name of the argument, for the message.
    value : object
        The argument.
    low, high : int
        Smallest and largest value.

    Returns
    -------
    int
        The integer.

    Raises
    ------
    InvalidParameter
        If it is not an integer from `low` to `high`, both included; floats, True and False do not count as integers.
    """
    if isinstance(value, bool) or not isinstance(value, Integral) or not low <= int(value) <= high:
        raise InvalidParameter(f"{name} = {_short(value)} is not a whole number from {low} to {high}.")
    return int(value)


def as_parts(name: str, value: Any, count: int | None = None) -> tuple[Any, ...]:
    """Return the parts of a sequence, or of another iterable, as a tuple.

    Parameters
    ----------
    name : str
        Name of the argument, for the message.
    value : object
        The argument.
    count : int, optional
        Number of parts.  By default any.

    Returns
    -------
    tuple
        The parts.

    Raises
    ------
    InvalidParameter
        If it is not iterable, is a text or a mapping, or does not have this number of parts.
    """
    if isinstance(value, (str, Mapping)) or not np.iterable(value):
        raise InvalidParameter(f"{name} = {_short(value)} is not a sequence{'' if count is None else f' of {count}'}.")
    parts = tuple(value)
    if count not in (None, len(parts)):
        raise InvalidParameter(f"{name} = {_short(value)} must have {count} parts.")
    return parts


def as_cells(cells: Any) -> tuple[int, int]:
    """Return the numbers of cells of a window.

    Parameters
    ----------
    cells : object
        The argument.

    Returns
    -------
    (int, int)
        Numbers of cells across and up.

    Raises
    ------
    InvalidParameter
        If these are not two positive integers, or there are more than 100 000 cells.
    """
    m, n = (as_integer("cells", side, 1, _MOST_CELLS) for side in as_parts("cells", cells, 2))
    if m * n > _MOST_CELLS:
        raise InvalidParameter(f"{m * n} cells are too many: choose at most {_MOST_CELLS}.")
    return m, n


def as_pairs(name: str, points: Any) -> list[tuple[float, float]]:
    """Return points of a plane as pairs of floats.

    Parameters
    ----------
    name : str
        Name of the argument, for the message.
    points : object
        The argument.

    Returns
    -------
    list of (float, float)
        The points.

    Raises
    ------
    InvalidParameter
        If it is not a sequence of pairs of finite numbers.
    """
    try:
        return [(as_number(name, x), as_number(name, y)) for x, y in points]
    except InvalidParameter:
        raise
    except (TypeError, ValueError):
        raise InvalidParameter(
            f"{name} = {_short(points)} is not a list of points; write them like [(0.0, 0.5), (1.0, 0.2)]."
        ) from None


def as_point(names: tuple[str, ...], point: Any) -> tuple[float, ...]:
    """Return a point as a tuple with one float per coordinate.

    Parameters
    ----------
    names : tuple of str
        Names of the coordinates, for the message.
    point : object
        The argument.

    Returns
    -------
    tuple of float
        The coordinates.

    Raises
    ------
    InvalidParameter
        If it does not have one finite number for each coordinate.
    """
    try:
        return tuple(as_number(name, x) for name, x in zip(names, point, strict=True))
    except InvalidParameter:
        raise
    except (TypeError, ValueError):
        raise InvalidParameter(
            f"{_short(point)} is not a point with these coordinates: give {len(names)} numbers, {', '.join(names)}."
        ) from None


# ---- annotations ----------------------------------------------------------------------------------------------------


def check_arguments(function: Callable[P, T]) -> Callable[P, T]:
    """Return a function that first checks and converts its arguments according to their annotations.

    Numbers become floats or integers, sequences of numbers become arrays, and a single number counts as such a
    sequence.  The shape of arrays, and objects that are described by a protocol, such as bodies, are left to the
    function.  NumPy's warnings about floating-point errors are off while it runs.

    Parameters
    ----------
    function : callable
        The function, with annotations.

    Returns
    -------
    callable
        The function that checks; it raises `InvalidParameter` if an argument is missing, unknown or of another kind.
    """
    signature = inspect.signature(function)
    kinds: dict[str, Any] = {}

    @wraps(function)
    def run(*args: P.args, **named: P.kwargs) -> T:
        if not kinds:
            kinds.update(get_type_hints(function))
        try:
            given = signature.bind(*args, **named)
        except TypeError as error:
            takes = ", ".join(signature.parameters)
            raise InvalidParameter(f"{function.__name__}: {error}. It takes {takes}.") from None
        for name, value in given.arguments.items():
            given.arguments[name] = _fitted(name, kinds[name], value)
        # Results are checked for overflow, so NumPy's warnings would be noise.
        with np.errstate(all="ignore"):
            return function(*given.args, **given.kwargs)

    return run


def _fitted(name: str, kind: Any, value: Any) -> Any:
    """Return a value converted to the type of its annotation.  Raises `InvalidParameter`."""
    if type(value) is kind is not float:
        return value
    if kind == Accuracy:
        as_level(value)
        return value
    origin, inner = _parts_of(kind)
    if origin in (Union, UnionType):
        return _one_of(name, inner, value)
    if isinstance(value, np.ndarray) and value.ndim == 0:
        value = value[()]
    if origin is np.ndarray:
        return _as_array(name, value)
    if origin is not None and issubclass(origin, Mapping):
        if not isinstance(value, Mapping):
            raise InvalidParameter(f"{name} = {_short(value)} is not a mapping; write it like {{'E': 1.5}}.")
        return {key: _fitted(f"{name}[{key!r}]", inner[1], one) for key, one in value.items()}
    if origin is tuple:
        try:
            parts = as_parts(name, value, len(inner))
        except InvalidParameter as error:
            example = ", ".join(_EXAMPLES.get(one, "(…)") for one in inner)
            raise InvalidParameter(f"{error} Write it like ({example}).") from None
        return tuple(_fitted(name, one, part) for one, part in zip(inner, parts, strict=True))
    if origin is not None and issubclass(origin, Sequence):
        if inner[0] in (float, Sequence[float]):
            return np.atleast_1d(_as_array(name, value))
        return tuple(_fitted(name, inner[0], one) for one in as_parts(name, value))
    if kind is float:
        return as_number(name, value)
    if kind is int:
        return as_integer(name, value, -_LARGEST, _LARGEST)
    if _is_class(kind) and not isinstance(value, (bool, np.bool_) if kind is bool else kind):
        raise InvalidParameter(f"{name} = {_short(value)} is not {_WORDS.get(kind, f'a {kind.__name__}')}.")
    return value


@cache
def _parts_of(kind: Any) -> tuple[Any, tuple[Any, ...]]:
    return get_origin(kind), get_args(kind)


@cache
def _is_class(kind: Any) -> bool:
    return get_origin(kind) is None and isinstance(kind, type) and not getattr(kind, "_is_protocol", False)


def _one_of(name: str, kinds: Sequence[Any], value: Any) -> Any:
    """Return a value converted to the first matching annotation."""
    if isinstance(value, np.ndarray) and value.ndim and any(_parts_of(kind)[0] is np.ndarray for kind in kinds):
        return _as_array(name, value)
    classes = tuple(kind for kind in kinds if _is_class(kind) and kind not in (float, int))
    if isinstance(value, classes):
        return value
    errors = []
    for kind in kinds:
        try:
            result = _fitted(name, kind, value)
            # A fraction or a large integer keeps its digits.
            return value if kind is float else result
        except InvalidParameter as error:
            errors.append(error)
    if len(classes) == len(kinds):
        known = ", ".join(kind.__name__ for kind in classes if kind is not NoneType)
        raise InvalidParameter(f"{name} = {_short(value)} is not one of these: {known}.")
    raise errors[0]


def _as_array(name: str, value: Any) -> Any:
    try:
        array = np.asarray(value)
        if array.dtype.kind not in "fiuO":
            raise ValueError
        return array.astype(float)
    except (TypeError, ValueError, OverflowError):
        raise InvalidParameter(
            f"{name} = {_short(value)} is not an array of numbers; write it like [1.5, 2.0]."
        ) from None


def _short(value: Any) -> str:
    """Return the beginning of the representation of a value; integers of thousands of digits have none."""
    if isinstance(value, (list, tuple)):
        value = value[:_SHOWN]
    try:
        text = f"an array of shape {value.shape}" if isinstance(value, np.ndarray) else repr(value)
    except ValueError:
        text = "a very large integer"
    return text if len(text) <= 80 else f"{text[:80]}…"


def unit_vector(gamma: Sequence[float]) -> tuple[tuple[float, float, float], str | None]:
    """Return γ normalised to length 1, and a note if its length was not 1.

    Parameters
    ----------
    gamma : sequence of three floats
        Direction of the vertical.

    Returns
    -------
    vector : tuple of three floats
        Unit vector.
    note : str or None
        Sentence that states the original length; None if it was 1 up to round-off.

    Raises
    ------
    InvalidParameter
        If γ is not three finite numbers, is 0, or has a length beyond the range of doubles.

    Examples
    --------
    >>> from hess_mechanics import unit_vector
    >>> unit_vector((0.6, 0.0, 0.8))
    ((0.6, 0.0, 0.8), None)
    >>> unit_vector((0.0, 3.0, 4.0))[0]
    (0.0, 0.6, 0.8)
    """
    gamma = as_point(("γ1", "γ2", "γ3"), gamma)
    length = math.hypot(*gamma)
    if not (math.isfinite(length) and length > 0):
        raise InvalidParameter(
            f"γ has the length {length:g}: give a finite nonzero vector, the direction of the vertical."
        )
    g1, g2, g3 = (g / length for g in gamma)
    note = None if abs(length - 1) <= 1e-15 else f"γ had length {length:.12g}; it was normalised to 1."
    return (g1, g2, g3), note
