"""The body of the orbit on show as it lies in space: of the Suslov problem with its wheels, or a heavy one."""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, TypeVar

import numpy as np

from hess_explorer.scenes.framework.scene import State
from hess_explorer.scenes.framework.work import Work
from hess_explorer.views.body import BodyInSpace, Rod, Shape, Trail, Wheels
from hess_explorer.views.layers import Sign
from hess_explorer.views.poisson_sphere import Direction, centre_of_mass
from hess_explorer.views.text import digits
from hess_mechanics.euler_poisson.equations import HeavyBody
from hess_mechanics.numerics.results import Array
from hess_mechanics.rigid_body.attitude import Lying, attitude_along
from hess_mechanics.rigid_body.inertia import BodyCheck, check_body
from hess_mechanics.suslov.equations import SuslovBody
from hess_mechanics.suslov.free import FreeMotion
from hess_mechanics.suslov_hess.equations import HessBody

__all__ = ["Constrained", "Heavy", "Hess", "Solid", "constrained_body", "heavy_solid"]

_LOST = 0.02
"""The largest step of γ, in radians, between a sample and the one that follows from it, of a motion that is drawn."""
_TOO_LONG = "Nothing is drawn: so long a motion has samples too far apart to follow its turns."
_WHEEL = (math.sqrt(0.5), math.sqrt(0.5), 0.0)
"""Where a wheel touches: across e; about ω1 or ω2 alone a body would turn that one without rolling it."""
_MASS = Sign("centre of mass", "dot", "background: #F0E442; border: 1.5px solid black")
_TRAIL = Sign("trail of the centre of mass", "line", "border-top: 3px solid #0072B2")
_SECTION = Sign("circular section of the gyration ellipsoid", "line", "border-top: 2.5px solid #BF6699")


@dataclass(frozen=True)
class Solid:
    """A body along an orbit: times (n,) of the player, ω (n, 2) with ω3 = 0 or (n, 3), γ (n, 3) in its axes."""

    times: Array
    omega: Array
    gamma: Array

    @cached_property
    def lying(self) -> Lying:
        """How it lies."""
        omega = self.omega if self.omega.shape[1] == 3 else np.column_stack([self.omega, np.zeros(len(self.times))])
        return attitude_along(self.times, omega, self.gamma)

    def in_space(self, held: bool = False) -> tuple[Lying, Array] | None:
        """The same and its times, every second one while a slider is held; None where they are too far apart for it."""
        if self.lying.defect > _LOST:
            return None
        found = self.lying.every_second() if held else self.lying
        return found, found.times

    @property
    @abstractmethod
    def mass(self) -> Direction | None:
        """The direction of the centre of mass; None without a field."""

    @abstractmethod
    def shape(self) -> Shape | None:
        """Its ellipsoid; None where none is drawn."""

    @abstractmethod
    def said(self) -> str:
        """What is to be said of that."""

    def about(self) -> str:
        """The caption."""
        return _TOO_LONG if self.in_space() is None else self.said()


@dataclass(frozen=True)
class Constrained(Solid):
    """A body of the Suslov problem, e = e3, with I11, I22, I13, I23 and b; check : whether it is one."""

    tensor: tuple[float, float, float, float]
    b: tuple[float, float, float]
    check: BodyCheck

    @classmethod
    def along(cls, work: Work, parameters: tuple[float, ...], times: Array, states: Array) -> Constrained:
        """Return it along states (n, 5) = (ω1, ω2, γ); parameters : I11, I22, I13, I23, …, b1, b2, b3."""
        I11, I22, I13, I23, *_, b1, b2, b3 = parameters
        return cls(
            times,
            states[:, :2],
            states[:, 2:],
            (I11, I22, I13, I23),
            (b1, b2, b3),
            work.get(check_body, I11, I22, I13, I23),
        )

    @classmethod
    def of_free(cls, work: Work, body: SuslovBody, motion: FreeMotion) -> Constrained:
        """Return a body without a field along its motion."""
        return cls.along(work, body.parameters, motion.times, np.hstack([motion.omega, motion.gamma]))

    @property
    def mass(self) -> Direction | None:
        """The direction of the centre of mass; None without a field."""
        return centre_of_mass(self.b)

    @property
    def I33(self) -> float:
        """It is free: the middle one of those of rigid bodies, or one with which the tensor is positive definite."""
        I11, I22, I13, I23 = self.tensor
        return (
            max(0.5 * (I11 + I22), 2.0 * (I13**2 / I11 + I23**2 / I22))
            if self.check.I33 is None
            else 0.5 * sum(self.check.I33)
        )

    def shape(self) -> Shape:
        """The ellipsoid of inertia."""
        I11, I22, I13, I23 = self.tensor
        return Shape.of_tensor(np.array([[I11, 0.0, I13], [0.0, I22, I23], [I13, I23, self.I33]]))

    def said(self) -> str:
        """I33, and whether this is a rigid body."""
        free = "which is free; wheels for (ω, e) = 0." if self.check.is_body else "but no I₃₃ makes this a rigid body."
        return f"Ellipsoid of inertia for I₃₃ = {digits(self.I33)}, {free}"


