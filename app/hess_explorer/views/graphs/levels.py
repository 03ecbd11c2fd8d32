"""Curves and points of the accuracy levels, of other methods, and of the integrals of a motion."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from hess_explorer.views import theme
from hess_explorer.views.layers import Layer, Layers, line, points
from hess_mechanics.numerics.accuracy import LEVELS
from hess_mechanics.numerics.results import Array

S = TypeVar("S")
Curve = tuple[Array, Array]

_INTEGRALS = tuple(zip(theme.INTEGRALS, theme.DASHES.values(), strict=True))
_OTHERS = {"DOP853": "square", "LSODA": "triangle"}


def curves_of_levels(curve: Callable[[S, str], Curve]) -> Layers[S]:
    """Return the layers of curves of the levels, in their colours and dashes; `curve(state, name)` returns (x, y)."""

    def of(name: str) -> Layer[S]:
        return line(name, lambda s: curve(s, name), color=theme.LEVELS[name], dash=theme.DASHES[name], label=name)

    return tuple(map(of, LEVELS))


def curves_of_integrals(curve: Callable[[S, int], Curve | None]) -> Layers[S]:
    """Return the layers of curves of four integrals; `curve(state, i)` returns (x, y), or None without integral i."""

    def of(i: int, color: str, dash: str) -> Layer[S]:
        return line(f"integral-{i}", lambda s: curve(s, i), color=color, dash=dash, label=f"integral {i + 1}")

    return tuple(of(i, *look) for i, look in enumerate(_INTEGRALS))


def methods(method: Callable[[S, str], Curve], level: Callable[[S, str], Curve]) -> Layers[S]:
    """Return the layers: the curve of the Taylor method with a point per level, and the curves of SciPy's methods.

    Parameters
    ----------
    method : callable
        `method(state, name)` returns x and y (n,) of a method: "Taylor", "DOP853" or "LSODA".
    level : callable
        `level(state, name)` returns x and y (1,) of a level.
    """

    def at(name: str) -> Layer[S]:
        return points(f"at-{name}", lambda s: level(s, name), color=theme.LEVELS[name], size=12, label=name)

    def other(name: str, marker: str) -> Layers[S]:
        return (
            line(name, lambda s: method(s, name), color=theme.MUTED, dash="dashed"),
            points(
                f"{name}-marks",
                lambda s: method(s, name),
                color=theme.MUTED,
                marker=marker,
                size=10,
                label=f"{name} (SciPy), {marker}s",
            ),
        )

    return (
        line("Taylor", lambda s: method(s, "Taylor"), color=theme.MUTED),
        *map(at, LEVELS),
        *(layer for name, marker in _OTHERS.items() for layer in other(name, marker)),
    )
