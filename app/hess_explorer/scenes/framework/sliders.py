"""Declarations of a scene's parameters, as fields of its state; "bounds" and "softbounds" as in the library param."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import field, fields, replace
from inspect import get_annotations
from typing import Any

from hess_explorer.protocol.specs import ChoiceSpec, Formula, NumberSpec, Points, Spec, Value
from hess_explorer.scenes.framework.work import AUTO
from hess_mechanics.numerics.accuracy import LEVELS
from hess_mechanics.parameters import Group, Parameter

Slider = tuple[float, float, float]
"""Range and step of a slider: (low, high, step)."""

ONE_TURN = (-math.pi, math.pi)
"""Bounds of an angle that a click sets: a picture shows one turn."""

TURN = 3.14159
"""Bound on the angles of points in a link: π, rounded down."""
_SPEC = "spec"
HIDDEN, SHOWN = "not shown", "shown"


def declare(spec: Spec, compare: bool = True) -> Any:
    """Return the dataclass field of a parameter.

    Parameters
    ----------
    spec : Spec
        The specification.
    compare : bool
        True if results of the state can depend on the parameter.
    """
    return field(default=spec.default, metadata={_SPEC: spec}, compare=compare)


def parameter(known: Parameter, default: float | None = None, **changes: Any) -> Any:
    """Declare a parameter of `hess_mechanics.parameters`.

    Parameters
    ----------
    known : Parameter
        Its description.
    default : float, optional
        Another default.
    **changes
        Other fields of `Parameter`, such as softbounds, step or doc.  Give a reason for other bounds in a comment.
    """
    return declare(NumberSpec(**known.fields(default=known.default if default is None else default, **changes)))


def number(
    symbol: str,
    default: float,
    softbounds: tuple[float, float],
    step: float,
    *,
    bounds: tuple[float, float],
    label: str,
    doc: str,
    group: Group = "State",
    meaning: str = "",
) -> Any:
    """Declare a number: its slider covers `softbounds` in steps; typed values and links are limited to `bounds`.

    Parameters
    ----------
    symbol : str
        Symbol of the number.
    default : float
        Default value.
    softbounds : (float, float)
        Ends of the slider.
    step : float
        Step of the slider.
    bounds : (float, float)
        Smallest and largest value.
    label : str
        Label of the control.
    doc : str
        Tooltip of the control.
    group : str
        Group of the control.
    meaning : str
        Meaning by which other scenes recognize the parameter; by default the label.
    """
    return declare(NumberSpec("", symbol, label, default, softbounds, step, bounds, doc, group, meaning=meaning))


def choice(label: str, options: tuple[str, ...], default: str, *, doc: str, group: Group = "Computation") -> Any:
    """Declare a choice from a fixed list of names.

    Parameters
    ----------
    label : str
        Label of the control.
    options : tuple of str
        The names.
    default : str
        Default name.
    doc : str
        Tooltip of the control.
    group : str
        Group of the control.
    """
    return declare(ChoiceSpec("", label, options, default, doc, group))


def formula(label: str, default: str, reads: Callable[[str], object], *, doc: str, group: Group = "Body") -> Any:
    """Declare a formula.

    Parameters
    ----------
    label : str
        Label of the control.
    default : str
        Default formula.
    reads : callable
        Parses the formula; raises `InvalidParameter` for an invalid text.
    doc : str
        Tooltip of the control.
    group : str
        Group of the control.
    """
    return declare(Formula("", label, default, doc, group, reads))


def points(label: str, most: int, low: tuple[float, float], high: tuple[float, float], default: str = "") -> Any:
    """Declare points that are set with the mouse; they have no control.

    Parameters
    ----------
    label : str
        Label in messages.
    most : int
        Largest number of points.
    low, high : (float, float)
        Lower left and upper right corner of the rectangle that contains the points.
    default : str
        Default points as a text "x,y;x,y"; by default none.
    """
    return declare(Points("", label, most, low, high, default))


def accuracy_level() -> Any:
    """Declare the level of accuracy, with one description for all scenes."""
    return choice(
        "Accuracy",
        (*LEVELS, AUTO),
        "standard",
        doc="Promised error of an orbit: draft 1e-3, standard 1e-6, precise 1e-9; reference: the floor of "
        "double precision. An orbit at reference takes 0.67 to 3.1 × as long as at draft, whose error is "
        "up to 0.22 pixels. Draft computes 25 % of the crossings of a section (3.6 to 7.2 ×, error up to "
        "1.3 pixels) and 33 % of the cells of basins along a side (7.7 ×, 0.41 % of the cells change). "
        "Auto: the cheapest level that is right to half a pixel.",
    )


def show_proved_error() -> Any:
    """Declare the choice whether a rigorous bound on the orbit's error is computed."""
    return choice(
        "Rigorous error bound",
        (HIDDEN, SHOWN),
        HIDDEN,
        doc="Rigorous upper bound on the orbit's error, on the status line. Where it exceeds a pixel, a band and "
        "circles enclose the true orbit at the times of the samples.",
    )


def exponent_time(default: float, longest: float, most: float, what: str) -> Any:
    """Declare the averaging time along the orbit.

    Parameters
    ----------
    default : float
        Default time.
    longest : float
        Upper end of the slider.
    most : float
        Largest typed value.
    what : str
        Name of the averaged quantity with its verb, such as "the exponent is".
    """
    return number(
        "T",
        default,
        (10.0, longest),
        10.0,
        bounds=(1.0, most),
        label="Time of the exponent",
        group="Computation",
        doc=f"Time over which {what} averaged.",
    )


def time_span(default: float, longest: float, *, step: float = 1.0, most: float = 1e4, what: str = "the orbit") -> Any:
    """Declare a time span.

    Parameters
    ----------
    default : float
        Default time.
    longest : float
        Upper end of the slider.
    step : float
        Step of the slider.
    most : float
        Largest typed value.
    what : str
        Name of the motion, as in "the orbit".
    """
    return number(
        "t",
        default,
        (1.0, longest),
        step,
        bounds=(0.01, most),
        label="Time span",
        doc=f"Time for which {what} is followed.",
        group="Computation",
    )


def redeclare(state: type[Any], name: str, default: Value | None = None, **changes: Any) -> Any:
    """Declare a parameter of another state again; `default` and `changes` replace fields of its specification."""
    spec: Any = next(one for one in specs_of(state) if one.name == name)
    return declare(replace(spec, default=spec.default if default is None else default, **changes))


def slider_within(largest: float) -> Slider:
    """Return a slider with the round ends ±largest, rounded towards 0, in 200 to 2000 round steps; largest > 0."""
    digits = 2 - math.floor(math.log10(largest))
    step = float(f"1e{-digits}")
    end = round(math.floor(largest / step) * step, digits)
    return -end, end, step


def specs_of(state: type[Any]) -> tuple[Spec, ...]:
    """Return the specifications of all parameters of a class of states, with those of its bases, swarm and chart.

    The parameters of a class come before those of its bases; those that do not change other results come last.  A
    parameter that is declared again keeps its place.
    """
    level = {name: i for i, one in enumerate(state.__mro__) for name in get_annotations(one)}
    own = [one for one in fields(state) if _SPEC in one.metadata]
    own.sort(key=lambda one: (not one.compare, level[one.name]))
    return tuple(replace(one.metadata[_SPEC], name=one.name) for one in own)
