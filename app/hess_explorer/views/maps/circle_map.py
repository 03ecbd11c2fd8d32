"""The circle map Θ(φ) on the square (−π, π]², its fixed points or its invariant density, and a cobweb."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import TypeVar

import numpy as np

from hess_explorer.views import theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.graphs.graph import ANGLE, ANGLE_TICKS
from hess_explorer.views.layers import compose, curves, line, points
from hess_explorer.views.picture import Values
from hess_explorer.views.plot import Plot
from hess_explorer.views.text import digits
from hess_mechanics.numerics.results import Array
from hess_mechanics.suslov_hess.circle_map import CircleMap
from hess_mechanics.suslov_hess.invariant_measure import invariant_measure

S = TypeVar("S")
Click = Callable[[S, float, float], Values]

_COBWEB = 60
"""Number of returns in the cobweb."""
UNIFORM_HEIGHT = 0.25
"""Height of a uniform density as a share of the frame; 0 is at the bottom."""
_DENSITY = np.linspace(*ANGLE, 241)
_BEYOND = 100.0
"""Density relative to the uniform one at which the graph is clipped, beyond the frame."""


def cobweb(iterates: Array) -> tuple[Array, Array]:
    """Return x and y of the cobweb (φ0, φ0) → (φ0, φ1) → (φ1, φ1) → …"""
    return np.repeat(iterates, 2)[:-1], np.repeat(iterates, 2)[1:]


def _copies(circle_map: CircleMap) -> list[Array]:
    """Return the graph and copies shifted up and down by one turn; the frame clips them."""
    phi, theta = circle_map.graph
    return [np.column_stack([phi, theta + turn]) for turn in (0.0, -2 * math.pi, 2 * math.pi)]


def _fixed_points(circle_map: CircleMap, layer: str) -> tuple[list[float], list[float]]:
    """Return the coordinates of the fixed points of a layer: "stable", "unstable", or "merged" of a parabolic map."""
    if circle_map.kind == "parabolic":
        found = [point.phi for point in circle_map.fixed_points if layer == "merged"]
    else:
        found = [
            point.phi
            for point in circle_map.fixed_points
            if layer == ("stable" if point.log_multiplier < 0.0 else "unstable")
        ]
    return found, found


def _density(circle_map: CircleMap) -> list[Array]:
    """Return the smooth invariant density, drawn above the bottom of the frame; empty if it does not exist."""
    if circle_map.kind != "elliptic":
        return []
    relative = np.minimum(_BEYOND, 2.0 * math.pi * invariant_measure(circle_map).density(_DENSITY))
    return [np.column_stack([_DENSITY, -math.pi + UNIFORM_HEIGHT * 2.0 * math.pi * relative])]


def picture(
    map: Callable[[S], CircleMap | None],
    iterates: Callable[[S], Array | None],
    caption: Callable[[S], Caption],
    title: str = "Circle map",
    dot: tuple[str, str] | None = None,
    on_click: Click[S] | None = None,
) -> Plot[S]:
    """Return the plot of a circle map, with its fixed points or its invariant density, and a cobweb.

    Stable fixed points are filled, unstable ones and the merged one of a parabolic map are hollow.

    Parameters
    ----------
    map : callable
        `map(state)` returns the circle map; None on the separatrix.
    iterates : callable
        `iterates(state)` returns the angles (n,) of the cobweb, or None.
    caption : callable
        `caption(state)` returns the caption.
    title : str
        Heading.
    dot : tuple of str, optional
        The two columns of "orbit" that the moving point follows.
    on_click : callable, optional
        `on_click(state, x, y)` returns the parameter values that a click sets.
    """
    here = ("phi", "theta")
    return Plot(
        name="circle",
        title=title,
        caption=caption,
        axes=("φ", "Θ(φ)"),
        x=ANGLE,
        y=ANGLE,
        ticks=ANGLE_TICKS,
        dot=dot,
        message=lambda s: "" if map(s) is not None else "Separatrix: no return",
        on_click=on_click,
        starts=on_click is not None,
        layers=(
            line(
                "diagonal",
                compose(map, lambda theta: (ANGLE, ANGLE)),
                columns=here,
                color=theme.MUTED,
                dash="dotted",
                width=1.5,
                tag="diagonal",
            ),
            curves("density", compose(map, _density), color=theme.STABLE, width=1.5, label="density", tag="density"),
            line(
                "cobweb",
                compose(iterates, lambda found: cobweb(found[: _COBWEB + 1])),
                columns=here,
                color=theme.ORBIT,
                width=1,
            ),
            curves("map", compose(map, _copies), color=theme.MAP, width=2.5, label="Θ", tag="Θ"),
            *(
                points(
                    name,
                    compose(map, partial(_fixed_points, layer=name)),
                    columns=here,
                    size=12,
                    edge_width=3,
                    hollow=name != "stable",
                    color=color,
                    tag=name,
                )
                for name, color in (("merged", theme.SHEET), ("stable", theme.STABLE), ("unstable", theme.UNSTABLE))
            ),
        ),
    )


def cycles(theta: CircleMap) -> str:
    """Return the limit cycles of a torus in words; a parabolic map without a fixed point is the identity."""
    if theta.kind == "parabolic":
        return "the two cycles have merged" if theta.fixed_points else "every orbit is periodic"
    return "two limit cycles" if theta.kind == "hyperbolic" else "no cycle"


def caption(theta: CircleMap | None, proof: str = "") -> Caption:
    """Return the caption of a circle map: kind, trace, rotation number and multipliers.

    Parameters
    ----------
    theta : CircleMap or None
        The circle map; None on the separatrix.
    proof : str
        The proved statement, empty until known.  A statement on cycles replaces the kind and the enclosed numbers, one
        that there is no torus replaces the whole caption, any other text is appended.
    """
    if theta is None:
        return Caption("Separatrix: no return.")
    if "no torus" in proof:
        return Caption(numbers=proof)
    kind = f"{theta.kind.capitalize()}: {cycles(theta)}."
    trace, rho = f"|trace| = {digits(theta.trace)}", f"ρ = {digits(theta.rotation_number)}"
    if "cycle" in proof:
        statement, bounds = proof.split(", ", 1)
        return Caption(f"{statement}.", f"{rho}, {bounds}" if "|trace|" in bounds else f"{trace}, {rho}, {bounds}")
    multipliers = {
        "hyperbolic": f"; multipliers {', '.join(digits(point.multiplier) for point in theta.fixed_points)}",
        "parabolic": "; multiplier 1",
    }.get(theta.kind, "")
    numbers = f"{trace}, {rho}{multipliers}."
    return Caption(kind, f"{numbers} {proof}" if proof else numbers)


def riccati_matrix(theta: CircleMap) -> str:
    """Return the entries α and β of the Riccati matrix as text."""
    alpha, beta = theta.alpha_beta
    return (
        f"Riccati matrix α = {digits(alpha.real)} {'−' if alpha.imag < 0.0 else '+'} {digits(abs(alpha.imag))} i, "
        f"β = {digits(beta.imag)} i"
    )
