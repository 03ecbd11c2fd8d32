"""The graph of the spread of a swarm."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from hess_explorer.views import theme
from hess_explorer.views.layers import line
from hess_explorer.views.plot import Plot
from hess_mechanics.numerics.results import Array


def spread_picture() -> Plot[Any]:
    """Return the graph of the distance between neighbours of the swarm over time."""

    def curve(i: int) -> Callable[[Any], tuple[Array, Array] | None]:
        return lambda s: None if s.swarm_part.spread is None else (s.swarm_part.spread[0], s.swarm_part.spread[1][i])

    return Plot(
        name="spread",
        title="Spread of the swarm",
        caption=lambda s: s.swarm_part.caption,
        axes=("t", "distance of neighbours, 1 at the start"),
        log="y",
        x=lambda s: (0.0, 1.0) if s.swarm_part.spread is None else (0.0, float(s.swarm_part.spread[0][-1])),
        y=lambda s: s.swarm_part.heights,
        message=lambda s: s.swarm_part.reason,
        button="Show the spread of the swarm",
        layers=(
            line("least", curve(0), color=theme.MUTED, width=1, label="10th and 90th percentiles"),
            line("most", curve(2), color=theme.MUTED, width=1),
            line(
                "expected",
                lambda s: s.swarm_part.expected,
                color=theme.UNSTABLE,
                dash="dashed",
                label="growth at the rate in the caption",
                tag="rate",
            ),
            line("median", curve(1), color=theme.ORBIT, label="median", tag="median"),
        ),
    )
