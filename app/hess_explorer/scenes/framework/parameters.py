"""How a scene declares its parameters: fields of its state, in the words of the library param."""

from __future__ import annotations

import math
from dataclasses import field, fields, replace
from typing import Any

from hess_explorer.protocol.parameters import Choice, Number, Places, Spec
from hess_mechanics.numerics.accuracy import LEVELS

__all__ = ["Slider", "accuracy_level", "choice", "number", "places", "slider_within", "specs_of"]

Slider = tuple[float, float, float]
"""(low, high, step)."""

_SPEC = "spec"


def _parameter(spec: Spec) -> Any:
    return field(default=spec.default, metadata={_SPEC: spec})


def number(symbol: str, default: float, softbounds: tuple[float, float], step: float, *, bounds: tuple[float, float],
           label: str, doc: str) -> Any:
    """A number: its slider covers `softbounds` in steps; what is typed, or comes by a link, lies within `bounds`."""
    return _parameter(Number("", symbol, label, default, softbounds, step, bounds, doc))


def choice(label: str, options: tuple[str, ...], default: str, *, doc: str) -> Any:
    """One of a fixed list of names."""
    return _parameter(Choice("", label, options, default, doc))


def places(label: str, most: int, low: tuple[float, float], high: tuple[float, float], default: str = "") -> Any:
    """Points chosen with the mouse, at most so many, between two corners; they have no control."""
    return _parameter(Places("", label, most, low, high, default))


def accuracy_level() -> Any:
    """The accuracy level, by its name."""
    return choice("Accuracy", tuple(LEVELS), "standard", doc="Promised error: draft 1e-3, standard 1e-6, precise 1e-9; "
                  "reference: the floor of double precision.")


def slider_within(largest: float) -> Slider:
    """A slider from −largest to largest, with round ends and some hundreds of round steps."""
    digits = 2 - math.floor(math.log10(largest))
    step = float(f"1e{-digits}")
    end = round(math.floor(largest / step) * step, digits)
    return -end, end, step


def specs_of(state: type[Any]) -> tuple[Spec, ...]:
    """The specifications of all parameters of a state, in the order in which they are declared."""
    return tuple(replace(one.metadata[_SPEC], name=one.name) for one in fields(state) if _SPEC in one.metadata)
