"""The catalogue: every system and every computation, declared once.

Commands, sweeps, charts, the trade-off between speed and accuracy and the documentation read it.  Computations of every
system with a motion are declared in `of_motions`, those of every system with a section in `of_sections`, and those of a
single problem in `of_problems`.

>>> from hess_mechanics.catalogue import find
>>> find("circle-map").compute({"h": 1.5, "f": 0.6, "a": 0.5}).kind
'hyperbolic'
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from difflib import get_close_matches
from functools import cache

from hess_mechanics.catalogue import of_motions, of_problems, of_sections
from hess_mechanics.catalogue.declared import Choice, Computation, NoValue, Number, declare
from hess_mechanics.dynamics.motions import Motions, section_of, state_motions
from hess_mechanics.dynamics.system import System, declarations, systems
from hess_mechanics.errors import InvalidParameter

__all__ = [
    "Choice",
    "Computation",
    "Motions",
    "NoValue",
    "Number",
    "catalogue",
    "computations_of",
    "find",
    "motions",
]


@cache
def motions() -> Mapping[str, Motions]:
    """Return the motions of all systems by name: from any state, and from a point of each section.

    Returns
    -------
    mapping of str to Motions
        The motions, by their own names: "suslov" and "suslov-section", for example.
    """
    result = {name: state_motions(system) for name, system in systems().items()}
    result |= {one.name: one for one in declarations("SECTION") if isinstance(one, Motions)}
    sectioned = {one.system.name for one in result.values() if one.section is not None}
    for name, system in systems().items():
        if name not in sectioned and (section := section_of(system)) is not None:
            result[section.name] = section
    return result


def computations_of(system: System | Motions) -> Mapping[str, Computation]:
    """Return the computations of a user's system.

    Parameters
    ----------
    system : System or Motions
        The system, or only its motions from any state or from a section.

    Returns
    -------
    mapping of str to Computation
        The computations by name and system, such as "orbit suslov"; none of a section if the system has no default one.
    """
    both = [system] if isinstance(system, Motions) else [state_motions(system), section_of(system)]
    return {one.key: one for of in both if of is not None for one in _of(of)}


def _of(of: Motions) -> Iterator[Computation]:
    for one in of_motions.computations(of.system):
        yield declare(of, one)
    if of.section is not None:
        example = of.section({each.name: each.default for each in of.parameters})
        for one in of_sections.computations(example, of.period):
            yield declare(of, one, on_section=True)


@cache
def catalogue() -> Mapping[str, Computation]:
    """Return all computations.

    Returns
    -------
    mapping of str to Computation
        The computations by name and system, such as "orbit suslov".
    """
    every = [*of_problems.COMPUTATIONS, *(one for of in motions().values() for one in _of(of))]
    return {one.key: one for one in every}


def find(key: str) -> Computation:
    """Return a computation of the catalogue.

    Parameters
    ----------
    key : str
        Name and system, such as "orbit suslov".

    Returns
    -------
    Computation
        The computation.

    Raises
    ------
    InvalidParameter
        If there is no such computation; the message lists those with similar names, or else all names without system.
    """
    every = catalogue()
    if isinstance(key, str) and key in every:
        return every[key]
    close = get_close_matches(str(key), every, 3, 0.4) or [*dict.fromkeys(one.name for one in every.values())]
    raise InvalidParameter(f"There is no computation {str(key)[:60]!r}: choose from {', '.join(close)}.")
