"""The body of the orbit on show as it lies in space: of the Suslov problem with its wheels, or a heavy one."""

from __future__ import annotations

import math
from abc import abstractmethod
from functools import cached_property
from typing import Any, TypeVar

import numpy as np

from hess_explorer.scenes.framework.scene import State
from hess_explorer.views.body import BodyInSpace, Rod, Shape, Trail, Wheels
from hess_explorer.views.layers import Sign
from hess_explorer.views.poisson_sphere import Direction, centre_of_mass
from hess_explorer.views.text import digits
from hess_mechanics.euler_poisson.equations import HeavyBody
from hess_mechanics.numerics.results import Array
from hess_mechanics.rigid_body.attitude import Lying, attitude_along
from hess_mechanics.rigid_body.inertia import check_body

__all__ = ["ConstrainedBody", "HeavySolid", "SolidBody", "constrained_body", "heavy_solid"]

_LOST = 0.02
"""The largest step of γ, in radians, between a sample and the one that follows from it, of a motion that is drawn."""
_TOO_LONG = "Nothing is drawn: so long a motion has samples too far apart to follow its turns."
_MASS = Sign("centre of mass", "dot", "background: #F0E442; border: 1.5px solid black")
_SECTION = Sign("circular section of the gyration ellipsoid", "line", "border-top: 2.5px solid #CC79A7")


class SolidBody(State):
    """A state whose body is seen to move: the scene has `body` and `orbit`."""

    @property
    @abstractmethod
    def followed(self) -> tuple[Array, Array, Array]:
        """Times (n,) of the player, ω (n, 3) and γ (n, 3) along the orbit on show."""

    @cached_property
    def lying(self) -> Lying:
        """How the body lies along the orbit on show."""
        return attitude_along(*self.followed)

    def in_space(self) -> tuple[Lying, Array] | None:
        """The same and its times; None where samples are too far apart for it."""
        return None if self.lying.defect > _LOST else (self.lying, self.lying.times)


class ConstrainedBody(SolidBody):
    """A body of the Suslov problem, or a ball, e = e3, its orbit with states (ω1, ω2, γ), or a `FreeMotion`."""

    @property
    def followed(self) -> tuple[Array, Array, Array]:
        """Along `orbit`."""
        scene: Any = self
        orbit = scene.orbit
        omega, gamma = ((orbit.states[:, :2], orbit.states[:, 2:]) if hasattr(orbit, "states")
                        else (orbit.omega, orbit.gamma))
        return orbit.times, np.column_stack([omega, np.zeros(len(omega))]), gamma

    @cached_property
    def tensor(self) -> Array | None:
        """Of inertia (3, 3), with the middle one of the possible I33; None where this is no rigid body."""
        scene: Any = self
        I11, I22, I13, I23 = scene.body.parameters[:4]
        interval = self.work.get(check_body, I11, I22, I13, I23).I33
        return None if interval is None else np.array(
            [[I11, 0.0, I13], [0.0, I22, I23], [I13, I23, 0.5 * sum(interval)]])

    @property
    def mass(self) -> Direction | None:
        """The direction of the centre of mass; None without a field."""
        scene: Any = self
        return centre_of_mass(scene.body.parameters[-3:])

    def shape(self) -> Shape | None:
        """The ellipsoid of inertia; None where this is no rigid body."""
        return None if self.tensor is None else Shape.of_tensor(self.tensor)

    def rods(self) -> list[Rod]:
        """e, and the centre of mass."""
        e = Rod((0.0, 0.0, 1.0), "axis", "e")
        return [e] if self.mass is None else [e, Rod(self.mass.along, "mass", "r")]

    def about_body(self) -> str:
        """The caption."""
        if self.in_space() is None:
            return _TOO_LONG
        if self.tensor is None:
            return "No rigid body has this tensor: no ellipsoid. Wheels for (ω, e) = 0."
        return f"Ellipsoid of inertia for I₃₃ = {digits(self.tensor[2, 2])}, which is free; wheels for (ω, e) = 0."

    def about_ball(self) -> str:
        """The caption, of a ball."""
        return (_TOO_LONG if self.in_space() is None else
                "It rolls on a ball inside, whose centre stays; wheels for (ω, e) = 0.")


class HeavySolid(SolidBody):
    """A heavy body without a constraint, its orbit with states (M, γ)."""

    @property
    def heavy(self) -> HeavyBody:
        """The body."""
        scene: Any = self
        body: HeavyBody = scene.body
        return body

    @property
    def followed(self) -> tuple[Array, Array, Array]:
        """Along `orbit`."""
        times, states = self.heavy_states
        return times, states[:, :3] * self.heavy.a, states[:, 3:]

    @property
    def heavy_states(self) -> tuple[Array, Array]:
        """Times (n,) and states (n, 6) of the orbit on show."""
        scene: Any = self
        return scene.orbit.times, scene.orbit.states

    @property
    def mass(self) -> Array:
        """The direction of the centre of mass, (3,)."""
        return math.copysign(1.0, self.heavy.mu) * np.array(self.heavy.r)

    def shape(self) -> Shape | None:
        """The gyration ellipsoid with a circular section; None where this is no rigid body."""
        if not self.heavy.check.is_body:
            return None
        I1, I2, I3 = (1.0 / a for a in self.heavy.a)
        return Shape(np.eye(3), np.array([I1, I2, I3]), np.array(HeavyBody.hess((I1, I2, I3), 1.0).r))

    def about_body(self) -> str:
        """The caption."""
        if self.in_space() is None:
            return _TOO_LONG
        if not self.heavy.check.is_body:
            return "No rigid body has these moments: no ellipsoid. r: the centre of mass."
        across = "across" if self.heavy.is_hess else "not across"
        return f"Gyration ellipsoid; the centre of mass, r, lies {across} its circular section."


C = TypeVar("C", bound=ConstrainedBody)
H = TypeVar("H", bound=HeavySolid)


def constrained_body(ball: bool = False, field: bool = True, folded: str = "") -> BodyInSpace[C]:
    """The picture of a `ConstrainedBody`; ball : it rolls on another one; field : whether there may be one."""
    return BodyInSpace(
        name="body", title="The ball in space" if ball else "The body in space", bare=True, hollow=ball, folded=folded,
        caption=(lambda s: s.about_ball()) if ball else (lambda s: s.about_body()),
        shape=(lambda s: Shape(np.eye(3), np.ones(3), None, ("", "", ""))) if ball else (lambda s: s.shape()),
        motion=lambda s: s.in_space(), rods=lambda s: s.rods(), heavy=lambda s: s.mass is not None,
        wheels=lambda s: Wheels((1.0, 0.0, 0.0), (0.0, 0.0, 1.0)), trail=lambda s: Trail((1.0, 0.0, 0.0), "orbit"),
        signs=(Sign("trail of a wheel", "line", "border-top: 3px solid #0072B2"), *((_MASS,) if field else ())))


def heavy_solid(folded: str = "") -> BodyInSpace[H]:
    """The picture of a `HeavySolid`."""
    return BodyInSpace(
        name="body", title="The body in space", bare=True, folded=folded, caption=lambda s: s.about_body(),
        shape=lambda s: s.shape(), motion=lambda s: s.in_space(), rods=lambda s: [Rod(s.mass, "mass", "r")],
        trail=lambda s: Trail(s.mass, "orbit"),
        signs=(_MASS, _SECTION, Sign("trail of the centre of mass", "line", "border-top: 3px solid #0072B2")))
