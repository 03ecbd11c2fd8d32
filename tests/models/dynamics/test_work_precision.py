"""Speed against accuracy on one motion: true errors, measured costs, and words that agree with the numbers."""

import dataclasses
import math
import re

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
    longest_span,
    measure_levels,
    measure_others,
    others_take_long,
)
from hess_mechanics.errors import WorkLimit
from hess_mechanics.numerics.accuracy import DRAFT, LEVELS
from hess_mechanics.numerics.patience import limited_by
from support.board import ACCURACY, HESS, Board, flat
from support.mechanics import scipy_states
from support.thorough import sample

SAMPLES = 200
PRESETS = [{**HESS.defaults(), **preset.values} for preset in HESS.presets]
some_presets = mark.parametrize("values", sample(PRESETS, 2))


def asked(motion):
    """Return the definition of a motion, without the weights."""
    return motion.system.name, motion.state, motion.parameters, motion.span


def independent(motion, times):
    """The same motion by another method."""
    return scipy_states(motion.system, motion.state, motion.parameters, times, 1e-13, 1e-15)


def unit_of(motion):
    """In this unit of frequency no |ω| exceeds 1: √(w² + 4|n|), the energy being as large as it may."""
    w1, w2, *n = motion.state
    return math.sqrt(w1**2 + w2**2 + 4.0 * math.hypot(*n))


def scale_of(motion):
    nu = unit_of(motion)
    return np.array([nu, nu, 1.0, 1.0, 1.0])


# --- The motion --------------------------------------------------------------------------------------------


@some_presets
@mark.parametrize("change", [{}, {"I22": 2.0, "I23": -0.5, "b3": 2.5, "phi0": -2.0, "span": 7.0}], ids=str)
def test_the_motion_looked_into_is_the_one_on_show(values, change):
    values = HESS.admit({**values, **change})[0]
    motion = HESS.of(values).motion()
    shown = HESS.compute(values, HESS.pictures, False).track
    own = solve(motion, motion.state, shown.orbit.times, LEVELS["standard"])
    assert np.array_equal(own.states, shown.orbit.states)
    assert shown.orbit.times[-1] == motion.span
    assert shown.orbit.times * motion.unit == approx(shown.times, rel=1e-14)


# --- Growth --------------------------------------------------------------------------------------------------


@some_presets
def test_errors_are_those_against_another_method(values):
    motion = HESS.of(values).motion()
    found = growth(*asked(motion), motion.weights, SAMPLES)
    truth = independent(motion, found.times)
    for name in ("draft", "standard", "precise"):
        states = solve(motion, motion.state, found.times, LEVELS[name]).states
        errors = np.max(np.abs(states - truth) / scale_of(motion), axis=1)
        assert errors.max() / 2.0 < found.errors[name].max() < errors.max() * 2.0
        assert found.errors[name] == approx(errors, abs=0.5 * errors.max())
        assert found.errors[name].max() < LEVELS[name].promise


@mark.parametrize("change", [{}, {"I22": 0.5, "I23": 1.5, "b3": 0.7, "h": 30.0}], ids=str)
def test_pixels_are_distances_in_the_pictures_of_the_scene(change):
    values = {**HESS.defaults(), **change}
    motion = HESS.of(values).motion()
    found = growth(*asked(motion), motion.weights, SAMPLES)
    result = HESS.compute(values, HESS.pictures, False)
    board = Board(HESS)
    board.show(result)
    width = board.ranges["omega"][1] - board.ranges["omega"][0]

    def seen(states):
        return result.body.from_reduced(result.body.from_units_of_b(states))

    truth = seen(independent(motion, found.times))
    for name in ("draft", "standard"):
        apart = seen(solve(motion, motion.state, found.times, LEVELS[name]).states) - truth
        # The sphere has a radius of half the picture.
        pixels = PIXELS * np.maximum(
            np.linalg.norm(apart[:, :2], axis=1) / width, np.linalg.norm(apart[:, 2:], axis=1) / 2.0
        )
        assert found.pixels[name] == approx(pixels, abs=0.01 * pixels.max())
    if not change:
        # A draft is right to a pixel over the first view.
        assert found.pixels["draft"].max() < 0.5


# --- Cost ------------------------------------------------------------------------------------------------------


def test_each_level_is_one_point_with_its_largest_error():
    motion = HESS.of(HESS.defaults()).motion()
    points = measure_levels(*asked(motion), SAMPLES)
    found = growth(*asked(motion), motion.weights, SAMPLES)
    assert [(one.method, one.setting, one.error) for one in points] == [
        ("Taylor", name, found.errors[name].max()) for name in LEVELS
    ]
    assert min(point.ms for point in points) > 0.0


