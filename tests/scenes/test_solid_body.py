"""The ellipsoid of the body on show is that of a rigid body, where there is one."""

import numpy as np
import pytest
from pytest import approx

from hess_explorer.scenes.framework.solid_body import ellipsoid_of_inertia, free_I33
from hess_mechanics.rigid_body.inertia import check_body


@pytest.mark.parametrize(
    "tensor, is_body",
    [((2.0, 1.0, 0.3, 0.2), True), ((1.0, 2.5, 0.6, 0.6), False), ((0.1, 10.0, 9.0, -10.0), False)],
)
def test_the_ellipsoid_is_that_of_a_rigid_body_where_there_is_one(tensor, is_body):
    I11, I22, I13, I23 = tensor
    shape, said = ellipsoid_of_inertia(tensor, check_body(*tensor))
    whole = np.array([[I11, 0.0, I13], [0.0, I22, I23], [I13, I23, free_I33(tensor, check_body(*tensor))]])
    # The drawn surface is (ω, Iω) = const.
    for axis, half in zip(shape.axes, shape.semi_axes, strict=True):
        if half > 1.01 * min(shape.semi_axes):
            assert half**2 * (axis @ whole @ axis) == approx(0.64 * shape.moments.min(), rel=1e-6)
    assert np.all(shape.moments > 0.0)
    moments = np.sort(shape.moments)
    assert (moments[2] <= moments[0] + moments[1]) == is_body
    assert (said.verdict == "Not a rigid body.") != is_body
