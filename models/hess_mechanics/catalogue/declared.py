"""A computation as data: what commands, sweeps, charts, the documentation and the trade know of it."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from operator import attrgetter
from typing import Any, Literal

import numpy as np

from hess_mechanics.dynamics.motions import Motions
from hess_mechanics.dynamics.return_map import ReturnMap
from hess_mechanics.errors import InvalidParameter, ModelError
from hess_mechanics.numerics.accuracy import Accuracy, Kind, Level, Status
from hess_mechanics.numerics.arguments import as_level, as_number
from hess_mechanics.numerics.labelled import Labels, Result
from hess_mechanics.numerics.results import Array, Mask
from hess_mechanics.parameters import Parameter

__all__ = ["Choice", "Computation", "Many", "NoValue", "Number", "Numbers", "largest_difference", "number_of"]

Value = float | str


class NoValue(ModelError):
    """A result has no such number, for example no period because the motion never returns."""


Reader = str | Callable[[Any], float]
"""Name of an attribute of a result, or a function of the result."""


def _read(reader: Reader, result: Any) -> float:
    return float(attrgetter(reader)(result) if isinstance(reader, str) else reader(result))


@dataclass(frozen=True)
class Number:
    """A number of a result, which sweeps and charts take.

    Attributes
    ----------
    symbol, title, unit : its symbol, its name in words, and its unit.
    reader : reads it from the result.  Raises `NoValue`.
    error_reader : reads its estimated error from the result; None without an estimate.
    turn : period of the values, for example 1 for rotation numbers; 0 if they are not periodic.
    named : values that stand for categories, with their names.
    """

    symbol: str
    title: str
    reader: Reader
    unit: str = "1"
    error_reader: Reader | None = None
    turn: float = 0.0
    named: Mapping[int, str] = field(default_factory=dict)

    def read(self, result: Any) -> float:
        """Return the number.  Raises `NoValue`."""
        return _read(self.reader, result)

    def error(self, result: Any) -> float:
        """Return its estimated error, NaN without an estimate."""
        return math.nan if self.error_reader is None else _read(self.error_reader, result)


@dataclass(frozen=True)
class Choice:
    """An argument that is a word; `sweep` and charts take its default."""

    name: str
    doc: str
    names: tuple[str, ...]
    default: str


@dataclass(frozen=True)
class Numbers(Result):
    """Numbers by name, for functions that return no `Result` of their own, or numbers that belong to another result.

    Attributes
    ----------
    values, errors : numbers by name, and the estimated errors of some of them.
    of : the result to which they belong, if there is one.
    """

    values: Mapping[str, float]
    errors: Mapping[str, float] = field(default_factory=dict)
    of: Any = None

    @property
    def status(self) -> Status:
        """Status of the result."""
        return getattr(self.of, "status", Status.OK)

    def labels(self) -> Labels:
        """Return the result to which the numbers belong, with the numbers among its facts."""
        known = Labels({}, {}) if self.of is None else self.of.labels()
        errors = {f"{name} error": value for name, value in self.errors.items()}
        return Labels(known.coords, known.variables, known.units, {**self.values, **errors, **known.facts})


def number_of(name: str, symbol: str, title: str, unit: str = "1", error: bool = False) -> Number:
    """Return a number of `Numbers`."""
    return Number(symbol, title, lambda r: r.values[name], unit, (lambda r: r.errors[name]) if error else None)


@dataclass(frozen=True)
class Many:
    """Numbers of many cells at once, NaN where there is none, and the cells without one by the type of their error."""

    numbers: Mapping[str, Array]
    missing: Mapping[type[ModelError], Mask]


@dataclass(frozen=True)
class Computation:
    """One thing that can be computed.

    Attributes
    ----------
    name : its name, such as "circle-map".
    title : its name in words.
    function : the public function, whose docstring describes it.
    call : computes it, call(accuracy, **values).  Raises `ModelError`.
    parameters : its numbers, whose defaults are the example.
    numbers : the numbers of a result by name; the first is what a sweep takes by default.
    kind : row of the table of accuracy: what a level means for it.
    error : distance of a result from a more accurate one, NaN if there is nothing to compare.
    unit : unit of this distance.
    choices : its arguments that are words.
    example : values that differ from the defaults in the example, so that it takes about a second.
    system : name of the system; empty for a computation of its own.
    source : label of the equation in the paper, or a citation.
    group : heading of its command.
    many : computes some of the numbers for many cells at once, many(accuracy, **columns).
    """

    name: str
    title: str
    function: Callable[..., Any]
    call: Callable[..., Result]
    parameters: tuple[Parameter, ...]
    numbers: Mapping[str, Number]
    kind: Kind
    error: Callable[[Any, Any], float]
    unit: str = "1"
    choices: tuple[Choice, ...] = ()
    example: Mapping[str, Value] = field(default_factory=dict)
    system: str = ""
    source: str = ""
    group: Literal["compute", "prove"] = "compute"
    many: Callable[..., Many] | None = None

    @property
    def key(self) -> str:
        """Name and system, as they are typed: "orbit suslov"."""
        return f"{self.name} {self.system}".strip()

    @property
    def doc(self) -> str:
        """The first sentences of the function's docstring."""
        return (self.function.__doc__ or "").partition("\n\n    Parameters")[0].strip()

    def parameter(self, name: str) -> Parameter:
        """Return the parameter of this name.  Raises `InvalidParameter`, which lists the names."""
        for one in self.parameters:
            if one.name == name:
                return one
        raise InvalidParameter(
            f"{self.key} has no parameter {name!r}; choose from {', '.join(one.name for one in self.parameters)}."
        )

    def number(self, name: str) -> Number:
        """Return the number of this name.  Raises `InvalidParameter`, which lists the names."""
        if name not in self.numbers:
            raise InvalidParameter(f"{self.key} has no number {name!r}; choose from {', '.join(self.numbers)}.")
        return self.numbers[name]

    def values(self, given: Mapping[str, Any] | None = None) -> dict[str, Value]:
        """Return the values of all arguments, checked; those that are not given have their defaults.

        Raises `InvalidParameter`.
        """
        given = given or {}
        words = {one.name: one for one in self.choices}
        for name in given:
            if name not in words:
                self.parameter(name)
        found: dict[str, Value] = {}
        for one in self.parameters:
            value = one.check(as_number(one.name, given.get(one.name, one.default)))
            found[one.name] = int(value) if one.whole else value
        for choice in self.choices:
            word = str(given.get(choice.name, choice.default))
            if word not in choice.names:
                raise InvalidParameter(f"{choice.name} is one of {', '.join(choice.names)}, not {word[:40]!r}.")
            found[choice.name] = word
        return found

    def compute(self, given: Mapping[str, Any] | None = None, accuracy: Accuracy = "precise") -> Result:
        """Return the result for some values; the others have their defaults.

        Raises `ModelError`.
        """
        level: Level = as_level(accuracy)
        return self.call(level, **self.values(given))


