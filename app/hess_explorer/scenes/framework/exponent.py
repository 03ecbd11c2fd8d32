"""The picture of the largest Lyapunov exponent of the orbit on show in a filled window."""

from __future__ import annotations

from typing import Any

from hess_explorer.scenes.framework.filled_window import FilledWindow
from hess_explorer.views import theme
from hess_explorer.views.graph import over_time, thinned
from hess_explorer.views.layers import Axes, Range
from hess_explorer.views.plot import Plot
from hess_explorer.views.text import digits
from hess_explorer.views.velocity_plane import nice_above

__all__ = ["exponent_picture"]


def exponent_picture() -> Plot[Any]:
    """The mean growth rate over time, and whether the orbit is regular so far."""
    return Plot(
        name="exponent", title="Largest Lyapunov exponent", caption=_about, axes=("t", "λ"),
        first=Axes((0.0, 200.0), (0.0, 1.0)), x=lambda s: (0.0, s.long), y=_axis,
        layers=(over_time("lambda", lambda s: None if s.exponent is None else thinned(
            s.exponent.times, s.exponent.rates), color=theme.ORBIT),))


def _axis(s: FilledWindow) -> Range | None:
    if s.exponent is None:
        return None
    later = s.exponent.rates[len(s.exponent.rates) // 10 :]
    return min(0.0, 1.05 * float(later.min())), nice_above(1.05 * max(1e-6, float(later.max())))


def _about(s: FilledWindow) -> str:
    exponent = s.exponent
    if exponent is None:
        return s.awaited()
    end = float(exponent.times[-1])
    kind = "falling as ln(t)/t: regular so far" if exponent.is_regular else "chaotic"
    return f"λ = {digits(exponent.value, 3)} after t = {digits(end)}, ± {digits(exponent.spread, 2)} lately: {kind}."
