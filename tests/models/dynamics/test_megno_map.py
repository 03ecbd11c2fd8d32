"""MEGNO over sections: each cell is the motion from its middle, and known regular and chaotic bodies are told apart."""

import numpy as np
from pytest import approx, mark, raises

from hess_mechanics import BallBody, HeavyBody, HessBody, QuarticBody, SuslovBody, megno, megno_map, return_map
from hess_mechanics.dynamics.megno_map import time_of
from hess_mechanics.errors import InvalidParameter
from support.deviations import deviations
from support.suslov import permanent_rotations

STRANGE = SuslovBody(1.7, 3.0, 0.3, 0.1, -2.0, -2.1, 2.6)
MAPS = {
    "suslov": (STRANGE, {"E": 2.0}),
    "quartic": (QuarticBody(2.0, 1.0, 1.0, 0.8), {}),
    "euler-poisson": (HeavyBody.hess((1.0, 1.6, 4.0), 1.0), {"h": 1.5, "f": -0.7}),
}


@mark.chaotic
@mark.parametrize("name", MAPS)
def test_each_cell_is_the_motion_from_its_middle(name):
    body, at = MAPS[name]
    # So exact that motions which part exponentially are the same in other steps.
    P = return_map(body, **at, accuracy="precise")
    found = megno_map(P, cells=(5, 3), duration=60.0)
    assert found.values.shape == found.kind.shape == (3, 5)
    i, j = np.argwhere(np.isfinite(found.values))[-1]
    start = P.state_at(np.array([found.x[j], found.y[i]]))
    alone = megno(P.section, [start], 60.0, P.accuracy)
    # Alone it has a unit of time of its own.
    assert found.values[i, j] == approx(alone.values[0], rel=0.05)
    assert (found.kind[~np.isfinite(found.values)] == -1).all()
    # The middles of cells all over the section.
    (x0, x1), _ = P.section.window
    assert found.x == approx(x0 + (x1 - x0) * np.array([0.1, 0.3, 0.5, 0.7, 0.9]))


@mark.chaotic
def test_integrable_bodies_are_regular_all_over_and_a_sea_is_chaotic():
    integrable = {
        # `integrable_cases.has_area_integral`
        "ball": return_map(BallBody(1.0, 1.0, 0.0, 0.0, 3.0, 0.0, 0.0, 1.0), E=1.5, accuracy="standard"),
        # Lagrange's top
        "euler-poisson": return_map(
            HeavyBody((1.0, 1.0, 0.5), (0.0, 0.0, 1.0), 1.0), h=1.0, f=0.5, accuracy="standard"
        ),
    }
    for P in integrable.values():
        found = megno_map(P, cells=(6, 4), duration=time_of(P.section, 300.0))
        assert (found.kind >= 0).any()
        assert set(found.kind.ravel().tolist()) <= {-1, 0}
    sea = return_map(QuarticBody(3.0, 1.0, 1.0, 1.2), accuracy="standard")
    found = megno_map(sea, cells=(18, 12), duration=time_of(sea.section, 300.0))
    assert deviations(found.kind[found.kind >= 0] == 1, 0.5) > 5.0


def test_where_volume_shrinks_cells_are_attracted():
    # All motions come to a permanent rotation, where the divergence is I23ω1/I22 − I13ω2/I11 of its ω.
    body, E = SuslovBody(1.0, 3.0, 0.6, 0.6, 1.0, 0.7, 0.3), 1.743
    w1, w2 = min((state[:2] for state in permanent_rotations(body, E)), key=lambda w: 0.2 * w[0] - 0.6 * w[1])
    assert 0.2 * w1 - 0.6 * w2 < -0.1
    assert (megno_map(return_map(body, E=E, accuracy="draft"), cells=(6, 4), duration=400.0).kind == 2).all()


@mark.parametrize(
    ("asked", "said"),
    [
        ({"window": ((0.0, 0.0), (1.0, 4.0))}, "δ from 0 to 3.14159"),
        ({"cells": (1000, 1000)}, "at most 100000"),
    ],
)
def test_what_cannot_be_is_refused(asked, said):
    with raises(InvalidParameter, match=said):
        megno_map(return_map(STRANGE, E=2.0), **asked)
    with raises(InvalidParameter, match="only the coordinate φ"):
        megno_map(return_map(HessBody(1.0, 0.5, -1.0), h=1.5, f=0.6))
