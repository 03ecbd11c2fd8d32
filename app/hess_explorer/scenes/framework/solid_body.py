"""The body in space along the orbit: a Suslov body with its wheels, or a heavy body."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, TypeVar

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.scenes.framework.scene import State
from hess_explorer.scenes.framework.work import Work
from hess_explorer.views import theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.layers import CENTRE_OF_MASS, Sign
from hess_explorer.views.space.body import BodyInSpace, Rod, Shape, Wheels
from hess_explorer.views.space.poisson_sphere import Direction, centre_of_mass
from hess_explorer.views.text import digits
from hess_mechanics.dynamics.system import Body
from hess_mechanics.euler_poisson.equations import HeavyBody
from hess_mechanics.numerics.results import Array, Orbit
from hess_mechanics.rigid_body.attitude import Attitude, attitude_along
from hess_mechanics.rigid_body.inertia import BodyCheck, check_body
from hess_mechanics.suslov.free import FreeMotion
from hess_mechanics.suslov_hess.equations import HessBody
from hess_mechanics.suslov_hess.torus import Track

_LARGEST_DEFECT = 0.02
"""Largest `Attitude.defect` of a motion that is drawn, in radians."""
_TOO_LONG = Caption("Not drawn: the motion is too long.", "Its samples are too far apart to follow the rotation.")
_WHEEL = (math.sqrt(0.5), math.sqrt(0.5), 0.0)
"""Direction of a wheel's contact, normal to e; off the axes of ω1 and ω2, about which it would pivot, not roll."""
_TRAIL = Sign("trail of the centre of mass", "line", f"border-top: 3px solid {theme.ORBIT}")
CIRCULAR_SECTION = Sign("circular section of the gyration ellipsoid", "line", f"border-top: 2.5px dashed {theme.INK}")
"""Legend entry of the section that `Shape.section` draws."""


@dataclass(frozen=True)
class Solid:
    """A body along an orbit.

    Attributes
    ----------
    times : array (n,)
        Times of the player.
    omega : array (n, 2) or (n, 3)
        Angular velocity in the body's axes; ω3 = 0 for two components.
    gamma : array (n, 3)
        Vertical unit vector in the body's axes.
    mass : Direction or None
        Direction of the centre of mass; None without a field.
    shape : Shape or None
        The ellipsoid of the body; None if none is drawn.
    about_shape : Caption
        Caption of the picture, unless the motion is too long to be drawn.
    is_drawn : bool
        False if the picture stays empty.
    """

    times: Array
    omega: Array
    gamma: Array
    mass: Direction | None
    shape: Shape | None
    about_shape: Caption
    is_drawn: bool = True

    @cached_property
    def attitude(self) -> Attitude:
        """The attitude along the orbit, with samples between those of the orbit, see `attitude_along`."""
        omega = self.omega if self.omega.shape[1] == 3 else np.column_stack([self.omega, np.zeros(len(self.times))])
        return attitude_along(self.times, omega, self.gamma)

    def in_space(self, held: bool = False) -> tuple[Attitude, Array] | None:
        """Return attitude and times, or None if nothing is drawn; with `held`, only every second sample."""
        if not self.is_drawn or self.attitude.defect > _LARGEST_DEFECT:
            return None
        found = self.attitude.thin() if held else self.attitude
        return found, found.times

    @property
    def caption(self) -> Caption:
        """The caption of the picture: about the ellipsoid, or that the motion is too long to be drawn."""
        return _TOO_LONG if self.is_drawn and self.in_space() is None else self.about_shape


def free_I33(tensor: tuple[float, float, float, float], check: BodyCheck) -> float:
    """Return the middle I33 of the rigid bodies with this (I11, I22, I13, I23).

    If there is no such body, return an I33 with which the tensor is positive definite.
    """
    I11, I22, I13, I23 = tensor
    if check.I33 is None:
        return max(0.5 * (I11 + I22), 2.0 * (I13**2 / I11 + I23**2 / I22))
    return 0.5 * sum(check.I33)


def ellipsoid_of_inertia(tensor: tuple[float, float, float, float], check: BodyCheck) -> tuple[Shape, Caption]:
    """Return the ellipsoid of inertia for (I11, I22, I13, I23) and the I33 of `free_I33`, and its caption."""
    (I11, I22, I13, I23), I33 = tensor, free_I33(tensor, check)
    chosen = f"I₃₃ = {digits(I33)}"
    if check.is_body:
        about = Caption("Ellipsoid of inertia.", f"{chosen} (does not affect the motion); wheels impose (ω, e) = 0.")
    else:
        about = Caption("Not a rigid body.", f"No I₃₃ satisfies the triangle inequalities; drawn for {chosen}.")
    return (
        Shape.of_tensor(np.array([[I11, 0.0, I13], [0.0, I22, I23], [I13, I23, I33]])),
        about,
    )


