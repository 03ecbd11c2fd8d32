"""The Suslov–Hess case: the body, and the map between `Biz131` and `eq01`."""

from math import copysign, hypot, sqrt

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from pytest import approx

from hess_mechanics import HessBody, systems
from hess_mechanics.errors import NoField, NotPositiveDefinite
from support.refusals import refused

SUSLOV, HESS = systems()["suslov"], systems()["hess"]

moment = st.floats(0.05, 20.0)
product = st.floats(-30.0, 30.0)
field_strength = st.floats(-10.0, 10.0)
states = st.lists(st.floats(-3.0, 3.0), min_size=5, max_size=5).map(np.array)
bodies = st.builds(HessBody, moment, product, field_strength)
bodies_in_a_field = bodies.filter(lambda body: abs(body.b3) > 1e-3)


@given(bodies)
def test_derived_values_satisfy_the_conditions_of_hess(body):
    assert approx(body.I22**2 + body.I23**2, rel=1e-14) == body.I11 * body.I22  # bizi1
    assert abs(body.I22 * body.b2 + body.I23 * body.b3) <= 1e-14 * abs(body.I23 * body.b3) + 1e-300  # bizi2
    assert body.a * body.I22 == approx(body.I23, rel=1e-13)
    assert body.b**2 * (body.I22**2 + body.I23**2) == approx(body.b3**2, rel=1e-13, abs=1e-300)
    assert body.b * body.b3 <= 0
    assert body.suslov.parameters == (body.I11, body.I22, 0.0, body.I23, 0.0, body.b2, body.b3)


@given(moment, product, st.lists(field_strength, min_size=3, max_size=3))
def test_the_third_coordinate_of_the_centre_of_mass_has_b2_where_the_paper_prints_b3(I22, I23, b):
    # After `eq02`, before `bizi2` is used: the potential (b, γ) is (c, n) for every γ, c the new coordinates.
    body, (b1, b2, b3) = HessBody(I22, I23, 1.0), b
    c = (b1, (I22 * b2 + I23 * b3) / hypot(I22, I23), (I22 * b3 - I23 * b2) / hypot(I22, I23))
    n = body.to_reduced(np.hstack([np.zeros((3, 2)), np.eye(3)]))[:, 2:]
    assert n @ c == approx(b, abs=1e-13 * (1.0 + max(map(abs, b))))


@given(bodies, states)
def test_the_suslov_field_and_integrals_become_the_reduced_ones(body, y):
    # The map is linear, so that it takes the field as it takes the state.
    image = body.to_reduced(np.array(SUSLOV.field(y, body.suslov.parameters)))
    assert body.from_reduced(body.to_reduced(y)) == approx(y, abs=1e-14 * (1.0 + np.max(np.abs(y))))
    expected = np.array(HESS.field(body.to_reduced(y), (body.a, body.b)))
    size = (1.0 + abs(body.a) + abs(body.b)) * (1.0 + np.max(np.abs(body.to_reduced(y)))) ** 2
    assert np.max(np.abs(image - expected)) < 1e-13 * size
    suslov = SUSLOV.integrals(y, body.suslov.parameters)
    hess = HESS.integrals(body.to_reduced(y), (body.a, body.b))
    assert hess["E"] == approx(suslov["E"] / body.I11, abs=1e-13 * size)
    assert hess["F1"] == approx(suslov["F1"], rel=1e-13, abs=1e-300)
    # F2 of `Biz11`, (Iω, γ) from the full tensor; ω3 = 0: no I33.
    inertia = np.array([[body.I11, 0, 0], [0, body.I22, body.I23], [0, body.I23, 0]])
    assert hess["F2"] == approx(y[2:] @ inertia @ [*y[:2], 0.0] / body.I11, abs=1e-13 * size)


@given(bodies_in_a_field, states)
def test_in_units_of_b_the_field_and_the_integrals_have_b_one(body, y):
    nu, sign = sqrt(abs(body.b)), copysign(1.0, body.b)
    assert body.frequency_unit == approx(nu, rel=1e-15)
    unit = body.in_units_of_b(y)
    assert body.from_units_of_b(unit) == approx(y, rel=1e-14)
    image = body.in_units_of_b(np.array(HESS.field(y, (body.a, body.b)))) / nu
    expected = np.array(HESS.field(unit, (body.a, 1.0)))
    size = (1.0 + abs(body.a)) * (1.0 + np.max(np.abs(unit))) ** 2
    assert np.max(np.abs(image - expected)) < 1e-14 * size
    own, in_units = HESS.integrals(y, (body.a, body.b)), HESS.integrals(unit, (body.a, 1.0))
    assert in_units["E"] == approx(own["E"] / nu**2, abs=1e-13 * size)
    assert in_units["F2"] == approx(sign * own["F2"] / nu, abs=1e-13 * size)


test_what_makes_no_body_or_has_no_units_of_b_is_refused = refused(
    (lambda: HessBody(1.0, 0.5, 0.0).in_units_of_b(np.ones(5)), "b3 = 0", NoField),
    (lambda: HessBody(1e-200, 1e200, 1.0), "choose"),
    (lambda: HessBody(-1.0, 0.5, 1.0), "choose I22 > 0", NotPositiveDefinite),
)
