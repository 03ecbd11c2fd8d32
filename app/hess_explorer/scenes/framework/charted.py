"""Quantities that can be charted in a scene: the name in the table of sweeps, and the arguments in a state."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Generic, Protocol, TypeVar

from hess_mechanics.dynamics.system import Body

__all__ = ["Charted", "Placed", "exponents", "motion_of", "of_torus", "tensor_of"]

S = TypeVar("S")
B = TypeVar("B", bound="_Embodied")
Torus = tuple[float, float, float]


class _Tensor(Protocol):
    @property
    def I11(self) -> float: ...

    @property
    def I22(self) -> float: ...

    @property
    def I13(self) -> float: ...

    @property
    def I23(self) -> float: ...


class _Embodied(Protocol):
    @property
    def body(self) -> Body: ...


@dataclass(frozen=True)
class Charted(Generic[S]):
    """One quantity that can be charted.

    quantity : its name in `hess_explorer.sweep.QUANTITIES`.
    arguments(state) : its arguments other than the defaults.  Raises `ModelError`.
    pictures : the pictures that show it and offer it as their first choice.
    """

    quantity: str
    arguments: Callable[[S], Mapping[str, float]]
    pictures: tuple[str, ...] = ()


@dataclass(frozen=True)
class Placed:
    """The coordinates of the last place of a parameter, over which a chart can be drawn as over numbers.

    places : the name of the parameter; symbols : symbols of the coordinates, as on the axes of the picture.
    """

    places: str
    symbols: tuple[str, str]

    @property
    def names(self) -> tuple[str, str]:
        """The names of the two coordinates as sides of a chart."""
        return f"{self.places}:0", f"{self.places}:1"


def of_torus(torus: Callable[[Any], Torus], **pictures: tuple[str, ...]) -> tuple[Charted[Any], ...]:
    """Return the quantities of a Suslov–Hess torus (a, h, f); pictures : by quantity, with _ for - in its name."""

    def arguments(s: Any) -> Mapping[str, float]:
        return dict(zip("ahf", torus(s), strict=True))

    def without_a(s: Any) -> Mapping[str, float]:
        return dict(zip("hf", torus(s)[1:], strict=True))

    return tuple(
        Charted(name, without_a if name == "critical-a" else arguments, pictures.get(name.replace("-", "_"), ()))
        for name in ("rotation-number", "trace", "locked", "limit-cycles", "critical-a")
    )


def tensor_of(body: _Tensor) -> Mapping[str, float]:
    """Return the inertia tensor of a body, as arguments."""
    return {"I11": body.I11, "I22": body.I22, "I13": body.I13, "I23": body.I23}


def motion_of(body: Body, start: tuple[float, ...]) -> Mapping[str, float]:
    """Return the parameters of a body and the start of a motion, as arguments."""
    system = body.system
    return dict(zip((*system.parameters, *system.arguments), (*body.parameters, *start), strict=True))


def exponents(
    name: str,
    start: Callable[[B], tuple[float, ...]],
    pictures: tuple[str, ...] = (),
    time: Callable[[B], float] | None = None,
) -> tuple[Charted[B], ...]:
    """Return Lyapunov exponents, MEGNO and crossings of the chosen motion of a system.

    start(state) : its initial state, raises `ModelError` if no motion is possible; time(state) : the averaging time;
    pictures : pictures that offer MEGNO first, which tells regular from chaotic motions soonest.
    """

    def motion(s: B) -> Mapping[str, float]:
        return motion_of(s.body, start(s))

    def averaged(s: B) -> Mapping[str, float]:
        return motion(s) if time is None else {**motion(s), "t": time(s)}

    return (
        Charted(f"lyapunov-{name}", averaged),
        Charted(f"megno-{name}", motion, pictures),
        Charted(f"spectrum-{name}", averaged),
        Charted(f"crossings-{name}", motion),
    )
