"""The conformal time τ, dτ = γ3 dt, along a motion with e on a principal axis, and its Poisson brackets."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

import numpy as np

from hess_explorer.views import theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.graphs.graph import axis_about_0, pieces, thin, time_graph
from hess_explorer.views.layers import Axes, Layers, compose, curves, levels
from hess_explorer.views.plot import Plot
from hess_explorer.views.text import digits
from hess_mechanics.numerics.results import Array
from hess_mechanics.suslov.principal_axis import Conformal

S = TypeVar("S")
Transform = Callable[[S], Conformal | None]

_LEAST = 2.5
"""Half height of the axis at least, so that the brackets, of order 1 away from γ3 = 0, are visible."""


def caption(motion: Conformal) -> Caption:
    """Return the caption of a motion in both times."""
    turned = {0: "0 times", 1: "once"}.get(motion.turns, f"{motion.turns} times")
    return Caption(
        "The motion is Hamiltonian in τ.",
        f"ẋ = γ₃{{x, E}} within {digits(motion.residual, 1)}; τ reverses {turned} on the equator.",
    )


def _bracket(motion_of: Transform[S], i: int) -> Callable[[S, Axes], list[Array]]:
    """Return the parts of the graph of a Poisson bracket within the frame: on the equator it is infinite."""

    def graph(state: S, axes: Axes) -> list[Array]:
        motion = motion_of(state)
        if motion is None:
            return []
        values, top = motion.brackets[:, i], 1.5 * axes.y[1]
        kept = np.abs(values) < top
        return pieces(np.column_stack([motion.orbit.times, np.where(kept, values, 0.0)]), kept, top)

    return graph


def picture(motion_of: Transform[S], reason: Callable[[S], str], span: Callable[[S], float]) -> Plot[S]:
    """Return the plot of τ, {ω1, γ3} and {ω2, γ3} against t.

    Parameters
    ----------
    motion_of : callable
        `motion_of(state)` returns the motion, or None; the plot is then empty.
    reason : callable
        `reason(state)` returns the caption of an empty plot.
    span : callable
        `span(state)` returns the last time on the horizontal axis.
    """

    def state_caption(state: S) -> Caption:
        motion = motion_of(state)
        return Caption(numbers=reason(state)) if motion is None else caption(motion)

    layers: Layers[S] = (
        levels("levels", lambda s: [] if motion_of(s) is None else [0.0]),
        curves("first", data_in_axes=_bracket(motion_of, 0), color=theme.MAP, width=1.5, label="{ω₁, γ₃} = γ₂/(I₁₁γ₃)"),
        curves(
            "second",
            data_in_axes=_bracket(motion_of, 1),
            color=theme.MUTED,
            width=1.5,
            dash="dashed",
            label="{ω₂, γ₃} = −γ₁/(I₂₂γ₃)",
        ),
        time_graph(
            "tau",
            compose(motion_of, lambda motion: thin(motion.orbit.times, motion.tau)),
            color=theme.ORBIT,
            label="conformal time τ",
            tag="τ",
        ),
    )
    return Plot(
        name="conformal",
        title="Conformal time and brackets",
        caption=state_caption,
        axes=("t", "τ"),
        first=Axes((0.0, 60.0), (-3.0, 3.0)),
        x=lambda s: (0.0, span(s)),
        y=compose(motion_of, lambda motion: axis_about_0(motion.tau, _LEAST)),
        layers=layers,
        button="Show the conformal time",
    )
