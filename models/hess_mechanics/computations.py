"""Computations for one kind of body: basins, clouds of phase points and rotation numbers.

`accuracy` is a level or its name: "draft", "standard", "precise" or "reference".  All results have `.to_pandas()`,
`.to_xarray()` and `.plot()`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from hess_mechanics.chaplygin_ball import phase_cloud_density
from hess_mechanics.chaplygin_ball.equations import BallBody
from hess_mechanics.chaplygin_ball.phase_cloud import Cloud
from hess_mechanics.dynamics.attraction import arrivals
from hess_mechanics.dynamics.cells import Window, centres
from hess_mechanics.errors import InvalidParameter, OutsideRegion
from hess_mechanics.euler_poisson.andoyer import AndoyerSection
from hess_mechanics.euler_poisson.equations import HeavyBody
from hess_mechanics.euler_poisson.rotation import LineEnds, RotationProfile, on_line, rotation_along
from hess_mechanics.numerics.accuracy import Accuracy, Kind, plan
from hess_mechanics.numerics.arguments import as_cells, as_level, as_pairs, as_whole
from hess_mechanics.numerics.labelled import Labels, Result
from hess_mechanics.numerics.parallel import share
from hess_mechanics.numerics.results import Array, frozen
from hess_mechanics.suslov.basins import Contraction, SectionOrbits, attractors
from hess_mechanics.suslov.equations import SuslovBody
from hess_mechanics.suslov.section import SuslovSection, require_reached
from hess_mechanics.suslov_hess.rotation_number import TorusValues, values_at

__all__ = ["Basins", "basins", "cloud", "rotation_along_line", "rotation_numbers"]

_MOST_ORBITS = 1000
_LONG = 1000.0
"""Time over which a divergence is averaged."""


@dataclass(frozen=True)
class Basins(Result):
    """Basins of attraction on a section of the Suslov problem.

    Attributes
    ----------
    psi : ndarray, shape (m,)
        Centres of the cells in ψ, in radians.
    delta : ndarray, shape (n,)
        Centres of the cells in δ, in radians.
    attractor : ndarray of int, shape (n, m)
        Attractor 0, 1, … that the orbit from each cell reaches; −1 where no motion crosses the section, −2 where no
        attractor is reached in 240 crossings.
    crossings : ndarray, shape (n, m)
        Crossings until the attractor is reached; NaN where none is.
    divergence : tuple of Contraction
        Mean divergence on each set that orbits approach, an attractor or not.
    attractors : int
        Number of attractors.
    level : str
        Name of the accuracy level.
    """

    psi: Array
    delta: Array
    attractor: Array
    crossings: Array
    divergence: tuple[Contraction, ...]
    attractors: int
    level: str

    def labels(self) -> Labels:
        """Return the attractor and the crossings, labelled with δ and ψ.

        Returns
        -------
        Labels
            Both arrays over the cells.
        """
        return Labels(
            {"δ": (("δ",), self.delta), "ψ": (("ψ",), self.psi)},
            {"attractor": (("δ", "ψ"), self.attractor), "crossings": (("δ", "ψ"), self.crossings)},
            {"δ": "rad", "ψ": "rad"},
            {"attractors": self.attractors, "level": self.level},
        )


def basins(
    body: SuslovBody,
    E: float,
    *,
    plane: int = 3,
    cells: tuple[int, int] = (16, 12),
    window: Window = ((-math.pi, 0.0), (math.pi, math.pi)),
    accuracy: Accuracy = "standard",
) -> Basins:
    """Return the basins of attraction on a section of the Suslov problem.

    Parameters
    ----------
    body : SuslovBody
        The body.
    E : float
        Energy.
    plane : int, default 3
        Index k of the section γ_k = 0: 1, 2 or 3.
    cells : (int, int), default (16, 12)
        Number of cells along ψ and along δ.
    window : ((float, float), (float, float)), optional
        Corners (ψ0, δ0) and (ψ1, δ1) of the window, in radians.  By default the whole section.
    accuracy : str or Level, default "standard"
        Accuracy level.  The four named levels are coarser here than for orbits.

    Returns
    -------
    Basins
        The attractor of each cell, and the divergence on each set that orbits approach.

    Raises
    ------
    InvalidParameter
        If a number is out of range.
    OutsideRegion
        If no motion of this energy crosses the section.
    WorkLimit
        If an orbit needs too many steps.

    Examples
    --------
    >>> from hess_mechanics import SuslovBody, basins
    >>> basins(SuslovBody(1.5, 1.0, 0.4, 0.0, 0.3, -0.5, 1.0), 1.842, cells=(6, 4), accuracy="draft").attractors
    2
    """
    section = SuslovSection(body, E, as_whole("plane", plane, 1, 3))
    require_reached(section)
    m, n = as_cells(cells)
    (x0, y0), (x1, y1) = _window(window)
    chosen = plan(Kind.BASINS, accuracy).level
    there = attractors(section, _LONG, chosen)
    x, y = centres(x0, x1, m), centres(y0, y1, n)
    number, crossings = np.empty((n, m)), np.empty((n, m))

    def row(i: int) -> None:
        found = arrivals(SectionOrbits(section, chosen), there.sets, x, np.full(m, y[i]))
        number[i], crossings[i] = found.number, found.crossings

    share(row, n)
    crossings[number < 0.0] = np.nan
    return Basins(frozen(x), frozen(y), frozen(number), frozen(crossings), there.contractions, there.count, chosen.name)


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
    """Return a cloud of phase points of the Chaplygin ball without a field, at time t.

    Parameters
    ----------
    body : BallBody
        The ball.
    h : float
        Energy about which the points are spread at time 0.
    t : float
        Time, in units of the problem; may be negative.
    count : int, default 1000
        Number of points, 1 to 20 000.
    spread : float, default 0.1
        Spread of the energies, or the radius of the patch if an `angle` is given.
    angle : float, optional
        Start in a patch about the ω at this angle, in radians, with γ = e₃.  By default the points fill the energy
        surface.
    accuracy : str or Level, default "standard"
        Accuracy level.

    Returns
    -------
    Cloud
        The points at time t.

    Raises
    ------
    InvalidParameter
        If a number is out of range.
    WorkLimit
        If the motions need too many steps.

    Examples
    --------
    >>> from hess_mechanics import BallBody, cloud
    >>> cloud(BallBody(2.0, 1.0, 0.5, 0.7, 0.0), 2.0, 5.0, count=50, accuracy="draft").omega.shape[0]
    50
    """
    found = phase_cloud_density.clouds(
        body,
        h,
        angle,
        spread,
        as_whole("count", count, 1, 20_000),
        t,
        None,
        as_level(accuracy),
    )
    return found.cloud


def rotation_numbers(
    a: float | Array, h: float | Array, f: float | Array, accuracy: Accuracy = "precise"
) -> TorusValues:
    """Return the rotation numbers of tori of the Suslov–Hess case, with trace and mode locking.

    Arrays are broadcast against each other.

    Parameters
    ----------
    a : float or array_like, shape (n,)
        Inertia parameter.
    h : float or array_like, shape (n,)
        Energy integral, in units b = 1.
    f : float or array_like, shape (n,)
        Area integral, in units b = 1.
    accuracy : str or Level, default "precise"
        Accuracy level.

    Returns
    -------
    TorusValues
        Rotation number, trace and locking of each torus.

    Raises
    ------
    InvalidParameter
        If a value is not a finite number.
    WorkLimit
        If there are too many tori.

    Examples
    --------
    >>> import numpy as np
    >>> from hess_mechanics import rotation_numbers
    >>> rotation_numbers(0.5, np.array([0.2, 1.5]), 0.6).locked.tolist()
    [False, True]
    """
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
    """Return the rotation numbers of orbits that start on a line of the Andoyer–Deprit section.

    Parameters
    ----------
    body : HeavyBody
        The body.
    h : float
        Energy integral.
    f : float
        Area integral.
    ends : ((float, float), (float, float))
        The two ends (l, L/G) of the line; l in radians.
    count : int, default 24
        Number of orbits, spread evenly over the line, at most 1000.
    crossings : int, default 300
        Number of crossings per orbit, 20 to 10 000.
    about_first : bool, default False
        Count turns about the first end of the line.  Otherwise by the angle l.
    accuracy : str or Level, default "standard"
        Accuracy level.

    Returns
    -------
    RotationProfile
        The rotation number of each orbit, in turns per return.

    Raises
    ------
    InvalidParameter
        If a number is out of range.
    OutsideRegion
        If no motion crosses the section on the line.
    WorkLimit
        If an orbit needs too many steps.

    Examples
    --------
    >>> from hess_mechanics import HeavyBody, rotation_along_line
    >>> body = HeavyBody.hess((1.0, 1.5, 2.0), 0.01)
    >>> rotation_along_line(body, 2.0, 0.5, ((0.0, 0.85), (0.0, 0.95)), count=4).to_xarray()["ρ"].attrs["units"]
    'turns'
    """
    section = AndoyerSection(body, h, f)
    first, last = as_pairs("ends", ends)
    started = on_line(section, (first, last), as_whole("count", count, 1, _MOST_ORBITS))
    if not started:
        raise OutsideRegion("No motion crosses the section on this line: choose another line, or a larger h.")
    chosen = plan(Kind.ROTATION, accuracy)
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
    """Return the window if its corners are in order.  Raises `InvalidParameter`."""
    (x0, y0), (x1, y1) = window
    if not (x0 < x1 and 0.0 <= y0 < y1 <= math.pi):
        raise InvalidParameter("The window needs ψ0 < ψ1 and 0 ≤ δ0 < δ1 ≤ π.")
    return window
