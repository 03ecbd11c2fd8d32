"""The states that a file will hold: the points along sliders, chosen before anything is computed."""

from __future__ import annotations

import itertools
import math
import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from hess_explorer.page.controls import slider_limits
from hess_explorer.protocol.specs import NumberSpec, Values
from hess_explorer.scenes.framework.scene import Scene
from hess_mechanics.errors import InvalidParameter

MAX_STATES = 4000
"""Maximum number of states of a family."""

_MOST_VALUES = 400
_DIGITS = 4
"""Digits of the values, counted from the leading digit of the range of a slider."""
_SLIDER = re.compile(r"(?P<name>\w+)=(?P<low>[^:=]+):(?P<high>[^:=]+)(?::(?P<count>\d{1,4}))?")


@dataclass(frozen=True)
class StateFamily:
    """The states through which the sliders of a file move.

    Attributes
    ----------
    scene : Scene
        The scene.
    base : mapping of str
        Values of the first state.
    names : tuple of str
        Names of the varied parameters.
    points : tuple of tuple of float
        Values of these parameters in each state, those of the first state first.
    drag_values : mapping of str
        Values that replace those of `base` in all other states, such as the accuracy.
    """

    scene: Scene[Any]
    base: Values
    names: tuple[str, ...]
    points: tuple[tuple[float, ...], ...]
    drag_values: Values = field(default_factory=dict)

    def values(self, point: Sequence[float]) -> Values:
        """Return the values of all parameters at a point."""
        drag_values = {} if point == self.points[0] else self.drag_values
        return {**self.base, **drag_values, **dict(zip(self.names, point, strict=True))}


def values_across(low: float, high: float, count: int, own: float) -> tuple[float, ...]:
    """Return about `count` rounded values from low to high (low < high) and the value `own`, in ascending order."""
    decimals = _DIGITS - 1 - math.floor(math.log10(high - low))
    return tuple(sorted({own, *(float(one) for one in np.round(np.linspace(low, high, count), decimals))}))


def read_slider(text: str, scene: Scene[Any], base: Values, count: int) -> tuple[str, tuple[float, ...]]:
    """Return the parameter and the values of a slider that a text describes.

    Parameters
    ----------
    text : str
        NAME=LOW:HIGH or NAME=LOW:HIGH:COUNT.
    scene : Scene
        The scene.
    base : mapping
        The values of the first state.
    count : int
        The number of values by default.

    Returns
    -------
    tuple of str and tuple
        The name of the parameter, and values in ascending order, which include that of the first state.

    Raises
    ------
    InvalidParameter
        If the text is invalid, the scene has no such number, or the ends or the count are out of range.
    """
    known = {spec.name: spec for spec in scene.specs if isinstance(spec, NumberSpec)}
    found = _SLIDER.fullmatch(text)
    if found is None:
        raise InvalidParameter(f"{text!r} is not a slider: write NAME=LOW:HIGH:COUNT, such as h=0.2:3.5:80.")
    name = found["name"]
    if name not in known:
        raise InvalidParameter(
            f"The scene {scene.name} has no number {name!r} to vary: choose one of {', '.join(known)}."
        )
    try:
        low, high = float(found["low"]), float(found["high"])
    except ValueError as error:
        raise InvalidParameter(f"The ends of {text!r} are not numbers: write NAME=LOW:HIGH:COUNT.") from error
    count = int(found["count"] or count)
    least, most = known[name].bounds
    if not (low < high and least <= low and high <= most):
        raise InvalidParameter(f"{text!r}: the ends must increase and lie within [{least:g}, {most:g}].")
    if not 2 <= count <= _MOST_VALUES:
        raise InvalidParameter(f"{text!r}: a slider has 2 to {_MOST_VALUES} values.")
    return name, values_across(low, high, count, float(base[name]))


def slider_of(scene: Scene[Any], name: str, values: Values, count: int) -> tuple[float, ...]:
    """Return `count` values across the slider of a parameter, and its value in the state; empty if not a number."""
    spec = next(spec for spec in scene.specs if spec.name == name)
    if not isinstance(spec, NumberSpec):
        return ()
    low, high, _ = slider_limits(spec, scene.limits(values))
    return values_across(low, high, count, float(values[name]))


def family(
    scene: Scene[Any],
    base: Values,
    sliders: Sequence[tuple[str, tuple[float, ...]]],
    *,
    grid: bool = False,
    drag_values: Values | None = None,
) -> StateFamily:
    """Return the states of sliders through a state.

    Parameters
    ----------
    scene : Scene
        The scene.
    base : mapping
        The values of the state.
    sliders : sequence of (str, tuple)
        The name and the values of each slider.
    grid : bool
        True for all combinations of their values; by default each slider has its own line through the state.
    drag_values : mapping of str, optional
        Values that replace those of `base` in all states but the first.

    Returns
    -------
    StateFamily
        The states.

    Raises
    ------
    InvalidParameter
        If there are more than `MAX_STATES`, or a parameter has two sliders.
    """
    names, sides = tuple(name for name, _ in sliders), [values for _, values in sliders]
    if len(set(names)) < len(names):
        raise InvalidParameter(f"Vary each parameter once, not {', '.join(names)}.")
    first = tuple(float(base[name]) for name in names)
    lengths = [*map(len, sides)]
    count = math.prod(lengths) if grid else sum(lengths)
    if count > MAX_STATES:
        raise InvalidParameter(f"These are {count} states; a file holds at most {MAX_STATES}: choose fewer values.")
    if grid and sides:
        # Run through each row in alternating directions, so that consecutive states are neighbours.
        points = _snake(sides)
    else:
        points = [(*first[:i], value, *first[i + 1 :]) for i, side in enumerate(sides) for value in side]
    return StateFamily(scene, base, names, tuple(dict.fromkeys([first, *points])), drag_values or {})


def _snake(sides: Sequence[Sequence[float]]) -> list[tuple[float, ...]]:
    *outer, last = sides
    rows = itertools.product(*outer)
    return [(*row, value) for i, row in enumerate(rows) for value in (last if i % 2 == 0 else last[::-1])]
