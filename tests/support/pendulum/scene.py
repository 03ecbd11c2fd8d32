"""The spherical pendulum: a section at one energy, and the orbit from a place of it."""

from dataclasses import dataclass
from functools import cached_property

from hess_explorer.scenes.framework.scene import Preset, Scene
from hess_explorer.scenes.framework.sliders import number, places
from hess_explorer.scenes.parts.sections import PLAIN, SectionState, orbit_picture, section_picture

from .mechanics import PendulumSection


@dataclass(frozen=True)
class Pendulum(SectionState):
    """A pendulum of length 1 in the field g, with the energy E."""

    g: float = number("g", 1.0, (0.1, 3.0), 0.01, bounds=(0.0, 100.0), label="Gravity g", doc="Acceleration.")
    E: float = number("E", 0.5, (-0.9, 3.0), 0.01, bounds=(-100.0, 100.0), label="Energy E", doc="−g at rest.")
    place: str = places("Start of the orbit", 1, (-3.14, -20.0), (3.14, 20.0), "0.8,0.5")
    weights = (100.0, 100.0, 100.0, 250.0, 250.0, 250.0)

    @cached_property
    def poincare(self) -> PendulumSection:
        return PendulumSection(self.g, self.E)


SCENE = Scene(
    Pendulum,
    __file__,
    title="Spherical pendulum",
    summary="Closed curves: it is integrable.",
    group="Others",
    presets=(Preset("A precessing ellipse", **PLAIN),),
    essential=("E",),
    tracks={"orbit": lambda s: s.orbit.columns},
    views=(section_picture(), orbit_picture("x1", "x2")),
)
