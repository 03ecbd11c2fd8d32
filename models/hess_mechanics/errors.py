"""Errors of the mechanics: the type says what is wrong, the message what to change."""

from __future__ import annotations


class ModelError(ValueError):
    """A request that cannot be answered; the message is written for the user."""


class InvalidParameter(ModelError):
    """A value that is not finite, or lies outside the domain of the equations."""


class WrongScaling(ModelError):
    """A system of equations that does not scale with the unit of time as its description says."""


class NotPositiveDefinite(ModelError):
    """Moments of inertia whose kinetic energy is not positive: I11 and I22 must be."""


class OutsideRegion(ModelError):
    """Values of (h, f) that no motion has: h ≤ −1, or beyond the bifurcation curve (`Geq3`)."""


class Separatrix(ModelError):
    """f = 0, h = 1 (`Geq4`): the motion tends to the upper equilibrium and never returns."""


class NoField(ModelError):
    """No field: h and f, which are measured in units of b, are undefined."""


class WorkLimit(ModelError):
    """A request that takes more steps than one request may."""


class NoReturn(ModelError):
    """A motion that does not come back to its section in the time it is given."""


class NotConverged(ModelError):
    """An iteration, like Newton's, that finds nothing from where it was started."""


class MissingLibrary(ModelError):
    """A request that needs a library which is not installed; the message says what to install."""