def by_scipy(motion, method, tolerance, times=None):
    """The motion by one of SciPy's methods."""
    field, end = motion.system.field, (0.0, motion.span)
    return solve_ivp(
        lambda _, y: field(y, motion.parameters), end, motion.state, method, times, rtol=tolerance, atol=tolerance
    )


def test_the_methods_of_scipy_are_six_points_with_their_errors():
    motion = HESS.of({**HESS.defaults(), "span": 10.0}).motion()
    points = measure_others(*asked(motion), SAMPLES)
    assert [(point.method, point.setting) for point in points] == [
        (method, tolerance) for method in ("DOP853", "LSODA") for tolerance in ("1e-04", "1e-07", "1e-10")
    ]
    times = np.linspace(0.0, motion.span, SAMPLES)
    truth = independent(motion, times)
    for point in points:
        run = by_scipy(motion, point.method, float(point.setting), times)
        assert point.error == approx(np.max(np.abs(run.y.T - truth) / scale_of(motion)), rel=0.05)
        assert point.ms > 0.0


def test_the_methods_of_scipy_are_left_out_beyond_150_times_the_shortest_period():
    for values in ({}, {"h": 3.0, "f": -1.0}, {"b3": -0.2}, {"I22": 2.0, "I23": 1.0}):
        motion = HESS.of({**HESS.defaults(), **values}).motion()
        longest = 150.0 / unit_of(motion)
        assert not others_take_long(*asked(motion)[:3], longest * (1.0 - 1e-12))
        assert others_take_long(*asked(motion)[:3], longest * (1.0 + 1e-12))


def test_a_method_of_scipy_asks_in_mid_run_whether_to_go_on():
    motion, asks = HESS.of({**HESS.defaults(), "span": 40.0}).motion(), []

    def end():
        asks.append(None)
        # Each of the six runs asks when it begins.
        if len(asks) > 8:
            raise WorkLimit("enough")

    with limited_by(end, lambda seconds: None), raises(WorkLimit, match="enough"):
        measure_others(*asked(motion), SAMPLES)


# --- What the scene says ---------------------------------------------------------------------------------------

MOTION = dataclasses.replace(HESS.of(HESS.defaults()).motion(), unit=2.0)
TIMES = np.linspace(0.0, 10.0, 11)
WORK = (
    WorkPoint("Taylor", "draft", 1.0, 2e-4),
    WorkPoint("Taylor", "standard", 2.0, 3e-7),
    WorkPoint("Taylor", "precise", 4.0, 4e-10),
    WorkPoint("Taylor", "reference", 8.0, 0.0),
    WorkPoint("DOP853", "1e-04", 30.0, 1e-3),
    WorkPoint("DOP853", "1e-07", 50.0, 2e-6),
    WorkPoint("DOP853", "1e-10", 90.0, 1e-9),
    WorkPoint("LSODA", "1e-04", 20.0, 1e-2),
    WorkPoint("LSODA", "1e-07", 44.0, 1e-7),
    WorkPoint("LSODA", "1e-10", 60.0, 1e-8),
)


def made_up(pixels, error=1e-5, drifts=(1e-6, 2e-7, 3e-8)):
    """Errors that grow with the square of time up to `error`; the others are given at the end, or at each time."""
    along = (TIMES / 10.0) ** 2
    pixels = pixels if np.ndim(pixels) else pixels * along
    names = ("E", "F1", "F2", "K")
    return ErrorGrowth(
        TIMES,
        dict.fromkeys(LEVELS, error * along),
        dict.fromkeys(LEVELS, np.asarray(pixels)),
        {name: {key: drift * along for key, drift in zip(names, drifts, strict=False)} for name in LEVELS},
    )


def study(accuracy="standard", motion=MOTION, points=WORK, errors=None):
    """Return a state of the scene with made-up results, and its drawn data."""
    seen = ACCURACY.pictures if errors is not None else ("precision",)
    state = ACCURACY.of({**ACCURACY.defaults(), "accuracy": accuracy}, seen)
    vars(state.precision).update(followed=motion, measured=points, **({} if errors is None else {"growing": errors}))
    return ACCURACY.draw(state)


def shown(accuracy="standard", points=WORK, errors=None):
    """(Board, captions, report) of a study that is made up."""
    board = Board(ACCURACY)
    report = board.show(study(accuracy, points=points, errors=errors))
    return board, board.captions, report


