"""Orbit diagrams of the Suslov problem with gravity: attractors and repellers over a parameter, and reversal."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

from hess_explorer.protocol.parameters import Value
from hess_explorer.scenes.framework.attracted import Attracted, pictures
from hess_explorer.scenes.framework.charted import Charted
from hess_explorer.scenes.framework.heavy_suslov import HeavySuslov
from hess_explorer.scenes.framework.inertia import CentreOfMass, Tensor
from hess_explorer.scenes.framework.one_orbit import OneOrbit
from hess_explorer.scenes.framework.over_parameter import BOUNDS, parameter_of_diagram
from hess_explorer.scenes.framework.parameters import accuracy_level, exponent_time, like, number, time_span
from hess_explorer.scenes.framework.parameters import places as chosen_places
from hess_explorer.scenes.framework.proved_orbit import proved_error_shown
from hess_explorer.scenes.framework.scene import Preset, Scene
from hess_explorer.scenes.framework.solid_body import ConstrainedBody
from hess_explorer.views.velocity_plane import orbit_columns
from hess_mechanics.suslov.equations import SYSTEM
from hess_mechanics.suslov.section import SuslovSection

_PARAMETERS = {"h": "h", "I₁₁": "I11", "I₂₂": "I22", "I₁₃": "I13", "I₂₃": "I23", "b₁": "b1", "b₂": "b2", "b₃": "b3"}


def _body(I11: float, I22: float, I13: float, I23: float, b1: float, b2: float, b3: float, h: float
          ) -> dict[str, Value]:
    return {"I11": I11, "I22": I22, "I13": I13, "I23": I23, "b1": b1, "b2": b2, "b3": b3, "h": h}


PRESETS = (
    Preset("Period doubling along I₂₃", along="I₂₃"),
    Preset("Apart: a strange attractor and its repeller", along="h", first=2.0, last=2.6),
    Preset("Touching: a strange attractor and its repeller", **_body(2.7, 1.4, -0.2, 0.8, -0.4, 1.9, -1.4, 4.6),
           along="h", first=4.2, last=5.0, chosen="-0.5986,1.6433"),
    Preset("A torus breaks up: an invariant curve, then chaos", **_body(1.5, 1.0, -0.2605, 0.4, 1.1, -1.6, 1.8, 4.2),
           along="I₁₃", first=-0.261, last=-0.247, window="-0.261,0.5;-0.247,2.2", chosen="1.2,1.45",
           branch="period 1"),
    Preset("A spiral: back to a saddle-focus", **_body(0.7, 2.8, 0.2, 0.2, 1.0, -1.8, -1.2, 5.015931), along="h",
           first=4.9, last=5.1, chosen="-2.62543193,3.13213405"),
    Preset("Apart: permanent rotations, and reversal", **_body(1.0, 2.5, 0.4, -0.1, -0.9, 0.8, -0.1, 2.2),
           along="I₁₃", first=0.2, last=0.6, chosen="-2.01067,0.01001", span=60.0),
    Preset("Equal: a sea that keeps no volume", **_body(1.5, 1.7, 0.1, -0.3, -1.7, 1.0, 2.0, 1.9), along="h",
           first=1.7, last=2.1, chosen="-1.0063,1.1872"),
    Preset("Equal: volume is kept", **_body(1.5, 1.0, 0.0, 0.0, 0.4, -0.3, 0.8, 1.643398), along="h", first=1.0,
           last=3.0, chosen="1,1"),
)
"""All of them are rigid bodies for some I₃₃, found by `tests/benchmarks/search_regimes.py`."""


@dataclass(frozen=True)
class OrbitDiagram(Attracted, HeavySuslov, OneOrbit, ConstrainedBody):
    """Where orbits of a section settle over one parameter, and the orbit on show at the value that this one has."""

    I11: float = like(Tensor, "I11", 1.1)
    I22: float = like(Tensor, "I22", 2.9)
    I13: float = like(Tensor, "I13", -0.9)
    I23: float = like(Tensor, "I23", 0.2)
    b1: float = like(CentreOfMass, "b1", -1.7)
    b2: float = like(CentreOfMass, "b2", -1.6)
    b3: float = like(CentreOfMass, "b3", 1.2)
    along: str = parameter_of_diagram(tuple(_PARAMETERS), "I₂₃")
    h: float = number("h", 2.3, (0.01, 6.0), 0.01, bounds=(1e-6, 1e6), label="Energy above the bottom, h",
                      doc="E + |b|, the energy above its smallest possible value.")
    span: float = time_span(60.0, 400.0, what="the chosen orbit")
    long: float = exponent_time(4000.0, 5000.0, 2e4, "the mean divergence is")
    certain: str = proved_error_shown()
    accuracy: str = accuracy_level()
    chosen: str = chosen_places("The place of the chosen orbit", 1, *BOUNDS, "0.7248,1.8925")

    parameters_of_section: ClassVar[Mapping[str, str]] = _PARAMETERS

    @cached_property
    def section(self) -> SuslovSection:
        """The section γ3 = 0."""
        return SuslovSection(self.body, self.E, 3)


SCENE = Scene(
    OrbitDiagram, __file__, place=15, presets=PRESETS, group="Heavy body",
    charts=(Charted("regime-suslov-section", lambda s: {
        **dict(zip(SYSTEM.parameters, s.body.parameters, strict=True)), "h": s.h, "k": s.section.k, "psi": s.place[0],
        "delta": s.place[1]}, pictures=("diagram", "section")),),
    essential=("h", "first", "last", "I13"), handle="h",
    title="Orbit diagram",
    summary="Attractors and repellers over a parameter: doublings, hysteresis, reversal.",
    tracks={"orbit": lambda s: orbit_columns(s.orbit, turning=s.turning)},
    views=pictures(OrbitDiagram),
)
