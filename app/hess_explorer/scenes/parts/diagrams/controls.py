"""The parameters of an orbit diagram."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from hess_explorer.scenes.framework.periodic_search import NONE, PERIODS
from hess_explorer.scenes.framework.scene import State
from hess_explorer.scenes.framework.sliders import (
    TURN,
    accuracy_level,
    choice,
    exponent_time,
    number,
    points,
    show_proved_error,
    time_span,
)
from hess_mechanics.chaplygin_ball.ball_section import BallSection
from hess_mechanics.suslov.suslov_section import SuslovSection

COORDINATES = ("ψ", "δ")
RISING, FALLING, BACKWARD = "rising", "falling", "backward"
WAYS = {
    "there and back, and backward in time": (RISING, FALLING, BACKWARD),
    "there and back": (RISING, FALLING),
    "there, and backward in time": (RISING, BACKWARD),
}
FOLLOWED, ANEW = "where it was at the value before", "at the chosen place"
FARTHEST = (-1e3, 1e3)
BOUNDS = ((FARTHEST[0], -TURN), (FARTHEST[1], TURN))


def parameter_of_diagram(symbols: tuple[str, ...], default: str) -> str:
    """Declare the control that selects the parameter of the diagram."""
    declared: str = choice(
        "Parameter of the diagram",
        symbols,
        default,
        doc="Parameter on the horizontal axis; all others keep their values.",
    )
    return declared


@dataclass(frozen=True)
class DiagramControls(State, ABC):
    """The parameters of a diagram; a scene adds those of its body, `h`, and the parameter `along` of the diagram.

    Attributes
    ----------
    symbols : mapping of str to str
        Names of the section's parameters, `h` included, by symbol.
    """

    h: float
    along: str
    first: float = number(
        "from", -0.15, (-3.0, 6.0), 0.01, bounds=FARTHEST, label="Diagram from", doc="Parameter at the left edge."
    )
    last: float = number(
        "to", 0.3, (-3.0, 6.0), 0.01, bounds=FARTHEST, label="Diagram to", doc="Parameter at the right edge."
    )
    shown: str = choice("Coordinate of the section", COORDINATES, "ψ", doc="Quantity on the vertical axis.")
    ways: str = choice(
        "Followed",
        tuple(WAYS),
        next(iter(WAYS)),
        doc="There: the parameter rises. Back: it falls. Backward in time, motions tend to repellers.",
    )
    begins: str = choice(
        "Each value starts",
        (FOLLOWED, ANEW),
        FOLLOWED,
        doc="A followed orbit stays with its attractor, and may differ on the way back.",
    )
    steps: float = number(
        "n",
        150.0,
        (30.0, 300.0),
        10.0,
        bounds=(2.0, 600.0),
        label="Values of the parameter",
        doc="Number of evenly spaced values.",
        group="Computation",
    )
    transient: float = number(
        "N₀",
        300.0,
        (0.0, 1000.0),
        10.0,
        bounds=(0.0, 5000.0),
        label="Crossings left out",
        doc="Largest number of crossings left out at each value; fewer if the orbit settles sooner.",
        group="Computation",
    )
    count: float = number(
        "N",
        60.0,
        (10.0, 200.0),
        5.0,
        bounds=(2.0, 500.0),
        label="Crossings shown",
        doc="Crossings drawn at each value, after the omitted ones.",
        group="Computation",
    )
    window: str = points("The window of the diagram", 2, *BOUNDS)
    branch: str = choice(
        "Branch of a periodic orbit",
        (NONE, *PERIODS),
        NONE,
        group="State",
        doc="Over the diagram: the periodic orbit that Newton's method finds near the chosen point, "
        "continued in the parameter, through folds. A click on it shows that orbit.",
    )
    span: float = time_span(60.0, 400.0, what="the chosen orbit")
    long: float = exponent_time(4000.0, 5000.0, 2e4, "the mean divergence is")
    certain: str = show_proved_error()
    accuracy: str = accuracy_level()
    chosen: str = points("The point of the chosen orbit", 1, *BOUNDS)

    symbols: ClassVar[Mapping[str, str]]

    @property
    def parameters(self) -> dict[str, float]:
        """The values of the body's parameters, by name; without h."""
        return {name: getattr(self, name) for name in self.symbols.values() if name != "h"}

    @property
    @abstractmethod
    def poincare(self) -> SuslovSection | BallSection:
        """The section γ3 = 0.  Raises `ModelError`."""
