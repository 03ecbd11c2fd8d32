"""Samples of an orbit: few, but dense enough that the polyline looks like the curve at every time."""

import math
import time

import numpy as np
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from pytest import approx, mark

from hess_explorer.scenes.suslov_hess import SuslovHess
from hess_mechanics import HessBody, circle_map, f_max, level, systems
from hess_mechanics.dynamics.orbit import solve
from hess_mechanics.dynamics.sampling import PIXELS, SAGITTA, sample_times
from hess_mechanics.suslov_hess.equations import SYSTEM
from hess_mechanics.suslov_hess.torus import cycles, pixels_per_unit, start_of_track, track
from support.thorough import examples, sample

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


@settings(max_examples=examples(20))
@given(bodies(10.0), energies, shares, phases, spans)
def test_with_any_a_of_the_sliders_it_is_the_curve_to_half_a_pixel(body, h, share, phi0, span):
    # At f = 0, h < 1 a large a makes the motion magnify its errors by e^(2πa): no orbit to compare with.
    assume(share != 0.0 or h > 1.0)
    error, samples = error_of_track(body, h, share * f_max(h), phi0, span)
    assume(samples < MOST)
    assert error < 2.0 * SAGITTA


@mark.parametrize("accuracy", ["draft", "standard", "precise"])
def test_samples_of_cheaper_levels_lie_where_those_of_the_reference_lie(accuracy):
    times = [track(BODY, 1.5, 0.6, 0.5, 40.0, rung, 4.0).times for rung in (level(accuracy), REFERENCE)]
    assert np.array_equal(*times)


@mark.parametrize(("h", "f", "span"), [(0.999999, 1e-6, 200.0), (1.0, 1e-6, 200.0), (1.0 + 1e-9, 1e-8, 90.0)])
def test_close_to_the_separatrix_the_samples_lie_where_the_orbit_bends_too(h, f, span):
    error, samples = error_of_track(HessBody(1.0, -0.5, -1.0), h, f, 0.5, span)
    assert samples < MOST
    assert error < SAGITTA * ALMOST


@settings(max_examples=examples(6))
@given(bodies(1.0), st.floats(1.05, 4.0), st.floats(0.0, 0.5))
def test_limit_cycles_are_their_polylines_too(body, h, share):
    f = share * f_max(h)
    theta = circle_map(body.a, h, f, REFERENCE)
    assume(theta.kind == "hyperbolic")
    width = half_width(body, h)
    weights = pixels_per_unit(body, width)
    stable, unstable = cycles(body, h, f, theta.fixed_points[0], REFERENCE, width)
    times, states = stable.orbit.times, stable.orbit.states
    assert farthest(times, states, orbit_of(body, states[0]), between(times), weights) < SAGITTA * ALMOST
    # The other one is its mirror image, sample by sample.
    assert unstable.orbit.times == approx(times[-1] - times[::-1])


def middles(body, h, f, phi0, span):
    """(Times of the samples, how far each chord's middle lies from the curve, in all five variables)."""
    weights = pixels_per_unit(body, half_width(body, h))
    start, length = start_of_track(body, h, f, phi0, span)
    times = sample_times(SYSTEM.at(np.array([body.a, 1.0])), start, length, weights, SAGITTA, MOST)
    solution = orbit_of(body, start)
    ends = solution(times) * weights
    apart = solution(0.5 * (times[1:] + times[:-1])) * weights - 0.5 * (ends[1:] + ends[:-1])
    return times, np.linalg.norm(apart, axis=1)


@mark.parametrize(("h", "f"), [(1.5, 0.6), (0.2, 0.5), (1.001, 0.001), (3.0, -1.0), (-0.5, 0.1)])
def test_no_sample_is_wasted_every_chord_is_equally_far_from_its_curve(h, f):
    times, distances = middles(BODY, h, f, 0.5, 40.0)
    assert len(times) > 100
    assert distances.min() > 0.9 * SAGITTA
    assert distances.max() < ALMOST * SAGITTA


def test_near_the_separatrix_gaps_are_long_where_the_motion_rests():
    times, _ = middles(BODY, 1.001, 0.001, 0.5, 40.0)
    gaps = np.diff(times)
    n3 = orbit_of(BODY, start_of_track(BODY, 1.001, 0.001, 0.5, 40.0)[0])(0.5 * (times[1:] + times[:-1]))[:, 4]
    resting, fast = n3 < -0.95, n3 > 0.5
    assert gaps[resting].min() > 3.0 * gaps[fast].max()
    # As even samples it would take more than twice as many for the same chords in the fast parts.
    assert times[-1] / gaps.min() > 2.0 * len(times)


