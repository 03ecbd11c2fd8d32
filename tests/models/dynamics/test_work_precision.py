"""Speed against accuracy on one motion: true errors, measured costs, and captions that agree with the numbers."""

from dataclasses import replace
from itertools import product

import numpy as np
from pytest import approx, mark, raises
from scipy.integrate import solve_ivp

from hess_explorer.scenes import scenes
from hess_mechanics.dynamics.orbit import solve
from hess_mechanics.dynamics.sampling import PIXELS
from hess_mechanics.dynamics.system import Problem
from hess_mechanics.dynamics.work_precision import (
    ErrorGrowth,
    WorkPoint,
    growth,
    measure_levels,
    measure_scipy,
    scipy_takes_long,
)
from hess_mechanics.errors import WorkLimit
from hess_mechanics.numerics.accuracy import LEVELS
from hess_mechanics.numerics.patience import work_limit
from support.board import ACCURACY, HESS, Board
from support.mechanics import scipy_states

SAMPLES = 200


def motion_of(**values):
    return HESS.of({**HESS.defaults(), **values}).motion()


def truth(motion, times):
    return scipy_states(motion.system, motion.start, motion.parameters, times, 1e-13, 1e-15)


def unit_of(motion):
    """In this unit of frequency no |ω| exceeds 1: √(w² + 4|n|), the energy being as large as it may."""
    w1, w2, *n = motion.start
    return np.sqrt(w1**2 + w2**2 + 4.0 * np.linalg.norm(n))


def scale_of(motion):
    return unit_of(motion) ** np.array([1, 1, 0, 0, 0])


@mark.parametrize("change", [{}, {"I22": 0.5, "I23": 1.5, "b3": 0.7, "h": 30.0}], ids=str)
def test_errors_and_pixels_are_those_against_another_method(change):
    motion = motion_of(**change)
    found = growth(*motion.arguments, motion.weights, SAMPLES)
    result = HESS.compute({**HESS.defaults(), **change}, HESS.pictures, False)
    board = Board(HESS)
    board.show(result)
    width = np.diff(board.ranges["omega"])[0]
    exact = truth(motion, found.times)

    def seen(states):
        return result.body.from_reduced(result.body.from_units_of_b(states))

    for name in ("draft", "standard"):
        states = solve(motion, motion.start, found.times, name).states
        errors = np.max(np.abs(states - exact) / scale_of(motion), axis=1)
        assert found.errors[name] == approx(errors, abs=0.5 * errors.max())
        assert errors.max() / 2.0 < found.errors[name].max() < LEVELS[name].promise
        # The sphere has a radius of half the picture.
        apart = (seen(states) - seen(exact)) / np.array([width, width, 2.0, 2.0, 2.0])
        pixels = PIXELS * np.maximum(*(np.linalg.norm(part, axis=1) for part in (apart[:, :2], apart[:, 2:])))
        assert found.pixels[name] == approx(pixels, abs=0.01 * pixels.max())
    points = measure_levels(*motion.arguments, SAMPLES)
    assert [(one.setting, one.error) for one in points] == [(name, found.errors[name].max()) for name in LEVELS]
    assert min(point.ms for point in points) > 0.0


def test_the_methods_of_scipy_are_six_points_with_their_errors():
    motion = motion_of(span=10.0)
    times = np.linspace(0.0, motion.duration, SAMPLES)
    points = measure_scipy(*motion.arguments, SAMPLES)
    wanted = product(("DOP853", "LSODA"), ("1e-04", "1e-07", "1e-10"))
    for point, (method, tolerance) in zip(points, wanted, strict=True):
        assert (point.method, point.setting) == (method, tolerance)
        run = solve_ivp(
            lambda _, y: motion.system.field(y, motion.parameters),
            (0.0, motion.duration),
            motion.start,
            method,
            times,
            rtol=float(tolerance),
            atol=float(tolerance),
        )
        assert point.error == approx(np.max(np.abs(run.y.T - truth(motion, times)) / scale_of(motion)), rel=0.05)
        assert point.ms > 0.0


def test_the_methods_of_scipy_are_left_out_beyond_150_times_the_shortest_period():
    for motion in (motion_of(h=3.0, f=-1.0), motion_of(I22=2.0, I23=1.0)):
        longest = 150.0 / unit_of(motion)
        assert not scipy_takes_long(*motion.arguments[:3], longest * (1.0 - 1e-12))
        assert scipy_takes_long(*motion.arguments[:3], longest * (1.0 + 1e-12))


def test_a_method_of_scipy_asks_in_mid_run_whether_to_go_on():
    asks = []

    def end():
        asks.append(None)
        # Each of the six runs asks when it begins.
        if len(asks) > 8:
            raise WorkLimit("enough")

    with work_limit(end, lambda seconds: None), raises(WorkLimit, match="enough"):
        measure_scipy(*motion_of(span=40.0).arguments, SAMPLES)


# ---- the scene ------------------------------------------------------------------------------------------------------

WORK = (
    WorkPoint("Taylor", "draft", 1.0, 2e-4),
    WorkPoint("Taylor", "standard", 2.0, 3e-7),
    WorkPoint("Taylor", "precise", 4.0, 4e-10),
    WorkPoint("Taylor", "reference", 8.0, 4e-14),
    WorkPoint("DOP853", "1e-07", 50.0, 2e-6),
    WorkPoint("LSODA", "1e-07", 44.0, 1e-7),
)


def test_captions_say_how_long_the_picture_is_right_and_what_another_method_costs():
    """Of made-up results at t = 0, …, 10, of which the page's time is twice that."""
    times = np.linspace(0.0, 10.0, 11)
    none = dict.fromkeys(LEVELS, 0.0 * times)
    # Too large at one time only: it comes right again later.
    pixels = dict.fromkeys(LEVELS, 1.5 * (times == 3.0))
    growing = ErrorGrowth(times, none, pixels, {name: {"E": none[name]} for name in LEVELS})
    state = ACCURACY.of({**ACCURACY.defaults(), "accuracy": "standard"}, ACCURACY.pictures)
    vars(state.precision).update(limited_motion=replace(motion_of(), unit=2.0), work_points=WORK, growth=growing)
    board = Board(ACCURACY)
    board.show(ACCURACY.draw(state))
    assert "Error below one pixel until t = 6." in board.captions["pixels"]
    # The faster of SciPy's methods that are as exact, or nearly.
    assert "LSODA: 22 × as long" in board.captions["precision"]
    # A click chooses the nearest level, in one chart only.
    chosen = [board.stage.pick("precision", error, 1.0)["accuracy"] for error in (1e-1, 1e-6, 1e-9, 1e-20)]
    assert chosen == ["draft", "standard", "precise", "reference"]
    assert board.stage.pick("precision", 0.0, 1.0) == board.stage.pick("growth", 1e-6, 1.0) == {}


def test_a_span_that_would_take_seconds_is_cut_with_a_note():
    free = scenes()["free-suslov"].defaults()
    long = scenes()["free-suslov-accuracy"].compute({**free, "w1": 1e3, "span": 1e5}, {"growth"}, False)
    motion = long.precision.limited_motion
    assert motion.duration * Problem.of(motion, motion.start).nu == approx(5000.0)
    assert long.precision.growth.times[-1] == approx(motion.duration)
    (note,) = long.notes()
    assert note.startswith("Measured up to t = ")
