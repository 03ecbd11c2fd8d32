"""The (q1, q2)-plane of a point in a potential: admissible domain, equipotentials, orbit."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TypeVar

import numpy as np

from hess_explorer.views import theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.graphs.graph import axis_about_0, time_graph
from hess_explorer.views.layers import Axes, Columns, Layers, Regions, column, curves, line, region, ring
from hess_explorer.views.plane.velocity_plane import axis_about_origin, square
from hess_explorer.views.plot import Plot
from hess_explorer.views.space.poisson_sphere import gamma_columns
from hess_explorer.views.text import digits, variation_text
from hess_mechanics.numerics.results import Array, Orbit

S = TypeVar("S")


def plane_columns(orbit: Orbit, q: Array, **more: Array) -> Columns:
    """Return the columns t, q1, q2, g1, g2 and g3 of an orbit with m states (ω1, ω2, γ), and `more` columns.

    `q` (m, 2) are the positions in the plane.
    """
    return {
        "t": column(orbit.times),
        "q1": column(q[:, 0]),
        "q2": column(q[:, 1]),
        **gamma_columns(orbit.states[:, 2:]),
        **{name: column(one) for name, one in more.items()},
    }


def picture(
    title: str,
    caption: Callable[[S], Caption],
    half_width: Callable[[S], float],
    names: tuple[str, str],
    layers: Layers[S],
    dots: Mapping[str, tuple[str, str]] | None = None,
) -> Plot[S]:
    """Return the plot of the plane, with a point moving along the orbit; a click starts another orbit.

    Parameters
    ----------
    title : str
        Heading.
    caption : callable
        `caption(state)` returns the caption.
    half_width : callable
        `half_width(state)` returns half the length of both axes.
    names : tuple of str
        Names of the parameters that a click sets to q1 and q2.
    layers : sequence of Layer
        Layers from the back to the front.
    dots : mapping of str to tuple, optional
        As for `Plot`.
    """
    return Plot(
        name="domain",
        title=title,
        caption=caption,
        axes=("q₁", "q₂"),
        x=axis_about_origin(half_width),
        y=axis_about_origin(half_width),
        dot=("q1", "q2"),
        dots=dots,
        layers=layers,
        on_click=lambda s, x, y: dict(zip(names, (x, y), strict=True)),
        starts=True,
    )


def background_layers(
    edge: Callable[[S], Array], forbidden: Callable[[S], Sequence[Array]], levels: Callable[[S], Sequence[Array]]
) -> Layers[S]:
    """Return the layers below the orbit: the forbidden region in grey, and equipotentials.

    Parameters
    ----------
    edge : callable
        `edge(state)` returns the closed curve (n, 2) around the domain; its exterior is grey.
    forbidden : callable
        `forbidden(state)` returns closed curves (m, 2); their interior is grey, too.
    levels : callable
        `levels(state)` returns the equipotentials, curves (k, 2).
    """

    def grey(state: S, axes: Axes) -> Regions:
        outer = edge(state)
        # While a slider is held, the axes may be smaller or larger than the domain.
        frame = square(2.0 * max(axes.x[1], float(abs(outer).max())))
        return [[frame, outer], *([part] for part in forbidden(state))]

    return (
        region("forbidden", data_in_axes=grey, label="impossible", tag="impossible"),
        curves("levels", levels, color=theme.MUTED, width=1, label="equipotentials"),
    )


def orbit(start: Callable[[S], tuple[float, float]], label: str = "") -> Layers[S]:
    """Return the layers: the orbit along its track, and a ring at `start(state)` with the legend entry `label`."""
    return (
        line("orbit", track="orbit", columns=("q1", "q2"), color=theme.ORBIT, label="orbit", tag="orbit"),
        ring("start", lambda s: [start(s)], label=label, tag="start"),
    )


def momentum_picture(
    momentum: Callable[[S], tuple[Array, Array]], least: Callable[[S], float], is_integral: Callable[[S], bool]
) -> Plot[S]:
    """Return the plot of q1p2 − q2p1 over time, which is an integral for I11 = I22.

    Parameters
    ----------
    momentum : callable
        `momentum(state)` returns times and values (n,).
    least : callable
        `least(state)` returns the minimum half height of the axis.
    is_integral : callable
        `is_integral(state)` returns whether I11 = I22.
    """

    def about(state: S) -> Caption:
        _, values = momentum(state)
        if is_integral(state):
            return Caption(
                "q₁p₂ − q₂p₁ is an integral for I₁₁ = I₂₂.",
                f"{digits(float(values[0]))}, constant within {digits(float(np.ptp(values)), 1)}.",
            )
        return Caption("q₁p₂ − q₂p₁ is not an integral for I₁₁ ≠ I₂₂.", f"Along this orbit {variation_text(values)}.")

    return Plot(
        name="momentum",
        title="q₁p₂ − q₂p₁ against time",
        caption=about,
        axes=("t", "q₁p₂ − q₂p₁"),
        button="Show q₁p₂ − q₂p₁ against time",
        x=lambda s: (0.0, float(momentum(s)[0][-1])),
        dot=("t", "momentum"),
        y=lambda s: axis_about_0(momentum(s)[1], least(s)),
        layers=(time_graph("G", momentum, color=theme.ORBIT),),
    )
