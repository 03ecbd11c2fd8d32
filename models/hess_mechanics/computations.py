"""Computations for one kind of body: clouds of phase points and rotation numbers.

`accuracy` is a level or its name: "draft", "standard", "precise" or "reference".  All results have `.to_pandas()`,
`.to_xarray()` and `.plot()`.
"""

from __future__ import annotations

from hess_mechanics.chaplygin_ball import phase_cloud_density
from hess_mechanics.chaplygin_ball.equations import BallBody
from hess_mechanics.chaplygin_ball.phase_cloud import Cloud
from hess_mechanics.dynamics.return_map import section_crossings
from hess_mechanics.errors import OutsideRegion
from hess_mechanics.euler_poisson.andoyer import AndoyerSection
from hess_mechanics.euler_poisson.equations import HeavyBody
from hess_mechanics.euler_poisson.rotation import LineEnds, RotationProfile, rotation_along, states_on_line
from hess_mechanics.numerics.accuracy import Accuracy, Kind, plan
from hess_mechanics.numerics.arguments import as_integer, as_level, as_pairs
from hess_mechanics.numerics.results import Array
from hess_mechanics.suslov_hess.rotation_number import TorusValues, values_at

__all__ = ["cloud", "rotation_along_line", "rotation_numbers"]

_MOST_ORBITS = 1000


def cloud(
    body: BallBody,
    h: float,
    duration: float,
    *,
    count: int = 1000,
    spread: float = 0.1,
    angle: float | None = None,
    accuracy: Accuracy = "standard",
) -> Cloud:
    """Return a cloud of phase points of the Chaplygin ball without a field, at times from 0 to `duration`.

    Parameters
    ----------
    body : BallBody
        The ball, with b = 0 and with I13 or I23 nonzero.
    h : float
        Energy about which the points are spread at time 0, or that of the centre of the patch; h > 0, in units I/T².
    duration : float
        Last time, in units T; negative: backward.
    count : int, default 1000
        Number of points, 1 to 20 000.
    spread : float, default 0.1
        Half width of the range of energies relative to h; with an `angle`, radius of the patch, in units of |ω| at its
        centre and, for γ, in radians.  0 < spread < 1.
    angle : float, optional
        Angle of ω at the centre of a patch, in radians, with γ = e₃.  By default the points fill a shell of energies.
    accuracy : str or Level, default "standard"
        Accuracy level.

    Returns
    -------
    Cloud
        The points at evenly spaced times, 0 and `duration` included.

    Raises
    ------
    InvalidParameter
        If a number is out of range, the ball has a field, or I13 = I23 = 0.
    WorkLimit
        If the motions need too many steps or frames, or come too close to I13ω1 + I23ω2 = 0.

    Examples
    --------
    >>> from hess_mechanics import BallBody, cloud
    >>> cloud(BallBody(2.0, 1.0, 0.5, 0.7, 0.0), 2.0, 5.0, count=50, accuracy="draft").omega.shape[0]
    50
    """
    result = phase_cloud_density.clouds(
        body,
        h,
        angle,
        spread,
        as_integer("count", count, 1, 20_000),
        duration,
        None,
        as_level(accuracy),
    )
    return result.cloud


def rotation_numbers(
    a: float | Array, h: float | Array, f: float | Array, accuracy: Accuracy = "precise"
) -> TorusValues:
    """Return the rotation numbers of tori of the Suslov–Hess case, with trace and mode locking.

    Arrays are broadcast against each other.

    Parameters
    ----------
    a : float or array_like, shape (n,)
        Inertia parameter a = I23/I22, |a| ≤ 1e6.
    h : float or array_like, shape (n,)
        Energy integral, |h| ≤ 1e12, in units b = 1.
    f : float or array_like, shape (n,)
        Area integral, in units b = 1.
    accuracy : str or Level, default "precise"
        Accuracy level.

    Returns
    -------
    TorusValues
        Rotation number, trace and locking of each torus; NaN and False where there is no torus.

    Raises
    ------
    InvalidParameter
        If a value is not finite, |a| or |h| is too large, or the arrays do not broadcast.
    WorkLimit
        If there are more than a million tori, an array has two or more axes, or a torus needs too many steps.

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
        Energy integral, any finite number, in units I/T².
    f : float
        Area integral, any finite number, in units I/T.
    ends : ((float, float), (float, float))
        The two ends (l, L/G) of the line; l in radians.
    count : int, default 24
        Number of orbits, spread evenly over the line, 1 to 1000; points that no motion crosses are left out.
    crossings : int, default 300
        Number of crossings per orbit, 20 to 10 000.
    about_first : bool, default False
        Count turns about the first end of the line.  By default turns of the angle l are counted.
    accuracy : str or Level, default "standard"
        Accuracy level.

    Returns
    -------
    RotationProfile
        Rotation numbers of the orbits on closed curves that wind round, in turns per return; librations and chaotic
        intervals are listed separately.

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
    started = states_on_line(section, (first, last), as_integer("count", count, 1, _MOST_ORBITS))
    if not started:
        raise OutsideRegion("No motion crosses the section on this line: choose another line, or a larger h.")
    chosen = plan(Kind.ROTATION, accuracy)
    crossings = as_integer("crossings", crossings, 20, 10_000)
    orbits = section_crossings(section, [state for _, state in started], crossings, chosen.level)
    return rotation_along(
        (first, last),
        [one for one, _ in started],
        [section.points_of(one) for one in orbits.states],
        about_first,
        count,
        chosen.promise,
    )
