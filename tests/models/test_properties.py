"""Properties that hold on the whole admissible set of each system, tested with hypothesis."""

from math import exp, hypot, isfinite, pi, remainder

import numpy as np
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from hess_mechanics import circle_map, f_max, level, solve, systems, unit_vector
from hess_mechanics.dynamics.system import Problem
from hess_mechanics.errors import ModelError
from hess_mechanics.numerics.accuracy import LEVELS, Status

SYSTEMS = systems()
WIDE = settings(suppress_health_check=[HealthCheck.too_slow])


def spread(low, high):
    """Magnitudes spread evenly over decades, of either sign."""
    return st.builds(lambda exponent, sign: sign * 10.0**exponent, st.floats(low, high), st.sampled_from((-1.0, 1.0)))


directions = st.tuples(*[st.floats(-1.0, 1.0)] * 3).filter(lambda gamma: hypot(*gamma) > 1e-3)
vectors = directions.map(lambda gamma: unit_vector(gamma)[0])
omegas = st.tuples(spread(-3, 1), spread(-3, 1))
signed, field = spread(-3, 3), spread(-3, 2)
positive = signed.map(abs)

PARAMETERS = {
    "suslov": st.tuples(positive, positive, signed, signed, field, field, field),
    "ball": st.tuples(positive, positive, signed, signed, positive, field, field, field),
    "euler-poisson": st.tuples(*[positive] * 3, *[st.floats(-1.0, 1.0)] * 3, field),
    "hess": st.tuples(spread(-4, 2), field),
    "plane-potential": st.tuples(positive, positive, *[field] * 4),
}


def test_every_system_has_its_parameters_drawn():
    assert set(PARAMETERS) == set(SYSTEMS)


@st.composite
def motions(draw):
    """A system with parameters, a state, and a span of some turns of its fastest motion, forward or backward."""
    system = SYSTEMS[draw(st.sampled_from(sorted(SYSTEMS)))]
    parameters = draw(PARAMETERS[system.name])
    lead = draw(omegas) if system.angular_velocities == 2 else (*draw(omegas), draw(spread(-3, 1)))
    state = (*lead, *draw(vectors))
    turns = draw(st.floats(0.1, 60.0)) * draw(st.sampled_from((-1.0, 1.0)))
    return system, state, parameters, turns / system.frequency(np.array(state), np.array(parameters))


@WIDE
@given(motion=motions(), name=st.sampled_from(sorted(LEVELS)))
def test_a_motion_keeps_its_integrals_within_its_error_or_is_refused_in_a_sentence(motion, name):
    system, state, parameters, span = motion
    try:
        orbit = solve(system.at(parameters), state, np.linspace(0.0, span, 20), name)
    except ModelError as error:
        assert str(error).endswith(".")
        return
    assert np.all(np.isfinite(orbit.states))
    nu = system.frequency(np.array(state), np.array(parameters))
    scaled, units = system.rescale(np.array(state), np.array(parameters), nu)
    relative = orbit.states / Problem.of(system.at(parameters), [state]).scale
    if orbit.status is Status.OK:
        # An integral moves by at most its gradient times the error; where the state is O(1) the gradient is
        # at most twice the largest parameter.
        largest = 2.0 * max(1.0, *np.abs(units))
        for key, initial in system.integrals(scaled, units).items():
            drift = np.max(np.abs(system.integrals(relative.T, units)[key] - initial))
            assert drift <= 10.0 * largest * level(name).promise, key


@WIDE
@given(
    a=spread(-6, 2),
    excess=spread(-6, 4).map(abs),
    part=st.floats(-1.0, 1.0),
    name=st.sampled_from(sorted(LEVELS)),
    phi=st.floats(-pi, pi),
)
def test_every_circle_map_is_a_reversible_circle_map_or_is_refused(a, excess, part, name, phi):
    h = -1.0 + excess
    try:
        theta = circle_map(a, h, part * f_max(h), name)
    except ModelError as error:
        assert str(error).endswith(".")
        return
    assert isfinite(theta.rotation_number)
    assert theta.kind in ("elliptic", "parabolic", "hyperbolic")
    assert theta.error_estimate > 0
    image = theta.theta([phi])
    assert -pi < image[0] <= pi
    if theta.status is Status.OK:
        # Θ(−Θ(φ)) = −φ.  The argument of αz + β is known to the rounding of its parts over their sum, and
        # Θ′ = e^{−2L}/|αz + β|².
        re, im, im_beta = theta.matrix
        parts = abs(complex(re, im)) + abs(im_beta)
        sums = [abs(complex(re, im) * np.exp(1j * angle) + 1j * im_beta) for angle in (phi, -image[0])]
        slope = exp(-2 * theta.log_scale) / max(sums[1], 1e-100) ** 2
        rounding = 1e-14 * parts * (slope / max(sums[0], 1e-100) + 1 / max(sums[1], 1e-100))
        back = theta.theta(-image)[0] + phi
        assert abs(remainder(back, 2 * pi)) <= 1e-14 + rounding
