"""What scenes of the Suslov–Hess tori compute over parameters: maps of ρ, lines of ρ, the boundary of the lock zone."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from hess_explorer.scenes.framework.trial import Trial, colour_error, curve_error
from hess_explorer.views.comparison import Cells, Curves, Frame, compared
from hess_explorer.views.graph import pieces
from hess_explorer.views.layers import Axes
from hess_explorer.views.rotation_line import JUMP, RHO
from hess_mechanics.numerics.accuracy import REFERENCE, Computation, Level, Plan
from hess_mechanics.numerics.results import Array
from hess_mechanics.suslov_hess import rotation_number as mechanics
from hess_mechanics.suslov_hess.rotation_number import ParameterLine, TorusValues

__all__ = ["boundary", "colours", "grid", "on_line"]

_COLOUR = 1.0 / 256.0
"""ρ between one colour and the next."""
_UNIT = "steps of the colour, 99 of 100 cells"

Run = Callable[[Any, Plan], Any]
FrameOf = Callable[[Any], Frame]


def colours(run: Run, frame: FrameOf) -> Trial[Any]:
    """ρ (n, m) in the bifurcation diagram, run(state, plan); NaN where there is no torus."""
    def error(s: Any, found: Array, truth: Array) -> float:
        n, m = found.shape
        # At the centres of the cells found, which are not those of the truth.
        return colour_error(found, s.colours((m, n), REFERENCE).now())

    return Trial(Computation.COLOURS, ("bifurcation",), run, error, lambda s, found: Cells(frame(s), found, _COLOUR),
                 _UNIT)


def boundary(picture: str, run: Run, frame: FrameOf) -> Trial[Any]:
    """The curve |t| = 2 (n, 2) in that picture, run(state, plan)."""
    def look(s: Any, found: Array) -> Curves:
        return Curves(frame(s), (found,) if len(found) else ())

    return Trial(Computation.CURVE, (picture,), run,
                 lambda s, found, truth: compared(look(s, found), look(s, truth)).largest, look)


def grid(sides: tuple[int, int], frame: FrameOf) -> Trial[Any]:
    """ρ and the zones over the window of a map that has these cells at `standard`."""
    def rows(s: Any, cells: tuple[int, int], level: Level) -> TorusValues:
        return mechanics.rows(s.over, s.beside, s.window, cells, 0, cells[1], level)

    def run(s: Any, plan: Plan) -> tuple[TorusValues, tuple[int, int]]:
        return rows(s, plan.grid(sides), plan.level), plan.grid(sides)

    def error(s: Any, found: tuple[TorusValues, tuple[int, int]], truth: object) -> float:
        # At the centres of the cells found, which are not those of the truth.
        values, cells = found
        return colour_error(values.rho[values.possible], rows(s, cells, REFERENCE.tightened()).rho[values.possible])

    def look(s: Any, found: tuple[TorusValues, tuple[int, int]]) -> Cells:
        values, (m, n) = found
        # What is locked has a tone of its own, as if its ρ were another one than any.
        shown = np.where(values.possible, np.where(values.locked, 2.0, values.rho), np.nan)
        return Cells(frame(s), shown.reshape(n, m), _COLOUR)

    return Trial(Computation.GRID, ("map",), run, error, look, _UNIT)


def on_line(count: int) -> Trial[Any]:
    """ρ of the tori on a line, and that of the other family, at so many places at `standard`."""
    def at(line: ParameterLine, epsilon: float, places: int, level: Level, turns: int) -> Array:
        values = mechanics.along(line, places, level)
        return np.stack([np.where(values.possible, values.rho, np.nan),
                         mechanics.perturbed_along(line, places, epsilon, level, turns)])

    def error(s: Any, found: Array, truth: object) -> float:
        # At the places found, which are not those of the truth.
        exact = at(s.on_line, s.epsilon, found.shape[1], REFERENCE.tightened(), mechanics.TURNS)
        there = np.isfinite(found) & np.isfinite(exact)
        return curve_error(found[there], exact[there], RHO[1] - RHO[0], period=1.0) if there.any() else 0.0

    def look(s: Any, found: Array) -> Curves:
        frame = Frame(Axes(s.on_line.ends, RHO), (s.line, "ρ"))
        x = s.on_line.places(found.shape[1])
        return Curves(frame, tuple(part for rho in found for part in pieces(
            np.column_stack([x, np.nan_to_num(rho)]), np.isfinite(rho), JUMP)))

    return Trial(Computation.LINE, ("line", "trace"),
                 lambda s, plan: at(s.on_line, s.epsilon, plan.side(count), plan.level,
                                     plan.part(mechanics.TURNS)), error, look)