Start = Callable[[Level, Mapping[str, Any]], tuple[Any, ...]]


def moving(of: Motions) -> Start:
    """Return a function of accuracy and values that returns body and state of a motion, and the accuracy."""
    return lambda accuracy, values: (*of.start(values), accuracy)


def returning(of: Motions) -> Start:
    """Return a function of accuracy and values that returns the return map of a section, and a place of it."""

    def start(accuracy: Level, values: Mapping[str, Any]) -> tuple[Any, ...]:
        assert of.section is not None
        return ReturnMap(of.section(values), accuracy), tuple(values[one.name] for one in of.place)

    return start


def declare(
    of: Motions,
    start: Start,
    name: str,
    title: str,
    function: Callable[..., Any],
    call: Callable[..., Result],
    parameters: tuple[Parameter, ...],
    numbers: Mapping[str, Number],
    kind: Kind,
    error: Callable[[Any, Any], float],
    **more: Any,
) -> Computation:
    """Return a computation of the motions of a system, from call(*start, **further parameters)."""
    own = (*of.parameters, *of.place)
    names = {one.name for one in own}

    def run(accuracy: Level, **values: Any) -> Result:
        rest = {name: value for name, value in values.items() if name not in names}
        return call(*start(accuracy, values), **rest)

    return Computation(
        name,
        f"{title}: {of.title}",
        function,
        run,
        (*own, *parameters),
        numbers,
        kind,
        error,
        system=of.name,
        source=of.source,
        **more,
    )


def largest_difference(values: Any, exact: Any, turn: float = math.inf) -> float:
    """Return the largest difference of two arrays of one shape, up to full turns; NaN if the shapes differ."""
    one, other = np.asarray(values, float), np.asarray(exact, float)
    if one.shape != other.shape or not one.size:
        return math.nan
    away = one - other
    if math.isfinite(turn):
        away = away - turn * np.round(away / turn)
    return float(np.max(np.abs(away)))
