"""Errors of the mechanics: the type names the problem, and the message says what to change."""

from __future__ import annotations

import math


class ModelError(ValueError):
    """Base class of errors in a request; the message is written for the user."""


class InvalidParameter(ModelError):
    """An invalid argument: not finite, outside the domain of the equations, or not one of the choices."""


class WrongScaling(ModelError):
    """A system of equations whose `rescale` does not fit its field."""


class NotPositiveDefinite(ModelError):
    """Moments of inertia for which the kinetic energy is not positive definite, such as I11 ≤ 0."""


class OutsideRegion(ModelError):
    """Values of the integrals, or a point of a section, without a motion.

    In the Suslov–Hess case: h ≤ −1, or (h, f) beyond the bifurcation curve (`Geq3`).
    """


class Separatrix(ModelError):
    """The separatrix f = 0, h = 1 (`Geq4`), on which the motion tends to the upper equilibrium and never returns."""


class NoField(ModelError):
    """A body without the field or centre of mass that a definition needs, such as that of h and f in units of b."""


class WorkLimit(ModelError):
    """A request that needs more work than allowed, for example too many steps or points."""


class MotionEnds(WorkLimit):
    """A motion that escapes to infinity in finite time, or reaches a state without finite rates.

    Parameters
    ----------
    message : str
        The message for the user.
    time : float, optional
        Time of the end, in units of the problem; NaN if it is not known.
    """

    def __init__(self, message: str, time: float = math.nan) -> None:
        super().__init__(message)
        self.time = time


class NoReturn(ModelError):
    """A motion that does not return to the section within the time limit, or returns on another sheet."""


class NotConverged(ModelError):
    """An iteration, such as Newton's method, that does not converge from its start, or a search without a result."""


class MissingLibrary(ModelError):
    """A request that needs a library that is not installed; the message says what to install."""
