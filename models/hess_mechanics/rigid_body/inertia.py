"""Checks of inertia tensors, in axes with I12 = 0 and the constraint along e = e3 (`Biz03`).

I33 does not enter the Suslov problem.  A tensor belongs to a rigid body if, for some I33, its second moments ½ tr I − I
are nonnegative (for principal moments: the triangle inequality).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from hess_mechanics.errors import InvalidParameter, NotPositiveDefinite
from hess_mechanics.numerics.arguments import as_number
from hess_mechanics.numerics.results import Array, as_read_only
from hess_mechanics.parameters import plain

__all__ = [
    "MAX_RATIO",
    "BodyCheck",
    "body_check",
    "check_body",
    "paired_weights",
    "require_comparable",
    "require_finite",
    "require_positive_definite",
]

MAX_RATIO = 1e20
"""Largest ratio of moments of inertia: beyond it round-off in units of the fast motion hides the slow one."""


def require_finite(**values: float) -> None:
    """Raise an error that names the first value that is not a finite number.

    Parameters
    ----------
    **values : float
        The values, by name.

    Raises
    ------
    InvalidParameter
        If a value is not a finite number.
    """
    for name, value in values.items():
        as_number(name, value)


def require_positive_definite(I11: float, I22: float) -> None:
    """Raise an error unless I11 and I22 are positive; some I33 then completes the tensor.

    Parameters
    ----------
    I11, I22 : float
        Moments of inertia about the first and second axis.

    Raises
    ------
    NotPositiveDefinite
        If I11 ≤ 0 or I22 ≤ 0.
    """
    for name, value in (("I11", I11), ("I22", I22)):
        if not value > 0:
            raise NotPositiveDefinite(f"{name} = {value:g}, but a moment of inertia is positive: choose {name} > 0.")


def require_comparable(I11: float, I22: float) -> None:
    """Raise an error unless I11 and I22 are positive, and the larger is at most `MAX_RATIO` times the smaller.

    Parameters
    ----------
    I11, I22 : float
        Moments of inertia about the first and second axis.

    Raises
    ------
    NotPositiveDefinite
        If I11 ≤ 0 or I22 ≤ 0.
    InvalidParameter
        If their ratio exceeds `MAX_RATIO`.
    """
    require_positive_definite(I11, I22)
    if not 1.0 / MAX_RATIO <= I11 / I22 <= MAX_RATIO:
        raise InvalidParameter(f"The moments I11 and I22 are too different: choose a ratio of at most {MAX_RATIO:g}.")


_SEARCH = {"xtol": 1e-300, "rtol": 1e-15, "maxiter": 1000}


@dataclass(frozen=True)
class BodyCheck:
    """Result of the check whether an inertia tensor belongs to a rigid body.

    Attributes
    ----------
    is_body : bool
        True if some I33 makes the tensor that of a rigid body.
    I33 : tuple of two floats or None
        Interval of the admissible I33, in the unit of the moments; None if there is none, or if I33 is given.
    sentence : str
        The result in words.
    """

    is_body: bool
    I33: tuple[float, float] | None
    sentence: str


def body_check(I33: tuple[float, float] | None) -> BodyCheck:
    """Return the result of the check for a known interval of I33, with its sentence.

    Parameters
    ----------
    I33 : (float, float) or None
        Interval of the admissible I33, in the unit of the moments; None if there is none.

    Returns
    -------
    BodyCheck
        The result.
    """
    if I33 is None:
        return BodyCheck(
            False,
            None,
            "Not a rigid body: for no I33 do the principal moments satisfy the triangle inequality. "
            "The equations are still shown.",
        )
    return BodyCheck(True, I33, f"A rigid body for I33 between {plain(I33[0], 4)} and {plain(I33[1], 4)}.")


def check_body(I11: float, I22: float, I13: float, I23: float) -> BodyCheck:
    """Check whether an inertia tensor belongs to a rigid body for some I33, and return the interval of these I33.

    Parameters
    ----------
    I11 : float
        Moment of inertia about the first axis, I11 > 0.
    I22 : float
        Moment of inertia about the second axis, I22 > 0, in the unit of I11.
    I13 : float
        Product of inertia, any finite number, in the unit of I11.
    I23 : float
        Product of inertia, any finite number, in the unit of I11.

    Returns
    -------
    BodyCheck
        The interval, None if there is none, and the result in words.

    Raises
    ------
    InvalidParameter
        If a parameter is not a finite number.
    NotPositiveDefinite
        If I11 ≤ 0 or I22 ≤ 0.

    Notes
    -----
    ½ tr I − I must be positive semidefinite.  With s = (I11+I22)/2, d = (I11−I22)/2, y = I33/2 ≥ |d| this is
    g(y) = s − y − I23²/(y+d) − I13²/(y−d) ≥ 0, and g is concave, so the solutions form an interval.

    References
    ----------
    `Biz03`.

    Examples
    --------
    >>> from hess_mechanics import check_body
    >>> check_body(2.0, 1.0, 0.0, 0.0).I33  # the triangle inequality: from 2 − 1 to 2 + 1
    (1.0, 3.0)
    """
    require_finite(I11=I11, I22=I22, I13=I13, I23=I23)
    require_positive_definite(I11, I22)
    scale = max(I11, I22)
    s, d = (I11 + I22) / (2 * scale), (I11 - I22) / (2 * scale)
    # Ratios beyond 2 exclude a rigid body; the bound keeps the squares finite.
    p, q = min(abs(I23) / scale, 2.0) ** 2, min(abs(I13) / scale, 2.0) ** 2

    # Imported here because the import takes 0.3 s, and the Hess case has a closed form.
    from scipy.optimize import brentq

    def g(y: float) -> float:
        return s - y - (p / (y + d) if p else 0.0) - (q / (y - d) if q else 0.0)

    def slope(y: float) -> float:
        return -1.0 + (p / (y + d) ** 2 if p else 0.0) + (q / (y - d) ** 2 if q else 0.0)

    low = abs(d) * (1 + 1e-15) + 1e-150  # Keep the bracket away from the poles, and its square from underflow.
    top = low if slope(low) <= 0 else brentq(slope, low, low + 2 * (math.sqrt(p) + math.sqrt(q)), **_SEARCH)
    if not g(top) > 1e-15 * s:
        return body_check(None)
    lower = abs(d) if g(low) >= 0 else brentq(g, low, top, **_SEARCH)
    upper = brentq(g, top, s, **_SEARCH) if g(s) < 0 else s
    return body_check((2 * lower * scale, 2 * upper * scale))


def paired_weights(moments: Array, arms: Array, centre: Array | None = None) -> Array | None:
    """Return the masses of six point weights on the principal axes that have given moments of inertia.

    The two weights of an axis may differ: this moves the centre of mass in a given direction and keeps the moments.  If
    the weights of an axis with a component of that direction are 0, the centre of mass stays at the fixed point.

    Parameters
    ----------
    moments : ndarray, shape (3,)
        Principal moments of inertia.
    arms : ndarray, shape (3,)
        Distances of the weights from the fixed point, positive; each axis has weights at ±arm.
    centre : ndarray, shape (3,), optional
        Direction of the centre of mass in the principal axes.  By default the centre of mass is the fixed point.

    Returns
    -------
    ndarray, shape (3, 2), or None
        Masses at +arm and −arm, ≥ 0; None if the moments are not those of a rigid body.
    """
    second = 0.5 * np.sum(moments) - moments
    if np.min(second) < -1e-9 * np.max(moments):
        return None
    mean = np.maximum(second, 0.0) / (2.0 * arms**2)
    unequal = np.zeros(3) if centre is None else np.asarray(centre) / arms
    # The lighter weight of a pair keeps at least half of the mean.
    used = np.abs(unequal) > 1e-9 * np.max(np.abs(unequal))
    share = 0.5 * float(np.min(mean[used] / np.abs(unequal[used]), initial=math.inf)) if used.any() else 0.0
    return as_read_only(np.stack([mean + share * unequal, mean - share * unequal], axis=1))
