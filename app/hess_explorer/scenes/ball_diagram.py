"""Orbit diagrams of the Chaplygin ball in a field: attractors and repellers over a parameter, and reversal."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

from hess_explorer.protocol.specs import Value
from hess_explorer.scenes.diagrams import DiagramState, diagram_scene, regime_in
from hess_explorer.scenes.framework import ball_parameters as ball
from hess_explorer.scenes.framework.answers import Answer
from hess_explorer.scenes.framework.scene import Preset
from hess_explorer.scenes.framework.sliders import parameter, redeclare
from hess_explorer.scenes.parts.diagrams.controls import parameter_of_diagram
from hess_mechanics.chaplygin_ball.ball_section import BallSection
from hess_mechanics.chaplygin_ball.equations import SYSTEM, BallBody
from hess_mechanics.parameters import H_BALL


def _ball(*values: float) -> dict[str, Value]:
    """Return I₁₁, I₂₂, I₁₃, I₂₃, 𝒟, b₁, b₂, b₃ and h by name."""
    return dict(zip((*SYSTEM.parameters, "h"), values, strict=True))


PRESETS = (
    Preset("Period doubling along 𝒟"),
    Preset(
        "Apart: a strange attractor and its repeller",
        D=1.0,
        along="h",
        first=2.4,
        last=3.0,
        chosen="2.5,1.5",
    ),
    Preset(
        "Apart: permanent rotations, and reversal",
        **_ball(0.9, 1.3, -0.3, 0.2, 2.3, -1.5, -1.3, 1.1, 4.116),
        first=1.5,
        last=3.0,
        chosen="1.62191,0.01002",
        span=150.0,
    ),
    Preset(
        "Conservative: volume is preserved",
        **_ball(1.0, 3.0, 0.0, 0.0, 5.0, 0.5, 0.0, 0.8, 2.0),
        along="h",
        first=1.0,
        last=3.0,
        chosen="1,1.5",
    ),
)
"""Each example is a rigid body for some I₃₃; the third one was found by a search over random bodies."""


@dataclass(frozen=True)
class BallDiagram(DiagramState):
    """A state of the orbit diagram of the ball."""

    I11: float = parameter(ball.I11, 1.5)
    I22: float = parameter(ball.I22)
    I13: float = parameter(ball.I13, -0.3)
    I23: float = parameter(ball.I23)
    D: float = parameter(ball.D, 1.5)
    b1: float = parameter(ball.B1, 1.0, softbounds=(-2.0, 2.0))
    b2: float = parameter(ball.B2, -0.7, softbounds=(-2.0, 2.0))
    b3: float = parameter(ball.B3, 0.7, softbounds=(-2.0, 2.0))
    h: float = parameter(H_BALL, 2.72)
    along: str = parameter_of_diagram(tuple(ball.PARAMETERS), "𝒟")
    first: float = redeclare(DiagramState, "first", 1.3)
    last: float = redeclare(DiagramState, "last", 1.7)
    chosen: str = redeclare(DiagramState, "chosen", "-2.6813,0.9923")

    symbols: ClassVar[Mapping[str, str]] = ball.PARAMETERS

    @cached_property
    def poincare(self) -> BallSection:
        """The section γ3 = 0."""
        return BallSection(BallBody(**self.parameters), 0.0).at_constant("h", self.h)


SCENE = diagram_scene(
    BallDiagram,
    __file__,
    PRESETS,
    regime_in("ball-section"),
    ball=True,
    place=17,
    group="Ball",
    essential=("D", "first", "last", "I13"),
    handle="D",
    answers=(Answer("Each column shows where orbits return after a long time: a few dots look periodic."),),
    title="Orbit diagram of the ball",
    summary="The ball in a field over a parameter: doublings along 𝒟, a strange attractor and its repeller, reversal.",
)
