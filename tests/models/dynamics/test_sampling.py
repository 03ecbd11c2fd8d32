"""Samples of an orbit: few, but dense enough that the polyline looks like the curve at every time."""

import math

import numpy as np
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st
from pytest import approx, mark

from hess_explorer.scenes.suslov_hess import SuslovHess
from hess_mechanics import HessBody, f_max, level, systems
from hess_mechanics.dynamics.orbit import solve
from hess_mechanics.dynamics.sampling import SAGITTA, sample_times
from hess_mechanics.suslov_hess.equations import SYSTEM
from hess_mechanics.suslov_hess.torus import pixels_per_unit, start_of_track, track
from support.thorough import examples, sample

MOST = 6000
# |ẍ|Δt²/8 is the sagitta of a parabola: between two samples |ẍ| itself changes a little.  Of 6000 random tori none
# was beyond 1.11.
ALMOST = 1.15


def farthest(orbit, exact, at, weights):
    """Return the largest distance between curve and polyline at these times, over both pictures."""
    chords = np.transpose([np.interp(at, orbit.times, column) for column in orbit.states.T])
    apart = (exact - chords) * weights
    return max(np.linalg.norm(apart[:, :2], axis=1).max(), np.linalg.norm(apart[:, 2:], axis=1).max())


def between(times):
    """The middles, and a thousand times at random."""
    anywhere = np.random.default_rng(len(times)).uniform(times[0], times[-1], 1000)
    return np.unique(np.concatenate([0.5 * (times[1:] + times[:-1]), anywhere]))


def error_of_track(body, h, f, phi0, span):
    """(Pixels between the curve and its polyline, number of samples) of the orbit on show."""
    # Half the width of the frame of the scene's (ω1, ω2)-plane.
    width = SuslovHess(I22=body.I22, I23=body.I23, b3=body.b3, h=h).half_width
    orbit = track(body, h, f, phi0, span, level("reference"), width).orbit
    at = between(orbit.times)
    exact = solve(SYSTEM.at((body.a, 1.0)), orbit.states[0], at, "reference").states
    return farthest(orbit, exact, at, pixels_per_unit(body, width)), orbit.times.size


bodies = st.builds(
    lambda I22, a, b3: HessBody(I22, a * I22, b3),
    st.floats(0.3, 2.0),
    st.floats(-1.0, 1.0),
    st.one_of(st.floats(-3.0, -0.1), st.floats(0.1, 3.0)),
)


# From the slider, from far beyond it, near the bottom and near the separatrix.
energies = st.one_of(
    st.floats(-0.99, 4.0),
    st.floats(0.0, 4.0).map(lambda e: 10.0**e),
    st.floats(-6.0, 0.0).map(lambda e: -1 + 10.0**e),
    st.builds(lambda sign, e: 1.0 + sign * 10.0**e, st.sampled_from([-1.0, 1.0]), st.floats(-6.0, -1.0)),
)
spans = st.floats(-1.0, 2.0).map(lambda e: 10.0**e)
phases = st.floats(-math.pi, math.pi)
shares = st.one_of(st.floats(-1.0, 1.0), st.sampled_from([-1.0, 0.0, 1.0]), st.floats(-8.0, 0.0).map(lambda e: 10.0**e))


@settings(max_examples=examples(30))
@given(bodies, energies, shares, phases, spans)
@example(HessBody(1.0, -0.5, -1.0), 0.999999, 1e-6, 0.5, 200.0)
@example(HessBody(1.0, -0.5, -1.0), 1.0 + 1e-9, 1e-8, 0.5, 90.0)
def test_the_polyline_through_the_samples_is_the_curve_to_a_quarter_of_a_pixel(body, h, share, phi0, span):
    error, samples = error_of_track(body, h, share * f_max(h), phi0, span)
    assume(samples < MOST)
    assert error < SAGITTA * ALMOST


@mark.parametrize("name", sample(systems(), 2))
@settings(max_examples=examples(6))
@given(sign=st.sampled_from([-1.0, 1.0]), exponent=st.floats(-6.0, 4.0), most=st.sampled_from([2, 3, 50, 6000]))
def test_times_run_from_0_to_the_end_and_keep_their_budget(name, sign, exponent, most):
    body, state = systems()[name].example_motion
    weights, span = np.full(len(state), 300.0), sign * 10.0**exponent
    times = sample_times(body, np.array(state), span, weights, SAGITTA, most)
    assert (times[0], times[-1]) == (0.0, span)
    assert 2 <= times.size <= most
    assert np.all(np.diff(times) * sign > 0.0)
    # An orbit that cannot be followed has even times: its computation proper then says why.
    assert np.diff(sample_times(body, np.array(state), -1e300, weights, SAGITTA, MOST)) == approx(-1e300 / (MOST - 1))


def test_a_budget_is_spent_where_it_is_needed_too():
    body = HessBody(0.96, 0.28, -1.0)
    start, _ = start_of_track(body, 1.5, 0.6, 0.5, 40.0)
    full, short = (
        sample_times(SYSTEM.at((body.a, 1.0)), start, 40.0, pixels_per_unit(body, 4.0), SAGITTA, most)
        for most in (10**6, 200)
    )
    assert len(short) == 200
    # The same density, everywhere less: the k-th sample of the few lies at the same share of the many.
    shares_of_full = np.interp(short, full, np.linspace(0.0, 1.0, len(full)))
    assert shares_of_full == approx(np.linspace(0.0, 1.0, 200), abs=2.0 / len(full))
