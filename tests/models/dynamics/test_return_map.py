"""Return maps of the sections: derivative against differences, limit cycles against the Möbius matrix, separatrices."""

import math

import numpy as np
from pytest import approx, mark, raises

from hess_mechanics import (
    BallBody,
    HeavyBody,
    HessBody,
    QuarticBody,
    SuslovBody,
    continued_orbit,
    periodic_orbit,
    return_map,
)
from hess_mechanics.dynamics.periodic import find_periodic, shoot
from hess_mechanics.errors import InvalidParameter, OutsideRegion
from hess_mechanics.numerics.patience import work_limit
from support.mechanics import differences

HEAVY = HeavyBody.hess((1.0, 1.6, 4.0), 1.0)
CASES = [
    (SuslovBody(1.5, 1.0, 0.4, 0.0, 0.3, -0.5, 1.0), {"E": 1.842}, (0.3, 1.2)),
    (BallBody(1.0, 3.0, 0.2, -0.1, 5.0, 0.5, 0.2, 0.8), {"h": 2.0}, (0.3, 1.2)),
    (HEAVY, {"h": 1.5, "f": -0.7}, (0.4, -0.2)),
    (HessBody(2.0, 1.0, -1.0), {"h": 1.5, "f": 0.6}, (0.4,)),
    (QuarticBody(2.0, 1.0, -1.2, 0.8), {}, (0.4, -0.3)),
]


@mark.parametrize(("body", "constants", "place"), CASES)
def test_the_derivative_is_that_of_the_map_and_the_inverse_undoes_it(body, constants, place):
    P = return_map(body, **constants)
    image, DP = P.with_derivative(np.array(place))
    assert np.abs(DP - differences(P.image, place, 1e-4)).max() < 1e-5 * np.abs(DP).max()
    assert np.abs(image - P.image(place)).max() < 1e-12
    assert np.abs(P.inverse().image(image) - place).max() < 1e-9
    assert np.abs(P.iterate(place, 3) - P.image(P.image(image))).max() < 1e-9
    assert np.abs(P.orbit(place, 3)[-1] - P.iterate(place, 3)).max() < 1e-8


def test_where_an_area_is_kept_the_determinant_says_so():
    # The flow keeps dω dγ = dE/K dα dγ_k dψ, α the angle of ω = |ω|u, K = I11u1² + I22u2², and γ̇3 = |ω| sin δ.
    P = return_map(SuslovBody(1.5, 1.0, 0.0, 0.0, 0.3, -0.5, 1.0), E=1.842)
    image, DP = P.with_derivative(np.array([0.3, 1.2]))
    states = P.state_at(np.array([(0.3, 1.2), image]))
    square = np.sum(states[:, :2] ** 2, axis=1)
    density = square**1.5 * np.sin([1.2, image[1]]) / (1.5 * states[:, 0] ** 2 + states[:, 1] ** 2)
    assert np.linalg.det(DP) == approx(density[0] / density[1], rel=1e-9)
    # The Andoyer section is of a Hamiltonian system, in canonical coordinates (l, L) with dL = G dx + x dG.
    orbit = periodic_orbit(return_map(HEAVY, h=1.5, f=-0.7), (-2.84, 0.288), 1)
    assert abs(orbit.multipliers.prod() - 1.0) < 1e-9


def test_where_every_orbit_closes_each_place_is_one_of_a_family():
    # b3 = 0, I13 = I23 = 0: γ3, t → − brings every motion back, and the return map is the identity.
    P = return_map(BallBody(1.0, 2.0, 0.0, 0.0, 1.0, 1.0, 0.5, 0.0), E=1.5)
    for near in (False, True):
        orbit = find_periodic(P, (0.5, 1.5), 1, near=near)
        assert orbit.kind == "parabolic"
        assert orbit.points[0] == approx([0.5, 1.5], abs=1e-8)
        assert 0.0 < orbit.error_estimate < 1e-9


def test_a_reversor_is_found_and_a_symmetric_orbit_known():
    # I13 = 0 and b1 = 0: ω1, γ1, t → −; on γ1 = 0 it is δ → π − δ.
    P = return_map(SuslovBody(1.5, 1.0, 0.0, 0.2, 0.0, -0.5, 1.0), E=3.0, plane=1)
    (mirror,) = [one for one in P.mirrors if one.reverses]
    assert P.mirror_image(mirror, np.array([0.3, 1.2])) == approx([0.3, math.pi - 1.2], abs=1e-13)
    back = P.mirror_image(mirror, P.image(P.mirror_image(mirror, np.array([2.0, 1.2]))))
    assert back == approx(P.inverse().image(np.array([2.0, 1.2])), abs=1e-9)
    assert return_map(SuslovBody(1.5, 1.0, 0.1, 0.2, 0.3, -0.5, 1.0), E=3.0, plane=1).mirrors == ()


def test_what_a_body_does_not_have_is_refused():
    body = CASES[0][0]
    P = return_map(body, E=1.842)
    # h is the energy above the lowest one, −|b|.
    assert P.section == return_map(body, h=1.842 + math.hypot(body.b1, body.b2, body.b3)).section
    assert approx(2.092, abs=1e-14) == P.at_constant("h", P.section.h + 0.25).section.E
    orbit = periodic_orbit(P, (0.3, 1.2))
    for call, error, words in (
        (lambda: return_map(body, E=1.8, h=1.0), InvalidParameter, "takes h and no E"),
        (lambda: return_map(QuarticBody(2.0, 1.0, 1.0, 0.8), h=1.0), InvalidParameter, "its own energy and no h"),
        (lambda: return_map(body, E=-5.0), OutsideRegion, "choose E above"),
        (lambda: continued_orbit(P, orbit, "mass", 2.0), InvalidParameter, "mass is not a constant here"),
        (lambda: continued_orbit(P, orbit, "E", 2.0, points=10**6), InvalidParameter, "from 2 to 2000"),
        (lambda: P.image((0.3, 4.0)), OutsideRegion, r"ψ = 0\.3, δ = 4"),
        (lambda: periodic_orbit(P, (0.3, 1.2), 65), InvalidParameter, "from 1 to 64"),
    ):
        with raises(error, match=words):
            call()


def test_who_asks_is_asked_at_every_crossing_whether_to_go_on():
    body, fixed, place = CASES[0]
    map_ = return_map(body, **fixed)
    orbit = np.concatenate([[place], map_.orbit(np.array(place), 5)])
    asked = []
    # At an extreme body one crossing may take a second, and Newton's method takes as many as the period at each step.
    with work_limit(lambda: asked.append(1), lambda seconds: None):
        shoot(map_, orbit)
    assert len(asked) >= 6
