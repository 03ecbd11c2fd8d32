"""Computations of every system with a section, each declared once."""

from __future__ import annotations

from collections.abc import Iterator

from hess_mechanics.catalogue.declared import Computation
from hess_mechanics.dynamics.motions import Motions

__all__ = ["computations"]


def computations(of: Motions) -> Iterator[Computation]:
    """Yield the computations of the section of a system."""
    return iter(())
