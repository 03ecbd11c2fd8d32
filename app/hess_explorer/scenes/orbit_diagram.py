"""Orbit diagrams of the Suslov problem with gravity: attractors and repellers over a parameter, and reversal."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

from hess_explorer.protocol.specs import Value
from hess_explorer.scenes.diagrams import DiagramState, diagram_scene, regime_in
from hess_explorer.scenes.framework.answers import Answer
from hess_explorer.scenes.framework.scene import Preset
from hess_explorer.scenes.framework.sliders import parameter, redeclare
from hess_explorer.scenes.parts.diagrams.controls import parameter_of_diagram
from hess_mechanics import parameters as known
from hess_mechanics.suslov.equations import SYSTEM, SuslovBody
from hess_mechanics.suslov.suslov_section import SuslovSection

_PARAMETERS = {"h": "h", "I₁₁": "I11", "I₂₂": "I22", "I₁₃": "I13", "I₂₃": "I23", "b₁": "b1", "b₂": "b2", "b₃": "b3"}


def _body(*values: float) -> dict[str, Value]:
    """Return I₁₁, I₂₂, I₁₃, I₂₃, b₁, b₂, b₃ and h by name."""
    return dict(zip((*SYSTEM.parameters, "h"), values, strict=True))


PRESETS = (
    Preset("Period doubling along I₂₃", along="I₂₃"),
    Preset("Apart: a strange attractor and its repeller", along="h", first=2.0, last=2.6),
    Preset(
        "Touching: a strange attractor and its repeller",
        **_body(2.7, 1.4, -0.2, 0.8, -0.4, 1.9, -1.4, 4.6),
        along="h",
        first=4.2,
        last=5.0,
        chosen="-0.5986,1.6433",
    ),
    Preset(
        "A torus breaks up: an invariant curve, then chaos",
        **_body(1.5, 1.0, -0.2605, 0.4, 1.1, -1.6, 1.8, 4.2),
        along="I₁₃",
        first=-0.261,
        last=-0.247,
        window="-0.261,0.5;-0.247,2.2",
        chosen="1.2,1.45",
        branch="period 1",
    ),
    Preset(
        "A spiral: back to a saddle-focus",
        **_body(0.7, 2.8, 0.2, 0.2, 1.0, -1.8, -1.2, 5.015931),
        along="h",
        first=4.9,
        last=5.1,
        chosen="-2.62543193,3.13213405",
    ),
    Preset(
        "Apart: permanent rotations, and reversal",
        **_body(1.0, 2.5, 0.4, -0.1, -0.9, 0.8, -0.1, 2.2),
        along="I₁₃",
        first=0.2,
        last=0.6,
        chosen="-2.01067,0.01001",
        span=60.0,
    ),
    Preset(
        "A chaotic sea without an invariant volume",
        **_body(1.5, 1.7, 0.1, -0.3, -1.7, 1.0, 2.0, 1.9),
        along="h",
        first=1.7,
        last=2.1,
        chosen="-1.0063,1.1872",
    ),
    Preset(
        "Conservative: volume is preserved",
        **_body(1.5, 1.0, 0.0, 0.0, 0.4, -0.3, 0.8, 1.643398),
        along="h",
        first=1.0,
        last=3.0,
        chosen="1,1",
    ),
)
"""Each example is a rigid body for some I₃₃, found by a search over random bodies."""


@dataclass(frozen=True)
class SuslovDiagram(DiagramState):
    """A state of the orbit diagram of the Suslov problem."""

    I11: float = parameter(known.I11, 1.1)
    I22: float = parameter(known.I22, 2.9)
    I13: float = parameter(known.I13, -0.9)
    I23: float = parameter(known.I23, 0.2)
    b1: float = parameter(known.B1, -1.7)
    b2: float = parameter(known.B2, -1.6)
    b3: float = parameter(known.B3, 1.2)
    h: float = parameter(known.H_SUSLOV, 2.3)
    along: str = parameter_of_diagram(tuple(_PARAMETERS), "I₂₃")
    last: float = redeclare(DiagramState, "last", 0.2)
    chosen: str = redeclare(DiagramState, "chosen", "0.7248,1.8925")

    symbols: ClassVar[Mapping[str, str]] = _PARAMETERS

    @cached_property
    def poincare(self) -> SuslovSection:
        """The section γ3 = 0."""
        return SuslovSection(SuslovBody(**self.parameters), 0.0).at_constant("h", self.h)


SCENE = diagram_scene(
    SuslovDiagram,
    __file__,
    PRESETS,
    regime_in("suslov-section", k=3.0),
    place=15,
    group="Heavy body",
    essential=("h", "first", "last", "I13"),
    handle="h",
    answers=(Answer("Each column shows where orbits return after a long time: a few dots look periodic."),),
    title="Orbit diagram",
    summary="Attractors and repellers over a parameter: doublings, hysteresis, reversal.",
)
