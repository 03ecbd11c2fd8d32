"""The spherical pendulum: a section at one energy, and the orbit from a place of it."""

from dataclasses import dataclass
from functools import cached_property

from hess_explorer.scenes.framework.part import Start, part
from hess_explorer.scenes.framework.scene import Preset, Scene, State
from hess_explorer.scenes.framework.sliders import accuracy_level, number, places, time_span
from hess_explorer.scenes.parts.sections import (
    Orbit,
    Section,
    crossings_of_each,
    orbit_picture,
    section_picture,
    start_on,
)

from .mechanics import PendulumSection


@dataclass(frozen=True)
class Pendulum(State):
    """A pendulum of length 1 in the field g, with the energy E."""

    g: float = number("g", 1.0, (0.1, 3.0), 0.01, bounds=(0.0, 100.0), label="Gravity g", doc="Acceleration.")
    E: float = number("E", 0.5, (-0.9, 3.0), 0.01, bounds=(-100.0, 100.0), label="Energy E", doc="−g at rest.")
    place: str = places("Start of the orbit", 1, (-3.14, -20.0), (3.14, 20.0), "0.8,0.5")
    count: float = crossings_of_each()
    lasts: float = time_span(30.0, 200.0)
    accuracy: str = accuracy_level()
    weights = (100.0, 100.0, 100.0, 250.0, 250.0, 250.0)

    @cached_property
    def body(self) -> PendulumSection:
        return PendulumSection(self.g, self.E)

    @property
    def poincare(self) -> PendulumSection:
        return self.body

    @cached_property
    def start(self) -> Start:
        return start_on(self.poincare, self.place)

    section = part(lambda s: Section(s, lambda: (s.start,)))
    orbit = part(Orbit)


SCENE = Scene(
    Pendulum,
    __file__,
    title="Spherical pendulum",
    summary="Closed curves: it is integrable.",
    group="Others",
    presets=(Preset("A precessing ellipse"),),
    essential=("E",),
    tracks={"orbit": lambda s: s.orbit.columns},
    views=(section_picture("place"), orbit_picture("x1", "x2")),
)
