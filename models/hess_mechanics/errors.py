"""What can be wrong with a request, each as a type with a sentence that says what to change."""

from __future__ import annotations


class ModelError(ValueError):
    """A request the mechanics cannot answer; its text is written for the user."""


class InvalidParameter(ModelError):
    """A number that is not finite, or lies where the equations mean nothing."""


class NotPositiveDefinite(ModelError):
    """Moments of inertia that give no kinetic energy: I11 and I22 must be positive."""


class OutsideRegion(ModelError):
    """Values of (h, f) that no motion has (left of the curve `Geq3`, or h ≤ −1)."""


class Separatrix(ModelError):
    """f = 0, h = 1: the motion tends to the upper equilibrium and never returns (`Geq4`)."""


class NoField(ModelError):
    """b3 = 0: h and f, measured in units of b, have no meaning without a field."""


class WorkLimit(ModelError):
    """More steps than one request may cost."""
