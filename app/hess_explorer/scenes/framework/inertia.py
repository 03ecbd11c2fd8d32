"""Parameters of bodies: moments and products of inertia, and the centre of mass, to be mixed into states of scenes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

from hess_explorer.scenes.framework.parameters import Slider, number
from hess_explorer.scenes.framework.scene import State
from hess_explorer.views.poisson_sphere import Direction, centre_of_mass

__all__ = ["CentreOfMass", "Moments", "Tensor", "limits_of_moments"]


@dataclass(frozen=True)
class Tensor(State):
    """The tensor of inertia of a body with ω3 = 0, in the axes in which I12 = 0."""

    I11: float = number("I₁₁", 1.5, (0.2, 5.0), 0.01, bounds=(1e-3, 1e3), group="Body", label="Inertia I₁₁",
                        doc="Moment of inertia about the first body axis.")
    I22: float = number("I₂₂", 1.5, (0.2, 5.0), 0.01, bounds=(1e-3, 1e3), group="Body", label="Inertia I₂₂",
                        doc="Moment of inertia about the second body axis.")
    I13: float = number("I₁₃", 0.4, (-2.0, 2.0), 0.01, bounds=(-1e3, 1e3), group="Body", label="Inertia I₁₃",
                        doc="Product of inertia. With I₂₃ it decides where volume shrinks and where it grows.")
    I23: float = number("I₂₃", 0.4, (-2.0, 2.0), 0.01, bounds=(-1e3, 1e3), group="Body", label="Inertia I₂₃",
                        doc="Product of inertia.")


@dataclass(frozen=True)
class CentreOfMass(State):
    """The centre of mass of such a body, b = −mg r."""

    b1: float = number("b₁", -0.5, (-3.0, 3.0), 0.01, bounds=(-1e3, 1e3), group="Body", label="Centre of mass b₁",
                       doc="First component of b = −mg r.")
    b2: float = number("b₂", -0.5, (-3.0, 3.0), 0.01, bounds=(-1e3, 1e3), group="Body", label="Centre of mass b₂",
                       doc="Second component of b.")
    b3: float = number("b₃", 0.7, (-3.0, 3.0), 0.01, bounds=(-1e3, 1e3), group="Body", label="Centre of mass b₃",
                       doc="Third component of b.")

    @cached_property
    def r(self) -> Direction | None:
        """Its direction; None without a field."""
        return centre_of_mass((self.b1, self.b2, self.b3))


_ENDS, _STEP = (0.1, 3.0), 0.005


@dataclass(frozen=True)
class Moments(State):
    """The principal moments of inertia of a heavy body."""

    I1: float = number("I₁", 1.0, _ENDS, _STEP, bounds=(1e-3, 1e3), group="Body", label="Moment I₁",
                       doc="First principal moment of inertia.")
    I2: float = number("I₂", 0.625, _ENDS, _STEP, bounds=(1e-3, 1e3), group="Body", label="Moment I₂",
                       doc="Middle principal moment: it lies between I₁ and I₃, else there is no Hess condition.")
    I3: float = number("I₃", 0.375, _ENDS, _STEP, bounds=(1e-3, 1e3), group="Body", label="Moment I₃",
                       doc="Third principal moment of inertia.")

    def limits(self) -> Mapping[str, Slider]:
        """The moments keep their order."""
        return limits_of_moments(*self.moments)

    @property
    def moments(self) -> tuple[float, float, float]:
        """All three."""
        return self.I1, self.I2, self.I3


def limits_of_moments(I1: float, I2: float, I3: float) -> Mapping[str, Slider]:
    """Return ranges that end where I₂ would no longer lie between the others; a typed value may change their order."""
    low, high = sorted((I1, I3))
    if not (low <= I2 <= high and high - low > 2.0 * _STEP):
        return {}
    smallest, largest = ("I1", "I3") if I1 < I3 else ("I3", "I1")
    return {smallest: (min(_ENDS[0], low), I2, _STEP), "I2": (low, high, _STEP),
            largest: (I2, max(_ENDS[1], high), _STEP)}
