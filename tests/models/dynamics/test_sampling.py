"""Samples of an orbit: few, but dense enough that the polyline looks like the curve at every time."""

import math

import numpy as np
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from pytest import approx, mark

from hess_explorer.scenes.suslov_hess import SuslovHess
from hess_mechanics import HessBody, f_max, level, systems
from hess_mechanics.dynamics.orbit import solve
from hess_mechanics.dynamics.sampling import SAGITTA, sample_times
from hess_mechanics.suslov_hess.equations import SYSTEM
from hess_mechanics.suslov_hess.torus import pixels_per_unit, start_of_track, track
from support.thorough import examples

REFERENCE = level("reference")
MOST = 6000
BODY = HessBody(0.96, 0.28, -1.0)
# |ẍ|Δt²/8 is the sagitta of a parabola: between two samples |ẍ| itself changes a little.  Of 6000 random tori none
# was beyond 1.11.
ALMOST = 1.15


def half_width(body, h):
    """Return the half width of the frame of the scene's (ω1, ω2)-plane."""
    return SuslovHess(I22=body.I22, I23=body.I23, b3=body.b3, h=h).half_width


def farthest(times, states, solution, at, weights):
    """Return the largest distance between curve and polyline at these times, over both pictures."""
    chords = np.transpose([np.interp(at, times, column) for column in states.T])
    apart = (solution(at) - chords) * weights
    return max(np.linalg.norm(apart[:, :2], axis=1).max(), np.linalg.norm(apart[:, 2:], axis=1).max())


def between(times):
    """The middles, and a thousand times at random."""
    anywhere = np.random.default_rng(len(times)).uniform(times[0], times[-1], 1000)
    return np.unique(np.concatenate([0.5 * (times[1:] + times[:-1]), anywhere]))


def orbit_of(body, start):
    return lambda times: solve(SYSTEM.at((body.a, 1.0)), start, times, REFERENCE).states


def error_of_track(body, h, f, phi0, span):
    """(Pixels between the curve and its polyline, number of samples) of the orbit on show."""
    width = half_width(body, h)
    orbit = track(body, h, f, phi0, span, REFERENCE, width).orbit
    weights = pixels_per_unit(body, width)
    error = farthest(orbit.times, orbit.states, orbit_of(body, orbit.states[0]), between(orbit.times), weights)
    return error, orbit.times.size


def bodies(largest_a):
    return st.builds(
        lambda I22, a, b3: HessBody(I22, a * I22, b3),
        st.floats(0.3, 2.0),
        st.floats(-largest_a, largest_a),
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
@given(bodies(1.0), energies, shares, phases, spans)
def test_the_polyline_through_the_samples_is_the_curve_to_a_quarter_of_a_pixel(body, h, share, phi0, span):
    error, samples = error_of_track(body, h, share * f_max(h), phi0, span)
    assume(samples < MOST)
    assert error < SAGITTA * ALMOST


@mark.parametrize(("h", "f", "span"), [(0.999999, 1e-6, 200.0), (1.0, 1e-6, 200.0), (1.0 + 1e-9, 1e-8, 90.0)])
def test_close_to_the_separatrix_the_samples_lie_where_the_orbit_bends_too(h, f, span):
    error, samples = error_of_track(HessBody(1.0, -0.5, -1.0), h, f, 0.5, span)
    assert samples < MOST
    assert error < SAGITTA * ALMOST


def of_default(span=40.0, factor=1.0, sagitta=SAGITTA, most=10**6):
    start, _ = start_of_track(BODY, 1.5, 0.6, 0.5, span)
    weights = factor * pixels_per_unit(BODY, 4.0)
    return sample_times(SYSTEM.at(np.array([BODY.a, 1.0])), start, span, weights, sagitta, most)


random_spans = st.builds(lambda sign, e: sign * 10.0**e, st.sampled_from([-1.0, 1.0]), st.floats(-6.0, 4.0))


@mark.parametrize("name", systems())
@settings(max_examples=examples(6))
@given(seed=st.integers(0, 10**6), span=random_spans, most=st.sampled_from([2, 3, 50, 6000]))
def test_times_run_from_0_to_the_end_and_keep_their_budget(name, seed, span, most):
    system = systems()[name]
    state, parameters = system.example
    state = np.array(state) + np.random.default_rng(seed).uniform(-0.2, 0.2, len(state))
    times = sample_times(system.at(np.array(parameters)), state, span, np.full(len(state), 300.0), SAGITTA, most)
    assert times[0] == 0.0
    assert times[-1] == span
    assert 2 <= times.size <= most
    assert np.all(np.diff(times) * np.sign(span) > 0.0)


def test_a_budget_is_spent_where_it_is_needed_too():
    full, short = of_default(), of_default(most=200)
    assert len(short) == 200
    # The same density, everywhere less: the k-th sample of the few lies at the same share of the many.
    shares_of_full = np.interp(short, full, np.linspace(0.0, 1.0, len(full)))
    assert shares_of_full == approx(np.linspace(0.0, 1.0, 200), abs=2.0 / len(full))


@mark.parametrize("span", [1e12, -1e300])
def test_an_orbit_that_cannot_be_followed_is_asked_for_at_even_times(span):
    # Its computation proper then says why.
    state, parameters = map(np.array, SYSTEM.example)
    times = sample_times(SYSTEM.at(parameters), state, span, np.full(5, 300.0), SAGITTA, MOST)
    assert np.diff(times) == approx(span / (MOST - 1))