@dataclass(frozen=True)
class Hess(Solid):
    """A body of the Suslov–Hess case."""

    body: HessBody

    @property
    def mass(self) -> Direction | None:
        """The direction of the centre of mass."""
        return centre_of_mass((0.0, self.body.b2, self.body.b3))

    @property
    def _tensor(self) -> Array | None:
        """In the axes of (n1, n2, n3), with the middle I33; None where this is no rigid body."""
        return None if self.body.middle_I33 is None else self.body.tensor(self.body.middle_I33)

    def in_space(self, held: bool = False) -> tuple[Lying, Array] | None:
        """The attitude and its times; None also where this is no rigid body."""
        return None if self._tensor is None else super().in_space(held)

    def shape(self) -> Shape | None:
        """The gyration ellipsoid with its section across n3."""
        turn = self.body.turn
        return None if self._tensor is None else Shape.of_tensor(turn.T @ self._tensor @ turn, turn[2])

    def about(self) -> str:
        """The caption."""
        return self.said() if self._tensor is None else super().about()

    def said(self) -> str:
        """I33 and the moments."""
        if self._tensor is None or self.body.middle_I33 is None:
            return "Nothing is drawn: with |a| ≥ 1 there is no such rigid body, whatever I₃₃."
        moments = ", ".join(map(digits, np.linalg.eigvalsh(self._tensor)))
        return f"Gyration ellipsoid for I₃₃ = {digits(self.body.middle_I33)}, which is free: moments {moments}."


@dataclass(frozen=True)
class Heavy(Solid):
    """A heavy body without a constraint."""

    body: HeavyBody

    @classmethod
    def along(cls, body: HeavyBody, times: Array, states: Array) -> Heavy:
        """From states (n, 6) = (M, γ)."""
        return cls(times, states[:, :3] * body.a, states[:, 3:], body)

    @property
    def mass(self) -> Direction:
        """The direction of the centre of mass."""
        return Direction(math.copysign(1.0, self.body.mu) * np.array(self.body.r), "r")

    def shape(self) -> Shape | None:
        """The gyration ellipsoid with a circular section; None where this is no rigid body."""
        if not self.body.check.is_body:
            return None
        I1, I2, I3 = (1.0 / a for a in self.body.a)
        return Shape(np.eye(3), np.array([I1, I2, I3]), np.array(HeavyBody.hess((I1, I2, I3), 1.0).r))

    def said(self) -> str:
        """How the centre of mass lies."""
        if not self.body.check.is_body:
            return "No rigid body has these moments: no ellipsoid. r: the centre of mass."
        normal = "normal" if self.body.is_hess else "not normal"
        return f"Gyration ellipsoid; r, the centre of mass, is {normal} to its circular section."


S = TypeVar("S", bound=State)


def _own(state: Any) -> Any:
    return state.solid


def constrained_body(
    of: Callable[[S], Solid] = _own,
    *,
    ball: bool = False,
    field: bool = True,
    section: bool = False,
    title: str = "The body in space",
) -> BodyInSpace[S]:
    """The picture of a body with wheels; ball : it rolls on another one; field : whether there may be one.

    section : whether its circular section is drawn, and the trail is that of the centre of mass, not that of a wheel.
    """

    def rods(state: S) -> list[Rod]:
        mass = of(state).mass
        return [Rod((0.0, 0.0, 1.0), "axis", "e"), *([] if mass is None else [Rod(mass.along, "mass", "r")])]

    def trail(state: S) -> Trail:
        mass = of(state).mass if section else None
        return Trail(_WHEEL if mass is None else mass.along, "orbit")

    return BodyInSpace(
        name="body",
        title="The ball in space" if ball else title,
        bare=True,
        hollow=ball,
        caption=(
            lambda s: (
                "It rolls on a ball inside, whose centre stays; wheels for (ω, e) = 0."
                if of(s).in_space()
                else of(s).about()
            )
        )
        if ball
        else (lambda s: of(s).about()),
        shape=(lambda s: Shape(np.eye(3), np.ones(3), None, ("", "", ""))) if ball else (lambda s: of(s).shape()),
        motion=lambda s: of(s).in_space(s.dragging),
        rods=rods,
        heavy=lambda s: of(s).mass is not None,
        wheels=lambda s: Wheels(_WHEEL, (0.0, 0.0, 1.0)),
        trail=trail,
        signs=(
            *((_TRAIL, _SECTION) if section else (replace(_TRAIL, label="trail of a wheel"),)),
            *((_MASS,) if field else ()),
        ),
    )


def heavy_solid(
    of: Callable[[S], Heavy] = _own, *, name: str = "body", title: str = "The body in space"
) -> BodyInSpace[S]:
    """The picture of a heavy body."""
    return BodyInSpace(
        name=name,
        title=title,
        bare=True,
        caption=lambda s: of(s).about(),
        shape=lambda s: of(s).shape(),
        motion=lambda s: of(s).in_space(s.dragging),
        rods=lambda s: [Rod(of(s).mass.along, "mass", "r")],
        trail=lambda s: Trail(of(s).mass.along, "orbit"),
        signs=(_TRAIL, _SECTION, _MASS),
    )
