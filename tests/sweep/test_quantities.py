"""Quantities equal hand-written loops bit for bit, and agree with other methods."""

from math import hypot, log

import numpy as np
import pytest
from pytest import approx

from hess_explorer.sweep import QUANTITIES, Outcome, sweep
from hess_mechanics import BallBody, HeavyBody, circle_map, level, section, systems
from hess_mechanics.chaplygin_ball.section import EQUATOR, BallSection
from hess_mechanics.dynamics.lyapunov import lyapunov_exponent
from hess_mechanics.euler_poisson.andoyer import AndoyerPlane
from hess_mechanics.numerics.accuracy import PLANS, Kind
from hess_mechanics.suslov.kharlamova import PlaneBody, arc
from hess_mechanics.suslov_hess.rotation_number import values_at
from support.andoyer import start_by_hand
from support.deviations import deviations

SUSLOV, HEAVY = systems()["suslov"], systems()["euler-poisson"]


def rotation(h, f):
    return values_at(0.5, h, f, level("precise")).rho[0]


def exponent(w1, I22, t=20.0):
    state = (w1, -0.4, 0.6, 0.0, 0.8)
    p = (2.0, I22, 0.3, 0.5, 0.3, -0.5, 1.0)
    return lyapunov_exponent(SUSLOV.at(p), state, t, PLANS[Kind.EXPONENT]["draft"].level).value


def plane_period(w1, b1):
    found = arc(PlaneBody(1.3, 0.8, b1, -0.2), (w1, -0.5, 0.0, 0.6, 0.8))
    return found.period


def ball_returns(psi, delta, t=30.0):
    body = BallBody(*systems()["ball"].example[1])
    states, _ = BallSection(body, 2.0 - hypot(body.b1, body.b2)).states_at([psi], [delta])
    return float(section(body, states[0], EQUATOR, t, level("standard")).times.size)


def heavy_returns(l, x, t=20.0):
    parameters = HEAVY.example[1]
    state = start_by_hand(HeavyBody(parameters[:3], parameters[3:6], parameters[6]), 2.0, 0.5, l, x)
    found = section(HEAVY.at(parameters), state, AndoyerPlane(0.5), t, level("standard"))
    return float(found.times.size)


LOOPS = {
    "rotation-number": ({"h": (-1.2, 2.0, 9), "f": (0.0, 1.2, 7)}, {"a": 0.5}, "precise", rotation),
    "lyapunov-suslov": ({"w1": [0.8, -0.3], "I22": [1.0, 1.7]}, {"t": 20.0}, "draft", exponent),
    "crossings-ball-section": ({"psi": [0.3, 2.0], "delta": [0.5, 1.5]}, {"t": 30.0}, "standard", ball_returns),
    "crossings-euler-poisson-section": ({"l": [-2.0, 0.5], "x": [0.1, 0.4]}, {"t": 20.0}, "standard", heavy_returns),
    "period": ({"w1": (0.5, 2.0, 4), "b1": (0.1, 0.7, 3)}, {}, "precise", plane_period),
}


@pytest.mark.parametrize("name", LOOPS)
def test_a_sweep_is_the_loop_by_hand_bit_for_bit(name):
    over, fixed, accuracy, function = LOOPS[name]
    found = sweep(name, over, level=accuracy, **fixed)
    value = found[name.replace("-", "_")]
    axes = [np.linspace(*places) if isinstance(places, tuple) else np.array(places) for places in over.values()]
    assert value.shape == tuple(axis.size for axis in axes)
    by_hand = np.array(
        [
            function(*(float(x) for x in place))
            for place in np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, len(axes))
        ]
    )
    assert value.values.ravel().tobytes() == by_hand.tobytes()
    for coordinate, axis in zip(over, axes, strict=True):
        assert found[coordinate].values.tobytes() == axis.tobytes()
    ended = found.status.values.ravel()
    assert np.array_equal(np.isnan(by_hand), ended >= 10)
    assert (ended < 10).any()


