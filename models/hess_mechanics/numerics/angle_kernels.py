# mypy: allow-untyped-defs
"""The angle of a vector, written so that LLVM computes several of them at once.  Not for users.

`atan2` of the C library handles one vector at a time, and would take most of the time of a circle map.
"""

from __future__ import annotations

import math

from hess_mechanics.numerics.jit import part

__all__ = ["angle_of"]

_FIRST, _SECOND, _THIRD = (math.tan(k * math.pi / 16.0) for k in (1, 2, 3))
_SMALLEST = 1e-300


@part
def angle_of(y, x):
    """Return the angle of the vector (x, y) from the first axis, in [−π, π], to four units in the last place.

    The size of the larger coordinate must be between 1e-300 and 1e300; the angle of (0, 0) is 0.

    The vector is reflected to the first octant, where q is the ratio of its smaller to its larger coordinate.  There
    arctan q = arctan c + arctan t with t = (q − c)/(1 + c q) and the nearest angle of c = 0, tan π/8 or 1.  Then
    |t| ≤ tan π/16, where 11 terms of the Taylor series are enough.
    """
    width, height = abs(x), abs(y)
    smaller, larger = min(width, height), max(width, height, _SMALLEST)
    c, angle = 0.0, 0.0
    if smaller > _FIRST * larger:
        c, angle = _SECOND, 0.125 * math.pi
    if smaller > _THIRD * larger:
        c, angle = 1.0, 0.25 * math.pi
    t = (smaller - c * larger) / (larger + c * smaller)
    u = t * t
    s = 1.0 / 19.0 - u / 21.0
    s = 1.0 / 17.0 - u * s
    s = 1.0 / 15.0 - u * s
    s = 1.0 / 13.0 - u * s
    s = 1.0 / 11.0 - u * s
    s = 1.0 / 9.0 - u * s
    s = 1.0 / 7.0 - u * s
    s = 1.0 / 5.0 - u * s
    s = 1.0 / 3.0 - u * s
    angle += t - t * u * s
    if height > width:
        angle = 0.5 * math.pi - angle
    if x < 0.0:
        angle = math.pi - angle
    return -angle if y < 0.0 else angle
