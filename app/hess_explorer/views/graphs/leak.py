"""Distance of leaking orbits from the Hess manifold over time."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeVar

from hess_explorer.views import theme
from hess_explorer.views.graphs.chart import lg
from hess_explorer.views.graphs.graph import time_graph
from hess_explorer.views.layers import Layers
from hess_mechanics.euler_poisson.hess_manifold import Leak
from hess_mechanics.numerics.results import Array

S = TypeVar("S")


def distances(leaks: Callable[[S], Mapping[str, Leak]], distance: Callable[[Leak], Array]) -> Layers[S]:
    """Return the layers of the decimal logarithm of the distance over time, for two orbits.

    Parameters
    ----------
    leaks : callable
        `leaks(state)` returns the orbits "own", at the chosen accuracy, and "reference".
    distance : callable
        `distance(leak)` returns the distances (n,) along an orbit.
    """

    def curve(state: S, name: str) -> tuple[Array, Array]:
        leak = leaks(state)[name]
        return leak.run.times, lg(distance(leak))

    return (
        time_graph(
            "reference",
            lambda s: curve(s, "reference"),
            color=theme.LEVELS["reference"],
            dash="dotdash",
            label="orbit at reference accuracy",
        ),
        time_graph("own", lambda s: curve(s, "own"), color=theme.MAP, label="orbit that leaks, at the chosen accuracy"),
    )
