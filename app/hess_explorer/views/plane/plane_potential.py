"""The motion with e on a principal axis in a potential U(γ1, γ2), in the (q1, q2)-plane."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

import numpy as np

from hess_explorer.views import theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.layers import curves, line, ring
from hess_explorer.views.plane.plane_domain import background_layers
from hess_explorer.views.plane.velocity_plane import axis_about_origin
from hess_explorer.views.plot import Plot
from hess_explorer.views.text import digits
from hess_mechanics.numerics.results import Array
from hess_mechanics.suslov.plane_potential import (
    PlaneMotion,
    PotentialBody,
    forbidden,
    level_curve,
)

S = TypeVar("S")

_LEVELS = (0.1, 0.25, 0.5, 0.75, 0.95)
"""Levels of the equipotentials, in units of the largest U on the edge."""


def caption(body: PotentialBody, motion: PlaneMotion) -> Caption:
    """Return the caption of a motion: period and closure error, or why no period is known and how constant F2 is."""
    if motion.is_fixed_point:
        return Caption("A fixed point: nothing changes.")
    if motion.period is not None:
        return Caption(
            "Periodic, with two equator crossings.",
            f"T = {digits(motion.period)}, returns to its start within {digits(motion.closure_error, 1)}.",
        )
    integral = (
        f"F₂ is constant within {digits(motion.integral, 1)}: integrable."
        if body.separates
        else f"F₂ changes by {digits(100.0 * motion.integral, 2)} %."
    )
    if motion.is_one_sided:
        return Caption("The motion does not reach the equator.", f"γ₃ keeps its sign. {integral}")
    return Caption(
        "Fewer than two equator crossings.", f"Up to t = {digits(float(motion.orbit.times[-1]))}. {integral}"
    )


def _largest(body: PotentialBody) -> float:
    angle = np.linspace(0.0, 2.0 * np.pi, 121)
    return float(body.potential(np.stack([np.cos(angle), np.sin(angle)], axis=-1)).max())


def picture(
    name: Callable[[S], str],
    body: Callable[[S], PotentialBody],
    motion: Callable[[S], PlaneMotion],
    half_width: Callable[[S], float],
) -> Plot[S]:
    """Return the plot of the domain: equipotentials of U, and the motion from the chosen start.

    Parameters
    ----------
    name : callable
        `name(state)` returns the name of the potential.
    body : callable
        `body(state)` returns the body.
    motion : callable
        `motion(state)` returns the motion.
    half_width : callable
        `half_width(state)` returns half the length of both axes.
    """

    def edge(state: S) -> Array:
        angle = np.linspace(0.0, 2.0 * np.pi, 241)
        return body(state).q_of(np.stack([np.cos(angle), np.sin(angle)], axis=-1))

    def levels(state: S) -> list[Array]:
        top = _largest(body(state))
        return [body(state).q_of(part) for share in _LEVELS for part in level_curve(body(state), share * top)]

    def too_high(state: S) -> list[Array]:
        return [body(state).q_of(part) for part in forbidden(body(state), motion(state).energy)]

    def orbit(state: S) -> tuple[Array, Array]:
        q = body(state).q_of(motion(state).orbit.states[:, 2:4])
        return q[:, 0], q[:, 1]

    def start(state: S) -> list[tuple[float, float]]:
        x, y = orbit(state)
        return [(float(x[0]), float(y[0]))]

    return Plot(
        name="potential",
        title=lambda s: f"Potential: {name(s)}",
        caption=lambda s: caption(body(s), motion(s)),
        axes=("q₁", "q₂"),
        x=axis_about_origin(half_width),
        y=axis_about_origin(half_width),
        button="Show another potential",
        layers=(
            *background_layers(edge, too_high, levels),
            curves("border", lambda s: [edge(s)], color=theme.MUTED, width=1),
            line("orbit", orbit, color=theme.ORBIT, width=1.3),
            ring("start", start),
        ),
    )
