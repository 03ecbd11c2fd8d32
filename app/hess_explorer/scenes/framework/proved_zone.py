"""The proved cells of the bifurcation diagram, whose number grows in the background."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from hess_explorer.compute.cache import CACHE
from hess_explorer.scenes.framework.work import Work
from hess_explorer.views.text import digits
from hess_mechanics.numerics.balls import exact, has_flint
from hess_mechanics.numerics.results import Array
from hess_mechanics.suslov_hess.lock_zone import MOST_A, LockZone, cell_outline, lock_zone, refined
from hess_mechanics.suslov_hess.proof import UNDECIDED

__all__ = ["HIDDEN", "ROUNDS", "SHOWN", "ProvedZone", "known_zone", "zone_after"]

HIDDEN, SHOWN = "not shown", "shown"
ROUNDS = (30, 50, 75, 110, 160, 230, 320, 450, 600, 800, 1000)
"""Numbers of proofs of cells after which the picture is updated; the last takes some 20 s."""


@dataclass(frozen=True)
class ProvedZone:
    """The known zone: a sentence for a caption, and outlines (n, 2) of proved cells for f > 0."""

    sentence: str
    outlines: tuple[Array, ...] = ()


def zone_after(a: Fraction, h_end: float, count: int) -> LockZone:
    """Return the zone after `count` proofs, one of `ROUNDS`."""
    done = ROUNDS.index(count)
    before: LockZone = lock_zone(a, h_end, 0) if done == 0 else CACHE.get(zone_after, a, h_end, ROUNDS[done - 1])[0]
    return refined(before, count - before.tried)


def outlined(a: Fraction, h_end: float, count: int) -> tuple[float, tuple[Array, ...]]:
    """Return the decided share of the zone after `count` proofs, and closed outlines of its proved cells."""
    zone: LockZone = CACHE.get(zone_after, a, h_end, count)[0]
    found = (cell_outline(cell, h_end) for cell in zone.cells if cell.statement != UNDECIDED)
    return zone.decided, tuple(np.vstack([outline, outline[:1]]) for outline in found if len(outline) > 2)


def known_zone(work: Work, I22: float, I23: float, h_end: float) -> ProvedZone:
    """Return the known zone, or the reason why there is none; request the next round unless a slider is held."""
    if not has_flint():
        return ProvedZone("Proofs need python-flint.")
    a = exact("I23", I23) / exact("I22", I22)
    if abs(a) > MOST_A:
        return ProvedZone(f"Cells are proved for |a| ≤ {MOST_A:g} only.")
    ask = work.known if work.dragging else work.later
    known = ProvedZone("No cell is proved yet.")
    for count in ROUNDS:
        following = ask(outlined, a, h_end, count)
        if following is None:
            break
        decided, outlines = following
        growing = "" if count == ROUNDS[-1] else ", growing"
        known = ProvedZone(f"Proved cells: {digits(100.0 * decided, 3)} % of the area{growing}.", outlines)
    return known
