"""Independent answers with more digits than a double has.

Orbits: Taylor series of a system's plain `field` in whatever arithmetic the numbers bring: `np.longdouble` for many
orbits at once, `decimal.Decimal` for as many digits as one likes.  Circle maps: three such orbits of `eq01`, from the
section to the section, fix a Möbius map; and closed forms where there are any.  No kernel of `models` enters.

What took long is kept in "oracle_values.json", by its arguments, and only looked up: `make_oracle_values.py` finds it
again.
"""

from oracle.circle_maps import (
    MoebiusMap,
    map_by_three_orbits,
    map_of_vanishing_f,
    maps_by_three_orbits,
    stable_cycle,
    turning_roots,
)
from oracle.closed_forms import cos_chi, pendulum
from oracle.kept import FUNCTIONS, KEPT, found_anew
from oracle.orbits import (
    as_decimals,
    coefficients,
    derivative_of_flow,
    distances,
    orbit_in_decimals,
    orbits_in_long_double,
    taylor,
    uncompiled,
)

__all__ = [
    "FUNCTIONS",
    "KEPT",
    "MoebiusMap",
    "as_decimals",
    "coefficients",
    "cos_chi",
    "derivative_of_flow",
    "distances",
    "found_anew",
    "map_by_three_orbits",
    "map_of_vanishing_f",
    "maps_by_three_orbits",
    "orbit_in_decimals",
    "orbits_in_long_double",
    "pendulum",
    "stable_cycle",
    "taylor",
    "turning_roots",
    "uncompiled",
]