@mark.parametrize(
    ("pixels", "accuracy", "said"),
    [
        # The page's time is twice the computation's here.
        (1.0, "draft", "draft: accurate to the end. Error below one pixel until t = 20 (at most 1)."),
        # Also where it comes right again later.
        (
            [0, 0, 0, 1.5, 0, 0, 0, 0, 0, 0, 0.1],
            "standard",
            "standard: not accurate to the end. Error below one pixel until t = 6.",
        ),
    ],
)
def test_the_caption_of_the_pixels_says_how_long_the_picture_is_right(pixels, accuracy, said):
    _, captions, _ = shown(accuracy, errors=made_up(pixels))
    assert captions["pixels"].splitlines()[1] == said


def test_the_other_captions_give_the_numbers_of_the_chosen_level():
    errors = made_up(0.5)
    errors.errors["precise"] = 3e-11 * TIMES / 10.0
    errors.drifts["precise"]["F1"] = 1e-12 * (TIMES / 10.0) * (1.0 - TIMES / 10.0)
    _, captions, report = shown("precise", errors=errors)
    assert captions["growth"].splitlines()[1] == "precise: 3e−11 at the end; promised 1e−9 (dotted)."
    assert captions["drift"].splitlines()[1] == "precise: largest drift (1) E 1e−6, (2) F1 2.5e−13, (3) F2 3e−8."
    assert captions["precision"].splitlines()[1].startswith("precise: 4 ms, error 4e−10")
    assert report.status.startswith("precise chosen · draft 1 ms, error 0.0002 · standard 2 ms, error 3e−7 · ")
    assert re.search(r"· [\d.]+ ms, cached$", report.status)
    assert "DOP853" not in report.status


@mark.parametrize(
    ("accuracy", "said"),
    [
        # The fastest of those of SciPy that are as exact, or nearly.
        ("draft", "draft: 1 ms, error 0.0002; DOP853: 30 × as long, 0.001."),
        ("standard", "standard: 2 ms, error 3e−7; LSODA: 22 × as long, 1e−7."),
        ("reference", "reference: 8 ms, error 0."),
    ],
)
def test_the_caption_of_the_cost_compares_with_what_is_as_exact(accuracy, said):
    assert shown(accuracy)[1]["precision"] == f"Cost against error\n{said}"


def test_each_chart_shows_its_curves_over_the_time_of_the_page():
    errors = made_up(4.0, drifts=(1e-6, 2e-7))
    data = shown("draft", errors=errors)[0].sources
    for name in LEVELS:
        for chart, values in (("growth", errors.errors[name]), ("pixels", errors.pixels[name])):
            own = data[f"{chart}-{name}"]
            assert own["x"] == approx(2.0 * TIMES)
            assert own["y"][1:] == approx(values[1:])
            assert own["y"][0] > 0.0
    assert [data[f"drift-integral-{i}"]["y"][-1] for i in (0, 1)] == approx([1e-6, 2e-7])
    # Two integrals: the other curves are empty.
    assert flat(list(data["drift-integral-2"].values())) == flat(list(data["drift-integral-3"].values())) == []
    # The dotted lines: what is promised, and one pixel.
    assert flat(data["growth-limit"]["y"]) == approx([DRAFT.promise] * 2)
    assert flat(data["pixels-limit"]["y"]) == [1.0] * 2
    # Paths of the moving points.
    assert data["data-orbit"]["t"] == approx(2.0 * TIMES)
    assert data["data-orbit"]["growth"][1:] == approx(errors.errors["draft"][1:])


def test_a_span_that_would_take_seconds_is_cut_with_a_note():
    motion = HESS.of(HESS.defaults()).motion()
    longest = longest_span(motion.system.name, motion.state, motion.parameters)
    assert longest * Problem.of(motion, motion.state).nu == approx(5000.0)
    free = scenes()["free-suslov"]
    long = scenes()["free-suslov-accuracy"].compute({**free.defaults(), "w1": 1e3, "span": 1e5}, {"growth"}, False)
    assert long.precision.followed.span < 1e3
    assert long.precision.growing.times[-1] == approx(long.precision.followed.span)
    (note,) = long.notes()
    assert note.startswith("Measured up to t = ")


# --- Clicks ------------------------------------------------------------------------------------------------------


def test_a_click_chooses_the_level_that_is_next_to_it_and_none_in_another_chart():
    exact = dataclasses.replace(WORK[3], error=4e-14)
    stage = shown(points=(*WORK[:3], exact, *WORK[4:]))[0].stage
    errors = (1e-1, 1e-3, 1e-6, 1e-9, 1e-13, 1e-20)
    chosen = [stage.pick("precision", error, 1.0) for error in errors]
    assert [one["accuracy"] for one in chosen] == ["draft", "draft", "standard", "precise", "reference", "reference"]
    assert stage.pick("precision", 0.0, 1.0) == stage.pick("precision", -1.0, 1.0) == {}
    assert stage.pick("growth", 1e-6, 1.0) == {}
