"""Motions of a system as functions of named numbers, for the catalogue of computations.

A module that defines `SYSTEM` has motions from any state.  `SECTION` beside it, or in the module of a section, gives
motions that start at a point of that section.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from hess_mechanics import parameters as known
from hess_mechanics.dynamics.system import Body, System
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.arguments import unit_vector
from hess_mechanics.parameters import Parameter

if TYPE_CHECKING:
    from hess_mechanics.dynamics.return_map import PoincareSection

__all__ = ["Motions", "body_parameters", "integer", "section_motions", "section_of", "state_motions", "with_default"]

Start = tuple[float, ...]
Values = Mapping[str, float]

_KNOWN: Mapping[str, Parameter] = {
    one.name: one
    for one in (
        *known.TENSOR,
        *known.FIELD,
        known.D,
        *known.INVERSE_MOMENTS,
        *known.CENTRE,
        known.MU,
        known.A_HESS,
        known.B_HESS,
        known.C1,
        known.C2,
        known.CUBIC,
        known.QUARTIC,
        *known.OMEGA,
        *known.GAMMA,
        *known.MOMENTUM,
        *known.REDUCED_GAMMA,
    )
}
"""Parameters and variables of the systems of the paper, by name."""
_REDUCED = {one.name: one for one in known.REDUCED_OMEGA}
_FREE = (-1e6, 1e6)
"""Bounds of a parameter or variable of a user's system."""


def with_default(of: Parameter, default: float, doc: str = "") -> Parameter:
    """Return a copy of a parameter with another default.

    Parameters
    ----------
    of : Parameter
        The original parameter.
    default : float
        The new default.
    doc : str, default ""
        New description; the old one if it is empty.

    Returns
    -------
    Parameter
        The copy.
    """
    return replace(of, default=default, doc=doc or of.doc)


def integer(name: str, symbol: str, default: float, low: float, high: float, doc: str) -> Parameter:
    """Return an integer parameter of a computation.

    Parameters
    ----------
    name : str
        Name in links, options and Python.
    symbol : str
        Symbol in formulas and pictures.
    default : float
        Default value.
    low, high : float
        Smallest and largest value.
    doc : str
        Meaning, in a few words.

    Returns
    -------
    Parameter
        The parameter.
    """
    return Parameter(name, symbol, doc, default, (low, high), 1.0, (low, high), doc, "Computation", is_integer=True)


@dataclass(frozen=True)
class Motions:
    """Motions of a system as functions of named numbers: its parameters and the start.

    Attributes
    ----------
    name : str
        Name in the catalogue.
    title : str
        Name in words.
    system : System
        The equations of motion.
    parameters : tuple of Parameter
        Parameters of the body, and of the energy and plane of a section; their defaults are the example.
    point : tuple of Parameter
        Start of the motion: the variables of the state, or the coordinates of a point of the section.
    start : callable
        Function from the values of `parameters` and `point`, by name, to body and state; it raises a `ModelError` if
        there is no motion.
    section : callable or None, default None
        Function from the values of `parameters`, by name, to the section; None for motions that start at any state.
    source : str, default ""
        Labels of the equations in the paper.
    period : int, default 1
        Period, as a number of returns, of the saddle near the default point, for examples.
    """

    name: str
    title: str
    system: System
    parameters: tuple[Parameter, ...]
    point: tuple[Parameter, ...]
    start: Callable[[Values], tuple[Body, Start]]
    section: Callable[[Values], PoincareSection] | None = None
    source: str = ""
    period: int = 1


def _parameter(system: System, name: str, default: float) -> Parameter:
    """Return the parameter of this name with a default; for a user's system its name is its only description."""
    own = _KNOWN if system.labels else {}
    parameter = (_REDUCED if system.name == "hess" else {}).get(name) or own.get(name)
    if parameter is not None:
        return with_default(parameter, default)
    reach = max(1.0, 2.0 * abs(default))
    return Parameter(name, name, name, default, (-reach, reach), reach / 100.0, _FREE)


def body_parameters(system: System, *values: float) -> tuple[Parameter, ...]:
    """Return the parameters of a system with given defaults.

    Parameters
    ----------
    system : System
        The system.
    *values : float
        Defaults, one for each parameter of the system.  By default those of the system's example.

    Returns
    -------
    tuple of Parameter
        The parameters, in the order of `System.parameters`.
    """
    return tuple(
        _parameter(system, name, value)
        for name, value in zip(system.parameters, values or system.example[1], strict=True)
    )


def state_motions(system: System) -> Motions:
    """Return the motions of a system that start at any state, by default at that of its example.

    Parameters
    ----------
    system : System
        The system.

    Returns
    -------
    Motions
        The motions; their `start` normalises a vector γ or n at the end of the state to length 1.
    """
    names = system.arguments
    point = tuple(_parameter(system, name, value) for name, value in zip(names, system.example[0], strict=True))

    def start(values: Values) -> tuple[Body, Start]:
        state = tuple(values[name] for name in names)
        if names[-3:] in (("g1", "g2", "g3"), ("n1", "n2", "n3")):
            state = (*state[:-3], *unit_vector(state[-3:])[0])
        return system.at([values[name] for name in system.parameters]), state

    labels = ", ".join(system.labels)
    return Motions(system.name, system.title, system, body_parameters(system), point, start, source=labels)


def section_motions(
    name: str,
    title: str,
    parameters: tuple[Parameter, ...],
    point: tuple[Parameter, ...],
    section: Callable[[Values], PoincareSection],
    system: System,
    source: str = "",
    period: int = 1,
) -> Motions:
    """Return the motions that start at the points of a section.

    Parameters
    ----------
    name : str
        Name in the catalogue.
    title : str
        Name in words.
    parameters : tuple of Parameter
        Parameters of the body, of the energy and of the plane.
    point : tuple of Parameter
        Coordinates of the point.
    section : callable
        Function from the values of the parameters, by name, to the section.
    system : System
        The equations of motion.
    source : str, default ""
        Labels of the equations in the paper.
    period : int, default 1
        Period, as a number of returns, of the saddle near the default point, for examples.

    Returns
    -------
    Motions
        The motions.
    """

    def start(values: Values) -> tuple[Body, Start]:
        of = section(values)
        return of, of.state_at(*(values[one.name] for one in point))

    return Motions(name, title, system, parameters, point, start, section, source, period)


def section_of(system: System) -> Motions | None:
    """Return the motions from the default section of a system, at the integrals of its example.

    Parameters
    ----------
    system : System
        The system.

    Returns
    -------
    Motions or None
        The motions; None if the system has a single variable, no such section, or a parameter with the name of an
        integral or of a coordinate of the section.
    """
    from hess_mechanics.dynamics.variable_section import VariableSection, variable_section

    if len(system.variables) < 2:
        return None
    levels = {name: float(value) for name, value in system.integrals(*system.example).items()}
    body = body_parameters(system)

    def section(values: Values) -> VariableSection:
        at = system.at([values[one.name] for one in body])
        return variable_section(at, {name: values[name] for name in levels})

    try:
        example = variable_section(system.at(), levels)
    except InvalidParameter:
        return None
    taken = {one.name for one in body}
    if taken & {*levels, *example.names}:
        return None
    energies = tuple(_parameter(system, name, value) for name, value in levels.items())
    at = dict(zip(system.variables, system.example[0], strict=True))
    argument = dict(zip(system.variables, system.arguments, strict=True))
    point = tuple(_parameter(system, argument[name], at[name]) for name in example.names)
    return section_motions(
        f"{system.name}-section", f"{system.title}, a point of a section", (*body, *energies), point, section, system
    )
