"""The spherical pendulum of length 1: its equations, and its section x₂ = 0 at one energy."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from math import inf, pi, sqrt

import numpy as np

from hess_mechanics.dynamics.plane_section import Plane
from hess_mechanics.dynamics.return_map import PoincareSection
from hess_mechanics.dynamics.system import System, in_units_of_time
from hess_mechanics.numerics.results import Array, Mask


def _field(y, p):
    M1, M2, M3, x1, x2, x3 = y
    return -p[0] * x2, p[0] * x1, 0, M2 * x3 - M3 * x2, M3 * x1 - M1 * x3, M1 * x2 - M2 * x1


SYSTEM = System(
    name="spherical-pendulum",
    title="Spherical pendulum",
    source="",
    labels=(),
    parameters=("g",),
    variables=("M1", "M2", "M3", "x1", "x2", "x3"),
    angular_velocities=3,
    field=_field,
    integrals=lambda y, p: {
        "E": (y[0] ** 2 + y[1] ** 2 + y[2] ** 2) / 2 + p[0] * y[5],
        "L": y[2],
        "(M, x)": y[0] * y[3] + y[1] * y[4] + y[2] * y[5],
    },
    frequency=lambda y, p: (y[0] ** 2 + y[1] ** 2 + y[2] ** 2 + 4.0 * abs(p[0])) ** 0.5,
    rescale=in_units_of_time(first=0, velocities=3),
    example=((0.8, 0.0, 0.6, 0.6, 0.0, -0.8), (1.0,)),
)
"""M = x × ẋ, so that |x| = 1 is kept by the form of the equations."""


@dataclass(frozen=True)
class PendulumSection(PoincareSection):
    """The section x₂ = 0, crossed with ẋ₂ > 0: the angle θ from below, the velocity u in its plane."""

    g: float
    E: float

    names = ("θ", "u")
    turns = (2.0 * pi, inf)
    system = SYSTEM
    surface = Plane((0.0, 0.0, 0.0, 0.0, 1.0, 0.0))
    slowness = 1.0

    @property
    def parameters(self) -> tuple[float, ...]:
        return (self.g,)

    @property
    def constants(self) -> Mapping[str, float]:
        return {"g": self.g, "E": self.E}

    @property
    def window(self) -> tuple[tuple[float, float], ...]:
        fastest = sqrt(2.0 * max(0.0, self.E + self.g))
        return (-pi, pi), (-fastest, fastest)

    def at_constant(self, name: str, value: float) -> PendulumSection:
        return replace(self, **{name: value})

    @property
    def states_at(self) -> Callable[..., tuple[Array, Mask]]:
        return self._states_at

    def _states_at(self, theta: Array, u: Array) -> tuple[Array, Mask]:
        sine, cosine, rest = np.sin(theta), np.cos(theta), 2.0 * (self.E + self.g * np.cos(theta)) - u * u
        across = np.sqrt(np.maximum(rest, 0.0))
        return np.column_stack([across * cosine, -u, across * sine, sine, 0.0 * sine, -cosine]), rest > 0.0

    def places_of(self, states: Array) -> Array:
        return np.column_stack([np.arctan2(states[:, 3], -states[:, 5]), -states[:, 1]])
