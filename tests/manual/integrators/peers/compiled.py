"""The fields as Numba functions, for the peers that take compiled right-hand sides."""

import numba

from hess_mechanics import systems

from ..moebius import field as map_field
from ..moebius import start
from ..works import MapWorkload

_OPTIONS = {"error_model": "numpy", "fastmath": {"contract"}}


def dimension(work):
    """The number of variables: 9 for the circle map, 5 for a motion."""
    return 9 if isinstance(work, MapWorkload) else 5


def initial_state(work):
    """The first state, (9,) or (5,)."""
    return start(work) if isinstance(work, MapWorkload) else work.initial[0]


def rates(work):
    """The compiled rates(y, dy), which fills dy; y and dy are arrays or pointers.  Parameters are compiled in."""
    if isinstance(work, MapWorkload):
        map_rates = numba.njit(**_OPTIONS)(map_field)
        half_a = 0.5 * work.a

        @numba.njit(**_OPTIONS)
        def of_map(y, dy):
            found = map_rates((y[0], y[1], y[2], y[3], y[4], y[5], y[6], y[7], y[8]), half_a)
            for i in range(9):
                dy[i] = found[i]

        return of_map
    motion_rates = numba.njit(**_OPTIONS)(systems()["suslov"].field)
    p = work.parameters

    @numba.njit(**_OPTIONS)
    def of_motion(y, dy):
        found = motion_rates((y[0], y[1], y[2], y[3], y[4]), p)
        for i in range(5):
            dy[i] = found[i]

    return of_motion
