"""Computations as data, for commands, sweeps, charts, the documentation, and measured times and errors of levels."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from operator import attrgetter
from typing import Any, Literal

import numpy as np

from hess_mechanics.dynamics.motions import Motions
from hess_mechanics.dynamics.return_map import ReturnMap
from hess_mechanics.dynamics.trade import LevelCost, measure
from hess_mechanics.errors import InvalidParameter, ModelError
from hess_mechanics.numerics.accuracy import PLANS, Accuracy, Kind, Level, Plan, Status
from hess_mechanics.numerics.arguments import as_level, as_number
from hess_mechanics.numerics.labelled import Labels, Result
from hess_mechanics.numerics.results import Array, Mask
from hess_mechanics.parameters import Parameter

__all__ = [
    "Choice",
    "Computation",
    "NoValue",
    "Number",
    "Scalar",
    "VectorizedResult",
    "declare",
    "largest_difference",
    "real",
]

Value = float | str


class NoValue(ModelError):
    """A result without the requested number, for example without a period because the motion never returns."""


Reader = str | Callable[[Any], float]
"""Name of an attribute of a result, or a function of the result."""


def _read(reader: Reader, result: Any) -> float:
    return float(attrgetter(reader)(result) if isinstance(reader, str) else reader(result))


@dataclass(frozen=True)
class Number:
    """A number that sweeps and charts read from a result.

    Parameters
    ----------
    symbol : str
        Symbol in formulas and pictures.
    title : str
        Name in words.
    reader : str or callable, default "value"
        Name of an attribute of a result, or a function of the result, which may raise `NoValue`.
    unit : str, default "1"
        Unit; "1" for a number without one.
    error_reader : str or callable, optional
        Likewise for the estimated error.  By default there is no estimate.
    turn : float, default 0.0
        Period of the values, for example 1 for rotation numbers; 0 if they are not periodic.
    categories : mapping of int to str, optional
        Names of the categories for which the values stand; empty for an ordinary number.
    """

    symbol: str
    title: str
    reader: Reader = "value"
    unit: str = "1"
    error_reader: Reader | None = None
    turn: float = 0.0
    categories: Mapping[int, str] = field(default_factory=dict)

    def read(self, result: Any) -> float:
        """Return the value of this number for a result.

        Parameters
        ----------
        result : object
            Result of the computation.

        Returns
        -------
        float
            The value, in `unit`.

        Raises
        ------
        NoValue
            If the result has no such number.
        """
        return _read(self.reader, result)

    def error(self, result: Any) -> float:
        """Return the estimated error of this number for a result.

        Parameters
        ----------
        result : object
            Result of the computation.

        Returns
        -------
        float
            The error, in `unit`; NaN if there is no estimate.
        """
        return math.nan if self.error_reader is None else _read(self.error_reader, result)


@dataclass(frozen=True)
class Choice:
    """An argument that is a word; `sweep` and charts take its default.

    Parameters
    ----------
    name : str
        Name of the argument.
    doc : str
        Meaning, in a sentence.
    names : tuple of str
        The words.
    default : str
        Default word.
    """

    name: str
    doc: str
    names: tuple[str, ...]
    default: str


def real(name: str, symbol: str, default: float, low: float, high: float, doc: str) -> Parameter:
    """Return a parameter of a computation that is a real number.

    Parameters
    ----------
    name : str
        Name in links, options and Python.
    symbol : str
        Symbol in formulas and pictures.
    default : float
        Default value.
    low, high : float
        Smallest and largest value allowed, also the range of a slider.
    doc : str
        Meaning, in a few words, also the label.

    Returns
    -------
    Parameter
        The parameter.
    """
    return Parameter(name, symbol, doc, default, (low, high), 0.01, (low, high), doc, "Computation")


@dataclass(frozen=True)
class Scalar(Result):
    """A number with its estimated error, and the result to which it belongs.

    Parameters
    ----------
    value : float
        The number.
    error : float, optional
        Its estimated error.  By default NaN, without an estimate.
    of : object, optional
        The result; None if the number stands alone.
    """

    value: float
    error: float = math.nan
    of: Any = None

    @property
    def status(self) -> Status:
        """Status of the result; `Status.OK` if the result has none."""
        return getattr(self.of, "status", Status.OK)

    def labels(self) -> Labels:
        """Return the labels of the result to which the number belongs.

        Returns
        -------
        Labels
            The labels; for a number that stands alone, only the number as a fact.
        """
        return Labels({}, {}, facts={"value": self.value}) if self.of is None else self.of.labels()


VectorizedResult = tuple[Mapping[str, Array], Mapping[type[ModelError], Mask]]
"""Numbers of n cells by name, shape (n,), NaN where there is none, and by type of error the mask of its cells."""


@dataclass(frozen=True)
class Computation:
    """A computation of the catalogue.

    Parameters
    ----------
    name : str
        Name, such as "circle-map".
    title : str
        Name in words, without that of the system.
    function : callable
        The public function, whose docstring describes it.
    parameters : tuple of Parameter
        Its numerical arguments, in order; their defaults, with the changes in `example`, are an example.
    numbers : mapping of str to Number
        The numbers of a result by name; the first is the default of a sweep.
    kind : Kind
        Kind of computation, which gives accuracy levels their meaning, see `accuracy.PLANS`.
    comparison : str or callable, default ""
        Values of a result that `error` compares: an attribute, or the first number by default.  Or the error, as a
        function of a result and a more accurate one.
    call : callable, optional
        Function call(accuracy, **values) that computes the result, if `function` has other arguments.  It raises a
        `ModelError` if there is no result.  In a computation that is passed to `declare`, see there.
    unit : str, default "1"
        Unit of the error.
    choices : tuple of Choice, default ()
        Its arguments that are words.
    example : mapping of str to Value, optional
        Values that differ from the defaults in the example, so that it takes about a second.
    system : str, default ""
        Name of the system, or of its motions from a section; empty for a computation that belongs to one problem.
    source : str, default ""
        Label of the equation in the paper, or a citation.
    group : {"compute", "prove"}, default "compute"
        Heading of its command.
    vectorized : callable, optional
        Function vectorized(accuracy, **columns) that computes some of the numbers for n cells at once, from an array
        (n,) for each parameter.
    """

    name: str
    title: str
    function: Callable[..., Any]
    parameters: tuple[Parameter, ...]
    numbers: Mapping[str, Number]
    kind: Kind
    comparison: str | Callable[[Any, Any], float] = ""
    call: Callable[..., Any] | None = None
    unit: str = "1"
    choices: tuple[Choice, ...] = ()
    example: Mapping[str, Value] = field(default_factory=dict)
    system: str = ""
    source: str = ""
    group: Literal["compute", "prove"] = "compute"
    vectorized: Callable[..., VectorizedResult] | None = None

    @property
    def key(self) -> str:
        """Name and system, as in a command: "orbit suslov"."""
        return f"{self.name} {self.system}".strip()

    @property
    def doc(self) -> str:
        """The docstring of the function up to its parameters; empty without a docstring."""
        return (self.function.__doc__ or "").partition("\n\n    Parameters")[0].strip()

    def parameter(self, name: str) -> Parameter:
        """Return the parameter with a given name.

        Parameters
        ----------
        name : str
            The name.

        Returns
        -------
        Parameter
            The parameter.

        Raises
        ------
        InvalidParameter
            If there is none; the message lists the names.
        """
        for one in self.parameters:
            if one.name == name:
                return one
        raise InvalidParameter(
            f"{self.key} has no parameter {name!r}; choose from {', '.join(one.name for one in self.parameters)}."
        )

    def number(self, name: str) -> Number:
        """Return the number with a given name.

        Parameters
        ----------
        name : str
            The name.

        Returns
        -------
        Number
            The number.

        Raises
        ------
        InvalidParameter
            If there is none; the message lists the names.
        """
        if name not in self.numbers:
            raise InvalidParameter(f"{self.key} has no number {name!r}; choose from {', '.join(self.numbers)}.")
        return self.numbers[name]

    def values(self, arguments: Mapping[str, Any] | None = None) -> dict[str, Value]:
        """Return the values of all arguments, checked against their ranges and choices.

        Parameters
        ----------
        arguments : mapping of str to object, optional
            Values by name; the others have their defaults.

        Returns
        -------
        dict
            The values, by name.

        Raises
        ------
        InvalidParameter
            If there is no such argument, or a value is out of range.
        """
        arguments = arguments or {}
        for name in arguments.keys() - {one.name for one in self.choices}:
            self.parameter(name)
        values: dict[str, Value] = {}
        for one in self.parameters:
            value = one.check(as_number(one.name, arguments.get(one.name, one.default)))
            values[one.name] = int(value) if one.is_integer else value
        for choice in self.choices:
            word = str(arguments.get(choice.name, choice.default))
            if word not in choice.names:
                raise InvalidParameter(f"{choice.name} = {word[:40]!r}: choose one of {', '.join(choice.names)}.")
            values[choice.name] = word
        return values

    def compute(self, arguments: Mapping[str, Any] | None = None, accuracy: Accuracy = "precise") -> Any:
        """Return the result for given values of the arguments.

        Parameters
        ----------
        arguments : mapping of str to object, optional
            Values by name; the others have their defaults.
        accuracy : str or Level, default "precise"
            Accuracy level.

        Returns
        -------
        Result
            The result; a `Scalar` if the function returns a float.

        Raises
        ------
        InvalidParameter
            If there is no such argument or accuracy level, or a value is out of range.
        ModelError
            If there is no result for these values.
        """
        result = (self.call or self.function)(accuracy=as_level(accuracy), **self.values(arguments))
        return Scalar(result) if isinstance(result, float) else result

    def error(self, result: Any, exact: Any) -> float:
        """Return the distance of a result from a more accurate result.

        Parameters
        ----------
        result : object
            The result.
        exact : object
            The more accurate result.

        Returns
        -------
        float
            The distance, in `unit`; NaN if there is nothing to compare.
        """
        if callable(self.comparison):
            return self.comparison(result, exact)
        read = attrgetter(self.comparison) if self.comparison else next(iter(self.numbers.values())).read
        return largest_difference(read(result), read(exact))

    def trade(self, arguments: Mapping[str, Any] | None = None, repeats: int = 1) -> tuple[LevelCost, ...]:
        """Return the time and the error at each level, measured on this machine.

        The error is that of `error`, compared with a run that is finer than "reference".

        Parameters
        ----------
        arguments : mapping of str to object, optional
            Values by name; the others have their defaults.
        repeats : int, default 1
            Number of runs at each level, at least 1, of which the fastest counts.

        Returns
        -------
        tuple of LevelCost
            Costs of the levels, the cheapest first.

        Raises
        ------
        ModelError
            If there is no result for these values.
        """

        def run(plan: Plan) -> Any:
            is_named = plan is PLANS[self.kind][plan.level.name]
            return self.compute(arguments, plan.level.name if is_named else plan.level)

        return tuple(measure(self.kind, run, self.error, repeats))


def declare(of: Motions, one: Computation, on_section: bool = False) -> Computation:
    """Return a computation of the motions of a system.

    Parameters
    ----------
    of : Motions
        The motions.
    one : Computation
        Computation whose `call`, or else `function`, takes the body, the initial state, its parameters by name and the
        accuracy; with `on_section` the return map, a point of the section and its parameters by name.
    on_section : bool, default False
        True for a computation of a section.

    Returns
    -------
    Computation
        The computation of this system, with the parameters of the motions before its own.
    """
    own = (*of.parameters, *of.point)
    names = {each.name for each in own}

    def call(accuracy: Level, **values: Any) -> Any:
        more = {name: value for name, value in values.items() if name not in names}
        start: tuple[Any, ...]
        if on_section and of.section is not None:
            start = ReturnMap(of.section(values), accuracy), tuple(values[each.name] for each in of.point)
        else:
            start, more["accuracy"] = of.start(values), accuracy
        return (one.call or one.function)(*start, **more)

    return replace(
        one,
        parameters=(*own, *one.parameters),
        call=call,
        system=of.name,
        source=of.source,
    )


def largest_difference(values: Any, exact: Any) -> float:
    """Return the largest absolute difference between two arrays of the same shape.

    Parameters
    ----------
    values, exact : array_like
        The arrays.

    Returns
    -------
    float
        The difference, ≥ 0; NaN if the shapes differ, the arrays are empty, or an element is NaN.
    """
    one, other = np.asarray(values, float), np.asarray(exact, float)
    if one.shape != other.shape or not one.size:
        return math.nan
    return float(np.max(np.abs(one - other)))