def test_limit_cycles_are_several_numbers_at_a_cell():
    found = sweep("limit-cycles", {"h": [-1.5, 0.2, 1.5, 2.0], "f": [0.6]}, a=0.5)
    assert found.limit_cycles.dims == ("h", "f", "number")
    assert found.number.values.tolist() == ["stable", "unstable", "log_multiplier"]
    assert found.status.values[:, 0].tolist() == [Outcome.OUTSIDE_REGION, Outcome.NO_VALUE, Outcome.OK, Outcome.OK]
    theta = circle_map(0.5, 1.5, 0.6, level("precise"))
    stable, unstable, grown = found.limit_cycles.sel(h=1.5, f=0.6).values
    # Fixed points of the map, and the slope there by a difference.
    assert theta.theta([stable, unstable]) == approx([stable, unstable], abs=1e-10)
    ends = theta.theta([stable - 1e-5, stable + 1e-5])
    assert log((ends[1] - ends[0]) / 2e-5) == approx(grown, abs=1e-6)
    assert found.error.values[0, 0] != found.error.values[0, 0]
    assert 0.0 < found.error.values[2, 0] < 1e-9


def test_trace_locking_and_birth_agree_with_the_rotation_number():
    over = {"h": (-0.5, 2.0, 6), "f": (0.1, 0.7, 4)}
    rho, trace, locked = (
        sweep(name, over, a=0.5)[name.replace("-", "_")].values for name in ("rotation-number", "trace", "locked")
    )
    turning = locked == 0.0
    assert turning.any()
    assert (locked == 1.0).any()
    assert trace[turning] == approx(np.abs(2.0 * np.cos(np.pi * rho[turning])), abs=1e-9)
    assert np.all(trace[locked == 1.0] > 2.0)
    born = sweep("critical-a", {"h": [0.5, 1.5]}, f=0.3).critical_a.values
    for h, a in zip((0.5, 1.5), born, strict=True):
        assert circle_map(a, h, 0.3, level("reference")).trace == approx(2.0, abs=1e-9)


def test_where_volume_is_kept_nothing_attracts():
    over = {"I13": [0.0, 0.4]}
    body = {
        "I11": 1.5,
        "I22": 1.0,
        "I23": 0.0,
        "b1": 0.3,
        "b2": -0.5,
        "b3": 1.0,
        "h": round(1.842 + hypot(0.3, 0.5, 1.0), 6),
    }
    divergence = sweep("divergence-suslov-section", over, **body, t=100.0)
    assert divergence.divergence_suslov_section.values[0] == 0.0
    assert divergence.error.values[0] == 0.0
    assert divergence.error.values[1] > 0.0
    # The example "Two attractors" of the scene.
    assert sweep("attractors", over, level="draft", **body, t=1000.0).attractors.values.tolist() == [0.0, 2.0]


def test_all_exponents_of_a_cell_stand_side_by_side():
    found = sweep("spectrum-suslov", {"I13": [0.0, 0.3]}, level="draft", t=10.0, I23=0.0)
    assert found.spectrum_suslov.shape == (2, 5)
    assert found.number.values.tolist() == ["1", "2", "3", "4", "5"]
    # Their sum is the divergence, which is 0 with I13 = I23 = 0 alone.
    together = found.spectrum_suslov.sum("number").values
    assert together[0] == approx(0.0, abs=1e-6)
    assert abs(together[1]) > 1e-4


@pytest.mark.chaotic
def test_kinds_of_motions_are_those_that_are_known():
    found = QUANTITIES["regime-suslov-section"]
    names = [one.name for one in found.parameters]
    # A permanent rotation attracts; closed curves where I11 = I22 and b is along e; and chaos on an attractor.
    rows = [
        (1.0, 3.0, 0.6, 0.6, 1.0, 0.7, 0.3, 3.0, 3, 1.0, 1.0, 300, 200, 300.0),
        (1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.4, 3, 0.3, 1.2, 300, 200, 300.0),
        *(
            (1.5, 2.9, -0.6, 1.0, 1.0, -0.6, 0.6, 2.600488, 3, -0.7446 + 1e-3 * k, 1.5603, 300, 200, 300.0)
            for k in range(36)
        ),
    ]
    cells = {name: np.array(column, float) for name, column in zip(names, zip(*rows, strict=True), strict=True)}
    values = found.compute(cells, level("standard")).values
    assert values[:2].tolist() == [[1.0, 1.0, -1.0], [3.0, 0.0, 0.0]]
    assert not values[2:, 1].any()
    assert deviations(values[2:, 0] == 4.0, 0.5) > 5.0
