"""Tensors that belong to rigid bodies: against point masses, and against a scan over I33."""

from math import inf, sqrt

import numpy as np
from hypothesis import assume, given
from hypothesis import strategies as st
from pytest import approx, mark

from hess_mechanics import HessBody, check_body
from hess_mechanics.errors import NotPositiveDefinite
from hess_mechanics.rigid_body.inertia import paired_weights
from support.mechanics import inertia_of
from support.refusals import refused

moments = st.floats(0.05, 20.0)
shares = st.one_of(st.just(0.0), st.floats(-1.2, 1.2))
coordinate = st.floats(-2.0, 2.0)
point_masses = st.lists(st.tuples(st.floats(0.1, 3.0), coordinate, coordinate, coordinate), min_size=4, max_size=8)


def least_second_moment(I11, I22, I13, I23, I33):
    """The smallest eigenvalue of ½ tr I − I = Σ m x xᵀ: not negative for every rigid body."""
    inertia = np.array([[I11, 0.0, I13], [0.0, I22, I23], [I13, I23, I33]])
    return np.linalg.eigvalsh(0.5 * np.trace(inertia) * np.eye(3) - inertia)[0]


@given(point_masses)
def test_any_heap_of_point_masses_is_a_body_and_its_I33_is_admissible(masses):
    m, positions = np.array(masses)[:, 0], np.array(masses)[:, 1:]
    inertia, second = inertia_of(m, positions)
    # Masses in one plane are the limit of bodies: a rounding error puts them on either side.
    assume(np.linalg.eigvalsh(second)[0] > 1e-9 * np.trace(second))
    assert abs(inertia[0, 1]) < 1e-12 * np.trace(inertia)
    found = check_body(inertia[0, 0], inertia[1, 1], inertia[0, 2], inertia[1, 2])
    assert found.is_body
    assert found.I33[0] < inertia[2, 2] < found.I33[1]


@given(moments, moments, shares, shares)
def test_at_the_ends_of_the_interval_the_body_is_flat(I11, I22, share13, share23):
    root = sqrt(I11 * I22)
    four = (I11, I22, 0.5 * share13 * root, 0.5 * share23 * root)
    found = check_body(*four)
    assume(found.is_body)
    for end in found.I33:
        assert abs(least_second_moment(*four, end)) < 1e-13 * (I11 + I22)
    assert least_second_moment(*four, sum(found.I33) / 2) > 0
    # The answer knows no unit.
    assert np.array(check_body(*(2.0**-200 * one for one in four)).I33) * 2.0**200 == approx(found.I33, rel=1e-12)


@given(st.floats(1e-3, 1e3), st.floats(-0.999, 0.999))
def test_under_bizi1_the_interval_of_I33_has_a_closed_form(I22, a):
    # y = I33/2 has g(y) = 0 at a²I22/2 and (2 − a²)I22/2; the general search knows nothing of it.
    body = HessBody(I22, a * I22, 1.0)
    found = check_body(body.I11, body.I22, 0.0, body.I23)
    for interval in (body.check.I33, found.I33):
        assert np.array(interval) / I22 == approx([a * a, 2 - a * a], rel=0, abs=1e-9)
    assert body.check.is_body == found.is_body


# (0.3, 0.4): y + 0.25/y = 1 has a double root, for flat bodies only.
@mark.parametrize("products", [(0.3, 0.4), (0.0, 1.2), (1e300, 0.0)])
def test_too_large_products_of_inertia_are_no_body(products):
    found = check_body(1.0, 1.0, *products)
    assert not found.is_body
    assert found.I33 is None


test_impossible_values_are_refused_by_their_name = refused(
    (lambda: check_body(1.0, -0.0, 0.0, 0.0), "choose I22 > 0", NotPositiveDefinite),
    (lambda: check_body(1.0, 1.0, 0.0, -inf), "I23 is not a finite number"),
)


@mark.parametrize("moments", [(1.0, 1.5, 2.0), (2.0, 1.0, 1.0)])
def test_the_weights_have_the_moments_of_the_body_and_their_centre_of_mass_where_it_shall_be(moments):
    arms, centre = np.array([0.5, 0.7, 0.9]), np.array([0.0, 0.6, -0.8])
    masses = paired_weights(np.array(moments), arms, centre)
    at = np.stack([np.diag(arms), -np.diag(arms)], axis=1).reshape(6, 3)
    second = at.T @ np.diag(masses.ravel()) @ at
    assert np.trace(second) * np.eye(3) - second == approx(np.diag(moments), abs=1e-14)
    first = masses.ravel() @ at
    assert first / np.linalg.norm(first) == approx(centre, abs=1e-14)
    assert np.all(masses >= 0.0)
    assert paired_weights(np.array([1.0, 1.0, 2.1]), arms) is None