def constrained_solid(work: Work, body: Body, orbit: Orbit | FreeMotion) -> Solid:
    """Return a body of the Suslov problem with e = e3, or a ball, along its orbit.

    The parameters of the body are I11, I22, I13, I23, …, b1, b2, b3; its states are (ω1, ω2, γ).
    """
    I11, I22, I13, I23, *_, b1, b2, b3 = body.parameters
    omega, gamma = (
        (orbit.omega, orbit.gamma) if isinstance(orbit, FreeMotion) else (orbit.states[:, :2], orbit.states[:, 2:])
    )
    shape, about_shape = ellipsoid_of_inertia((I11, I22, I13, I23), work.need(Task(check_body, I11, I22, I13, I23)))
    return Solid(orbit.times, omega, gamma, centre_of_mass((b1, b2, b3)), shape, about_shape)


def hess_solid(body: HessBody, track: Track) -> Solid:
    """Return a body of the Suslov–Hess case with its gyration ellipsoid and the section normal to n3.

    If |a| ≥ 1 there is no rigid body, and nothing is drawn.
    """
    mass = centre_of_mass((0.0, body.b2, body.b3))
    if body.middle_I33 is None:
        about_shape = Caption(
            "Not drawn: no such rigid body.", "|a| ≥ 1 violates the triangle inequalities for every I₃₃."
        )
        return Solid(track.times, track.omega, track.gamma, mass, None, about_shape, is_drawn=False)
    # Components in the axes n1, n2, n3.
    tensor = body.tensor(body.middle_I33)
    moments = ", ".join(map(digits, np.linalg.eigvalsh(tensor)))
    return Solid(
        track.times,
        track.omega,
        track.gamma,
        mass,
        Shape.of_tensor(body.turn.T @ tensor @ body.turn, body.turn[2]),
        Caption(
            "Gyration ellipsoid.",
            f"I₃₃ = {digits(body.middle_I33)} (does not affect the motion), principal moments {moments}.",
        ),
    )


def heavy_solid(body: HeavyBody, times: Array, states: Array) -> Solid:
    """Return a heavy body along its orbit, given by times (n,) and states (n, 6) = (M, γ)."""
    shape, about_shape = None, Caption("Not a rigid body, so no ellipsoid.", "r: the centre of mass.")
    if body.check.is_body:
        I1, I2, I3 = (1.0 / a for a in body.a)
        shape = Shape(np.eye(3), np.array([I1, I2, I3]), np.array(HeavyBody.hess((I1, I2, I3), 1.0).r))
        normal = "normal" if body.is_hess else "not normal"
        about_shape = Caption(
            "Gyration ellipsoid.", f"The vector r to the centre of mass is {normal} to a circular section."
        )
    mass = Direction(math.copysign(1.0, body.mu) * np.array(body.r), "r")
    return Solid(times, states[:, :3] * body.a, states[:, 3:], mass, shape, about_shape)


S = TypeVar("S", bound=State)


def _own(state: Any) -> Any:
    return state.solid


def body_picture(
    of: Callable[[S], Solid] = _own,
    *,
    name: str = "body",
    title: str = "The body in space",
    ball: bool = False,
    field: bool = True,
    section: bool = False,
    wheels: bool = True,
) -> BodyInSpace[S]:
    """Return the picture of a body.

    Parameters
    ----------
    of : callable
        `of(state)` returns the body.
    name, title : str
        Name and title of the picture; the title of a ball's is always "The ball in space".
    ball : bool
        True if the body is a hollow ball that rolls on an inner one.
    field : bool
        True to explain the centre of mass in the legend, because there may be a field.
    section : bool
        True to draw the circular section and the trail of the centre of mass.
    wheels : bool
        True to draw the wheels that impose (ω, e) = 0.
    """

    def rods(state: S) -> list[Rod]:
        mass = of(state).mass
        axis = [Rod((0.0, 0.0, 1.0), "axis", "e")] if wheels else []
        return axis if mass is None else [*axis, Rod(mass.along, "mass", "r")]

    def mass(state: S) -> Array | None:
        found = of(state).mass
        return None if found is None else np.asarray(found.along)

    def trail(state: S) -> Array | None:
        return mass(state) if section else None

    def caption(state: S) -> Caption:
        if ball and of(state).in_space():
            return Caption("Rolls on an inner ball with fixed centre.", "Wheels impose (ω, e) = 0.")
        return of(state).caption

    return BodyInSpace(
        name=name,
        title="The ball in space" if ball else title,
        without_grid=True,
        hollow=ball,
        caption=caption,
        shape=lambda s: of(s).shape,
        motion=lambda s: of(s).in_space(s.is_preview),
        rods=rods,
        heavy=lambda s: of(s).mass is not None,
        # The trail of the centre of mass has the colour of the orbit, so the wheels are grey beside it.
        wheels=Wheels(_WHEEL, (0.0, 0.0, 1.0), "muted" if section else "orbit") if wheels else None,
        trail=trail,
        mass=mass,
        signs=(
            *((_TRAIL, CIRCULAR_SECTION) if section else ()),
            *((CENTRE_OF_MASS,) if field else ()),
        ),
    )
