"""The picture of the largest Lyapunov exponent of the orbit on show in a filled window."""

from __future__ import annotations

from typing import Any

import numpy as np

from hess_explorer.scenes.framework.filled_window import FilledWindow
from hess_explorer.views import theme
from hess_explorer.views.graph import over_time, thinned, with_room
from hess_explorer.views.layers import Axes, Range
from hess_explorer.views.plot import Plot
from hess_explorer.views.text import digits
from hess_explorer.views.velocity_plane import nice_above
from hess_mechanics.numerics.results import Array

__all__ = ["exponent_picture"]


def exponent_picture() -> Plot[Any]:
    """The mean growth rate over time, and whether the orbit is regular so far."""
    return Plot(
        name="exponent", title="Largest Lyapunov exponent", caption=_about, axes=("t", "λ"),
        first=Axes((0.0, 200.0), (0.0, 1.0)), x=lambda s: (0.0, s.long), y=_axis,
        layers=(over_time("lambda", _rates, color=theme.ORBIT),))


def _rates(s: FilledWindow) -> tuple[Array, Array] | None:
    if s.growth is not None:
        return np.array([0.0, s.long]), np.full(2, s.growth[0])
    return None if s.exponent is None else thinned(s.exponent.times, s.exponent.rates)


def _axis(s: FilledWindow) -> Range | None:
    if s.growth is not None:
        return with_room(np.array([0.0, s.growth[0]]), 0.1, 1e-6)
    if s.exponent is None:
        return None
    later = s.exponent.rates[len(s.exponent.rates) // 10 :]
    return min(0.0, 1.05 * float(later.min())), nice_above(1.05 * max(1e-6, float(later.max())))


def _about(s: FilledWindow) -> str:
    if s.growth is not None:
        return f"Next to the periodic orbit: ln|μ₁|/T = {digits(s.growth[0])}, from its multipliers."
    exponent = s.exponent
    if exponent is None:
        return s.awaited()
    end = float(exponent.times[-1])
    kind = "falling as ln(t)/t: regular so far" if exponent.is_regular else "chaotic"
    return f"λ = {digits(exponent.value, 3)} after t = {digits(end)}, ± {digits(exponent.spread, 2)} lately: {kind}."