def of_default(span=40.0, factor=1.0, sagitta=SAGITTA, most=10**6):
    start, _ = start_of_track(BODY, 1.5, 0.6, 0.5, span)
    weights = factor * pixels_per_unit(BODY, 4.0)
    return sample_times(SYSTEM.at(np.array([BODY.a, 1.0])), start, span, weights, sagitta, most)


def test_four_times_the_size_or_a_quarter_of_the_sagitta_takes_twice_the_samples():
    gaps = len(of_default()) - 1
    assert len(of_default(factor=4.0)) - 1 == approx(2 * gaps, abs=2)
    assert np.array_equal(of_default(factor=4.0), of_default(sagitta=SAGITTA / 4))
    # And twice the span about twice as many.
    assert len(of_default(80.0)) == approx(2 * gaps, rel=0.05)


def test_the_same_motion_in_another_unit_of_time_is_sampled_at_the_same_places():
    one, other = BODY, HessBody(0.96, 0.28, -2.25)
    first = track(one, 1.5, 0.6, 0.5, 40.0, REFERENCE, half_width(one, 1.5))
    # 1.5 times as fast.  Its frame is a rounder number, so that its samples are a few more or less.
    second = track(other, 1.5, 0.6, 0.5, 40.0 / 1.5, REFERENCE, 1.5 * half_width(one, 1.5))
    assert second.times * 1.5 == approx(first.times, rel=1e-9)
    assert second.gamma == approx(first.gamma, abs=1e-9)


@mark.parametrize("body", [HessBody(0.5, 0.4, -2.5), HessBody(1.0, -3.0, 0.7)])
def test_a_unit_of_each_variable_is_as_many_pixels_in_the_pictures_as_is_said(body):
    states = body.from_reduced(body.from_units_of_b(np.eye(5)))
    # A picture shows ω up to 4 to each side, the other one the unit sphere.
    omega = np.linalg.norm(states[:, :2], axis=1) / 4.0 * (PIXELS / 2)
    gamma = np.linalg.norm(states[:, 2:], axis=1) * (PIXELS / 2)
    assert pixels_per_unit(body, 4.0) == approx(np.concatenate([omega[:2], gamma[2:]]))


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


def test_back_in_time_the_samples_lie_at_the_same_places():
    start, _ = start_of_track(BODY, 1.5, 0.6, 0.5, 12.0)
    weights, parameters = pixels_per_unit(BODY, 4.0), np.array([BODY.a, 1.0])
    end = orbit_of(BODY, start)(np.array([12.0]))[0]
    forward = sample_times(SYSTEM.at(parameters), start, 12.0, weights, SAGITTA, MOST)
    backward = sample_times(SYSTEM.at(parameters), end, -12.0, weights, SAGITTA, MOST)
    # The same but for the rule by which the density is summed up: to a twentieth of a gap.
    assert 12.0 + backward[::-1] == approx(forward, abs=0.05 * np.diff(forward).min())


@mark.parametrize("n3", [-1.0, 1.0])
def test_at_an_equilibrium_some_even_samples_are_enough(n3):
    state = np.array([0.0, 0.0, 0.0, 0.0, n3])
    times = sample_times(SYSTEM.at(np.array([0.3, 1.0])), state, 40.0, np.full(5, 300.0), SAGITTA, MOST)
    assert 8 <= len(times) <= 32
    assert np.diff(times) == approx(40.0 / (len(times) - 1))


@mark.parametrize("name", sample(systems(), 1))
def test_absurd_spans_take_no_longer_than_the_budget_allows(name):
    system = systems()[name]
    state, parameters = map(np.array, system.example)
    weights = np.full(len(state), 300.0)
    sample_times(system.at(parameters), state, 1.0, weights, SAGITTA, MOST)
    # The budget of steps ends all long spans alike.
    for span in (1e-300, -1e-300, 1e-12, -1e-12, 1e6, -1e300):
        before = time.process_time()
        times = sample_times(system.at(parameters), state, span, weights, SAGITTA, MOST)
        assert time.process_time() - before < 5.0
        assert (times[0], times[-1]) == (0.0, span)
        assert len(times) <= MOST
        assert np.all(np.diff(times) * np.sign(span) > 0.0)


def test_an_orbit_that_cannot_be_followed_is_asked_for_at_even_times():
    # Its computation proper then says why.
    state, parameters = map(np.array, SYSTEM.example)
    times = sample_times(SYSTEM.at(parameters), state, 1e12, np.full(5, 300.0), SAGITTA, MOST)
    assert np.diff(times) == approx(1e12 / (MOST - 1))
