"""Computations for one kind of body: basins, clouds and rotation numbers.

`accuracy` is a level or its name: "draft", "standard", "precise" or "reference".  Results can be handed on:
`.to_pandas()`, `.to_xarray()`, `.plot()`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from hess_mechanics.chaplygin_ball import phase_cloud_density
from hess_mechanics.chaplygin_ball.equations import BallBody
from hess_mechanics.chaplygin_ball.phase_cloud import Cloud
from hess_mechanics.dynamics.cells import Window, centres
from hess_mechanics.errors import InvalidParameter, OutsideRegion
from hess_mechanics.euler_poisson.andoyer import AndoyerSection
from hess_mechanics.euler_poisson.equations import HeavyBody
from hess_mechanics.euler_poisson.rotation import LineEnds, RotationProfile, on_line, rotation_along
from hess_mechanics.numerics.accuracy import Accuracy, Computation, plan
from hess_mechanics.numerics.arguments import as_a, as_cells, as_level, as_number, as_pairs, as_whole
from hess_mechanics.numerics.labelled import Labels, Result
from hess_mechanics.numerics.parallel import share
from hess_mechanics.numerics.results import Array, frozen
from hess_mechanics.suslov.basins import Contraction, contraction_at, groups_of_cells, middle_cells
from hess_mechanics.suslov.equations import SuslovBody
from hess_mechanics.suslov.section import SuslovSection, require_reached
from hess_mechanics.suslov_hess.rotation_number import TorusValues, values_at

__all__ = ["Basins", "basins", "cloud", "rotation_along_line", "rotation_numbers"]

_MOST_ORBITS = 1000
_LONG = 1000.0
"""Time over which the divergence of one motion of each group is averaged."""


@dataclass(frozen=True)
class Basins(Result):
    """To which group of motions each cell of a section leads.

    psi (m,), delta (n,) : the middles of the cells; mean (n, m) : of ω1 in the long run, NaN where no motion is;
    group (n, m) : the number of the group, −1 where no motion is; divergence : of one motion of each group.
    """

    psi: Array
    delta: Array
    mean: Array
    group: Array
    divergence: tuple[Contraction, ...]
    level: str

    @property
    def attractors(self) -> int:
        """How many of the groups attract."""
        return sum(one.attracts for one in self.divergence)

    def labels(self) -> Labels:
        """Mean and group over δ and ψ."""
        return Labels(
            {"δ": (("δ",), self.delta), "ψ": (("ψ",), self.psi)},
            {"mean": (("δ", "ψ"), self.mean), "group": (("δ", "ψ"), self.group)},
            {"δ": "rad", "ψ": "rad", "mean": "rad/T"},
            {"groups": len(self.divergence), "attractors": self.attractors, "level": self.level},
        )


def basins(
    body: SuslovBody,
    E: float,
    *,
    plane: int = 3,
    cells: tuple[int, int] = (16, 12),
    window: Window = ((-math.pi, 0.0), (math.pi, math.pi)),
    crossings: int = 150,
    accuracy: Accuracy = "standard",
) -> Basins:
    """To which group of motions the cells of a section of the Suslov problem lead, and which groups attract.

    cells : across ψ and up δ; window : (ψ0, δ0), (ψ1, δ1); crossings : how far each orbit is followed.
    accuracy : the four levels are coarser here than elsewhere; any other level is used as it is.
    Raises `InvalidParameter`, `OutsideRegion`, `WorkLimit`.

    >>> from hess_mechanics import SuslovBody, basins
    >>> basins(SuslovBody(1.5, 1.0, 0.4, 0.0, 0.3, -0.5, 1.0), 1.842, cells=(6, 4), accuracy="draft").group.shape
    (4, 6)
    """
    section = SuslovSection(as_a(SuslovBody, body), as_number("E", E), as_whole("plane", plane, 1, 3))
    require_reached(section)
    m, n = as_cells(cells)
    (x0, y0), (x1, y1) = _window(window)
    ends, chosen = np.empty((n, m)), plan(Computation.BASINS, accuracy).level

    def row(i: int) -> None:
        ends[i] = section.ends(window, (m, n), i, crossings, level=chosen)

    share(row, n)
    group = groups_of_cells(ends)
    on_each = tuple(contraction_at(section, window, (m, n), *cell, _LONG) for cell in middle_cells(ends, group))
    return Basins(
        frozen(centres(x0, x1, m)),
        frozen(centres(y0, y1, n)),
        frozen(np.where(np.isfinite(ends), ends, np.nan)),
        frozen(group),
        on_each,
        chosen.name,
    )


def cloud(
    body: BallBody,
    h: float,
    t: float,
    *,
    count: int = 1000,
    spread: float = 0.1,
    angle: float | None = None,
    accuracy: Accuracy = "standard",
) -> Cloud:
    """A cloud of phase points of the ball without a field, about the energy h, followed to the time t.

    spread : of the energies, or the radius of a patch about the ω at an `angle` with γ = e3.
    Raises `InvalidParameter`, `WorkLimit`.

    >>> from hess_mechanics import BallBody, cloud
    >>> cloud(BallBody(2.0, 1.0, 0.5, 0.7, 0.0), 2.0, 5.0, count=50, accuracy="draft").omega.shape[0]
    50
    """
    found = phase_cloud_density.clouds(
        as_a(BallBody, body),
        as_number("h", h),
        angle,
        as_number("spread", spread),
        as_whole("count", count, 1, 20_000),
        as_number("t", t),
        None,
        as_level(accuracy),
    )
    return found.cloud


def rotation_numbers(
    a: float | Array, h: float | Array, f: float | Array, accuracy: Accuracy = "precise"
) -> TorusValues:
    """Rotation number, trace and locking of the tori (a, h, f) of the Suslov–Hess case, numbers or arrays (n,).

    Raises `InvalidParameter`, `WorkLimit`.

    >>> import numpy as np
    >>> from hess_mechanics import rotation_numbers
    >>> rotation_numbers(0.5, np.array([0.2, 1.5]), 0.6).locked.tolist()
    [False, True]
    """
    for name, values in (("a", a), ("h", h), ("f", f)):
        try:
            np.asarray(values, float)
        except (TypeError, ValueError):
            raise InvalidParameter(
                f"{name} = {values!r} is not a number, nor several; write it like 1.5 or [1.5, 2.0]."
            ) from None
    return values_at(a, h, f, as_level(accuracy))


def rotation_along_line(
    body: HeavyBody,
    h: float,
    f: float,
    ends: LineEnds,
    *,
    count: int = 24,
    crossings: int = 300,
    about_first: bool = False,
    accuracy: Accuracy = "standard",
) -> RotationProfile:
    """Rotation numbers of orbits that start on a line of the Andoyer–Deprit section, between places (l, L/G).

    about_first : turns are counted about the first end of the line; else by the angle l.
    Raises `InvalidParameter`, `WorkLimit`.

    >>> from hess_mechanics import HeavyBody, rotation_along_line
    >>> body = HeavyBody.hess((1.0, 1.5, 2.0), 0.01)
    >>> rotation_along_line(body, 2.0, 0.5, ((0.0, 0.85), (0.0, 0.95)), count=4).to_xarray()["ρ"].attrs["units"]
    'turns'
    """
    section = AndoyerSection(as_a(HeavyBody, body), as_number("h", h), as_number("f", f))
    first, last = as_pairs("ends", ends)
    started = on_line(section, (first, last), as_whole("count", count, 1, _MOST_ORBITS))
    if not started:
        raise OutsideRegion("Nowhere on this line does a motion cross the section: choose another line, or a larger h.")
    chosen = plan(Computation.ROTATION, accuracy)
    found = section.points([state for _, state in started], as_whole("crossings", crossings, 20, 10_000), chosen.level)
    return rotation_along(
        (first, last),
        [one for one, _ in started],
        [section.places_of(one) for one in found.states],
        about_first,
        count,
        chosen.promise,
    )


def _window(window: Window) -> Window:
    (x0, y0), (x1, y1) = window
    if not (x0 < x1 and 0.0 <= y0 < y1 <= math.pi):
        raise InvalidParameter("The window is ψ0 < ψ1 and 0 ≤ δ0 < δ1 ≤ π: choose such angles.")
    return window
