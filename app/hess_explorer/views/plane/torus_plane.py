"""A torus M²(h, f) of the Hess case in the (ω1, ω2)-plane: admissible ring, an orbit, limit cycles."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

import numpy as np

from hess_explorer.views import theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.layers import Columns, Layers, Regions, line, region
from hess_explorer.views.maps.circle_map import cycles
from hess_explorer.views.plane.velocity_plane import band, ring_complement, velocity_columns
from hess_explorer.views.text import digits, range_text
from hess_mechanics.numerics.results import Array
from hess_mechanics.suslov_hess.bifurcation import TurningPoints
from hess_mechanics.suslov_hess.circle_map import CircleMap
from hess_mechanics.suslov_hess.torus import Track

S = TypeVar("S")

_PLANE = ("omega1", "omega2")


def layers(
    ring: Callable[[S], tuple[Array, Array]],
    half_width: Callable[[S], float],
    proved: Callable[[S], Regions] = lambda s: (),
) -> Layers[S]:
    """Return the layers: forbidden region, proved band, orbit, stable and unstable limit cycle.

    Parameters
    ----------
    ring : callable
        `ring(state)` returns the inner and the outer ellipse (m, 2) between which motion is possible.
    half_width : callable
        `half_width(state)` returns half the length of both axes.
    proved : callable
        `proved(state)` returns the regions that enclose the true orbit, as for `velocity_plane.band`.
    """
    return (
        region(
            "forbidden",
            lambda s: ring_complement(*ring(s), half_width(s)),
            edge=theme.MUTED,
            label="impossible",
            tag="impossible",
            is_overlay=True,
        ),
        band(proved),
        line("orbit", track="orbit", columns=_PLANE, color=theme.ORBIT, width=1.3, label="orbit", tag="orbit"),
        line(
            "stable",
            track="stable",
            columns=_PLANE,
            color=theme.STABLE,
            width=3,
            label="stable cycle",
            tag="stable cycle",
        ),
        line(
            "unstable",
            track="unstable",
            columns=_PLANE,
            color=theme.UNSTABLE,
            width=3,
            dash="dashed",
            label="unstable cycle",
            tag="unstable cycle",
        ),
    )


def phases_at_returns(track: Track, theta: CircleMap, iterates: Array) -> Array:
    """Return the phase of the last return at each time (n,) of an orbit.

    `iterates` (k,) are the phases of the returns; the last one is repeated at later times.
    """
    index = np.floor(track.orbit.times / theta.period).astype(int)
    return np.asarray(iterates[np.minimum(index, len(iterates) - 1)])


def track_columns(track: Track, **more: Array) -> Columns:
    """Return the columns of an orbit for the player: t, ω, γ and φ, and `more` columns."""
    return velocity_columns(track.times, track.omega, track.gamma, phi=track.phi, **more)


def cycle_columns(cycles: tuple[Track, Track] | None, i: int) -> Columns | None:
    """Return the columns of the stable (0) or the unstable (1) limit cycle; None without limit cycles."""
    return None if cycles is None else velocity_columns(None, cycles[i].omega, cycles[i].gamma)


def is_circle(turning_points: TurningPoints | None) -> bool:
    """Return whether the torus looks like a circle: on the bifurcation curve n3 is constant.  False for None."""
    return turning_points is not None and turning_points.roots[2] - turning_points.roots[1] < 1e-6


def caption(theta: CircleMap | None, turning_points: TurningPoints | None) -> Caption:
    """Return the caption on the behaviour of the orbit; the arguments are None on the separatrix."""
    if theta is None or turning_points is None:
        return Caption("The orbit comes to rest in infinite time.")
    orbit = {
        "hyperbolic": "The orbit tends to the stable limit cycle.",
        "parabolic": f"{cycles(theta).capitalize()}.",
    }.get(theta.kind, "No limit cycle: the orbit winds forever.")
    if is_circle(turning_points):
        orbit = "Bifurcation curve: the torus is a circle."
    return Caption(orbit, f"|w| {range_text(turning_points.initial_rho, turning_points.final_rho)}.")


def heights_caption(turning_points: TurningPoints | None) -> Caption:
    """Return the caption on the heights of the vertical; the argument is None on the separatrix."""
    if turning_points is None:
        return Caption("The vertical tends to n₃ = −1.", "The upper equilibrium.")
    n1, n2 = turning_points.roots[1:]
    if digits(n1) == digits(n2):
        return Caption("The vertical γ has constant height.", f"n₃ = {digits(n1)}.")
    return Caption("The vertical γ moves between two heights.", f"n₃ = {digits(n1)} and {digits(n2)}.")
