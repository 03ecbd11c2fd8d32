"""Swarms: their starts, the error of their motions, their spread, and what the browser gets."""

import numpy as np
import pytest
from pytest import approx
from scipy.interpolate import CubicSpline

import oracle
from hess_explorer.compute.cache import CACHE
from hess_explorer.export.columns import columns_of
from hess_explorer.export.picture_data import picture_data
from hess_explorer.protocol.wire import Wire
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.scene import Motion
from hess_explorer.scenes.framework.swarm_motions import swarm_motions, turned_starts
from support.view import values_of
from support.wire import read

SWARMS = [name for name, scene in scenes().items() if "swarm" in scene.tracks]
PIXEL = 0.5


def swarm_of(name, words="", **values):
    """The state and the swarm of an example, or of the defaults."""
    scene = scenes()[name]
    given = values_of(scene, words) if words else {}
    state = scene.of(scene.admit({**scene.defaults(), **given, "swarm": "50", **values})[0], ("omega",))
    return state, state.swarm_part


def exact(motion, start, times):
    """States (m, d) at times of the system, in long double precision."""
    given = ([[repr(float(one)) for one in numbers]] for numbers in (start, motion.parameters, times))
    return oracle.orbits_in_long_double(motion.system, *given)[0].astype(float)


def interpolated(samples, share):
    """The cubic through four samples (m, d) at a share between two of them."""
    i = min(max(int(share), 1), len(samples) - 3)
    nodes = np.arange(i - 1, i + 3)
    weights = [np.prod([(share - k) / (j - k) for k in nodes if k != j]) for j in nodes]
    return np.tensordot(weights, samples[nodes], 1)


@pytest.mark.parametrize("name", SWARMS)
def test_every_bead_is_right_to_half_a_pixel_while_it_is_shown(name):
    state, part = swarm_of(name)
    motion, found = state.motion(), part.motions
    spacing = found.times[1]
    rng = np.random.default_rng(7)
    # The last of 50 starts is next to the first.
    for i in (17, 49):
        # Where they are worst: halfway; beyond the first interval, of whose ends one is no inner one.
        shares = np.sort(rng.integers(1, max(2, int(found.until[i]) - 2), 6)) + 0.5
        for share, true in zip(shares, exact(motion, found.states[i, 0], spacing * shares), strict=True):
            apart = np.abs(interpolated(found.states[i], share) - true) * motion.weights
            assert apart.max() < PIXEL, (i, share)
    assert found.until.max() > 10


@pytest.mark.parametrize("name", SWARMS)
def test_starts_have_the_integrals_of_the_motion_and_lie_evenly_about_it(name):
    state, part = swarm_of(name)
    motion, starts = state.motion(), part.motions.states[:, 0]
    integrals = motion.system.integrals([*starts.T], motion.parameters)
    for own, all_ in zip(
        motion.system.integrals([*motion.start], motion.parameters).values(), integrals.values(), strict=True
    ):
        assert np.asarray(all_) == approx(float(own), rel=1e-12, abs=1e-12)
    assert np.ptp(np.diff(part.angles)) < 1e-12
    assert part.angles[-1] - part.angles[0] == approx(2 * np.pi * 49 / 50)
    near = swarm_of(name, swarm_from="near this start")[1].angles
    assert near == approx(0.02 * part.angles)


def test_on_a_line_they_lie_between_the_last_two_clicked_points_where_a_motion_is_possible():
    state, part = swarm_of("suslov", swarm="8", swarm_from="along a line", starts="1,1;0.2,0.9;1.6,2.3")
    psi, delta = state.poincare.points_of(part.motions.states[:, 0]).T
    assert psi == approx(np.linspace(0.2, 1.6, 8))
    assert delta == approx(np.linspace(0.9, 2.3, 8))
    # Left of ψ = −π/4 no motion is possible.
    state, part = swarm_of("suslov", swarm="50", swarm_from="along a line", starts="-2.5,1;1,1")
    psi = state.poincare.points_of(part.motions.states[:, 0])[:, 0]
    assert psi == approx(np.linspace(-2.5, 1.0, 50)[-len(psi) :])
    assert psi.min() == approx(-np.pi / 4, abs=3.5 / 49)
    assert part.track()["count"] == len(psi)
    # With one point they are spread, and it is said how to choose the other.
    state, part = swarm_of("suslov", swarm="8", swarm_from="along a line", starts="1,1")
    assert part.motions.states[:, 0] == approx(swarm_of("suslov", swarm="8")[1].motions.states[:, 0])
    assert any("second point" in note for note in state.notes())
    assert "along a line" not in next(one for one in scenes()["quartic"].specs if one.name == "swarm_from").options


def test_a_turned_momentum_keeps_the_area_integral_and_a_turned_velocity_its_direction():
    euler, suslov = (swarm_of(name)[0].motion() for name in ("euler-poisson", "suslov"))
    angles = np.array([-2.0, 0.0, 0.4])
    M, gamma = np.split(turned_starts(euler, angles), 2, axis=1)
    assert np.sum(M * gamma, axis=1) == approx(np.dot(euler.start[:3], euler.start[3:]))
    assert [*M[1], *gamma[1]] == approx(euler.start)
    w = turned_starts(suslov, angles)[:, :2]
    assert np.arctan2(w[:, 1], w[:, 0]) - np.arctan2(*suslov.start[1::-1]) == approx(angles)


def test_neighbours_approach_by_the_multiplier_of_the_cycle_forward_and_backward():
    for sense in ("forward", "backward"):
        state, part = swarm_of("suslov-hess", swarm="8", swarm_time=sense, span=60.0)
        times, (_, median, _) = part.spread
        turns = state.map.period / state.body.frequency_unit / times[1]
        # After five returns most are close to the cycle, and after seven not yet as close as their errors.
        first, second = round(5 * turns), round(7 * turns)
        multiplier = state.map.fixed_points[0].multiplier
        assert median[second] / median[first] == approx(multiplier**2, rel=0.05)
        assert np.log(part.expected[1][1]) / np.log(multiplier) == approx(times[-1] / times[1] / turns)
    # Backward they end on the unstable cycle.
    ends = part.motions.states[:, -1]
    assert np.ptp(np.arctan2(ends[:, 0], ends[:, 1])) < 0.01


def computed(name, words="", **values):
    """The swarm of a state whose tasks are done."""
    for _ in range(4):
        state, part = swarm_of(name, words, **values)
        _ = part.expected
        for task in state.work.todo:
            CACHE.get(task.function, *task.arguments)
    return part


@pytest.mark.chaotic
def test_the_graph_has_the_exponent_of_the_chosen_orbit_if_that_is_chaotic_and_time_runs_forward():
    part = computed("suslov", "A chaotic")
    times, growth = part.expected
    exponent = part.host.exponent.result
    assert np.log(growth) == approx(exponent.value * times)
    assert "λ = " in part.caption.numbers
    assert computed("suslov", "A chaotic", swarm_time="backward").expected is None
    regular = computed("suslov", "Regular")
    assert regular.host.exponent.result.is_regular
    assert regular.expected is None


def test_in_chaos_beads_fade_when_they_are_not_known_any_more():
    state, part = swarm_of("suslov", "A chaotic", swarm="8", span=3000.0)
    motion, found = state.motion(), part.motions
    assert found.until.min() < 0.9 * (found.times.size - 1)
    i = int(found.until.argmin())
    share = int(found.until[i]) - 0.5
    (true,) = exact(motion, found.states[i, 0], [found.times[1] * share])
    assert (np.abs(interpolated(found.states[i], share) - true) * motion.weights).max() < PIXEL
    assert any("fade" in note or "shown up to" in note for note in state.notes())
    # A regular motion is known to its end, and nothing is said.
    state, part = swarm_of("suslov-hess")
    assert part.motions.until.min() == part.motions.times.size - 1
    assert not any("shown up to" in note or "fade" in note for note in state.notes())


@pytest.mark.parametrize("count", ["2", "8", "2000"])
def test_the_browser_gets_the_columns_in_two_megabytes(count):
    state, part = swarm_of("suslov-hess", swarm=count)
    wire = Wire()
    wire.put("data-swarm", part.track())
    tree, block = wire.pack()
    got = {name: read(one, block) for name, one in tree["sources"]["data-swarm"].items()}
    n, m, _ = part.motions.states.shape
    assert (got["count"], n) == (int(count), int(count))
    assert len(block) < 2_000_000
    assert len(got["values"]) == len(got["names"]) * n * m
    values = got["values"].astype(float).reshape(len(got["names"]), m, n)
    values = np.array(got["low"])[:, None, None] + np.array(got["step"])[:, None, None] * (values + 32767)
    columns = dict(zip(got["names"], values, strict=True))
    # ω, γ and φ of the states, by the formulas of the body's axes.
    w1, w2, *_ = np.moveaxis(part.motions.states, 2, 0)
    assert approx(np.arctan2(w1, w2), abs=1e-3) == columns["phi"].T
    unit = state.body.frequency_unit
    assert approx(unit * w1, abs=1e-3) == columns["omega1"].T
    assert approx(unit * np.hypot(1.0, state.body.a) * w2, abs=1e-3) == columns["omega2"].T
    assert sum(columns[f"g{i}"] ** 2 for i in (1, 2, 3)) == approx(1.0, abs=1e-3)
    # The phase of the last return, at whose time n3 is lowest.
    period = round(state.map.period / part.motions.times[1])
    assert columns["phi_start"][: 2 * period] == approx(
        np.repeat(columns["phi"][[0, period]], period, axis=0)[:m], abs=1e-3
    )


def test_without_a_swarm_nothing_is_computed_or_sent():
    state, part = swarm_of("suslov-hess", swarm="1")
    assert part.motions is part.spread is part.track() is None
    assert part.caption.numbers == part.reason == "Choose more than one body in the group Swarm, with possible starts."
    # The same motion with and without beads: no other result depends on them.
    assert swarm_of("suslov-hess")[0] == state


def test_a_batch_is_as_long_as_its_size_allows():
    motion = swarm_of("suslov-hess")[0].motion()
    short = swarm_motions(motion, (motion.start,) * 3, 20, None)
    assert isinstance(motion, Motion)
    assert short.times.size <= 20
    assert short.times[-1] < motion.duration
    assert short.until == approx(short.times.size - 1)


def test_the_introduction_says_what_its_fifty_bodies_do():
    gathered = {}
    for I23 in (0.05, 0.154, 0.16, 0.28):
        part = swarm_of("suslov-hess", I23=I23, span=400.0)[1]
        phases = np.arctan2(*np.moveaxis(part.motions.states[:, -1, :2], 1, 0))
        close = np.abs((phases - np.median(phases) + np.pi) % (2 * np.pi) - np.pi) < 0.01
        gathered[I23] = close.mean()
    assert gathered[0.05] < 0.1
    # A start next to the repeller takes longest.
    assert gathered[0.28] >= 0.98
    # Between 0.153 and 0.155 the loops appear.
    kinds = [swarm_of("suslov-hess", I23=I23)[0].kind for I23 in (0.05, 0.153, 0.155, 0.16)]
    assert kinds == ["elliptic", "elliptic", "hyperbolic", "hyperbolic"]


@pytest.mark.parametrize("sense", ["forward", "backward"])
def test_the_centres_of_mass_move_in_space_with_the_angular_velocity_of_their_bodies(sense):
    state, part = swarm_of("suslov-hess", swarm="8", swarm_time=sense, span=20.0)
    found, sign = part.motions, -1.0 if sense == "backward" else 1.0
    columns = part.swarm.columns(state, found.times, found.states)
    times = found.times / state.body.frequency_unit
    places = part._centres(found, columns)
    r = np.asarray(state.solid.mass.along)
    for i in range(8):
        omega = np.column_stack([columns["omega1"][i], columns["omega2"][i], np.zeros(times.size)])
        gamma = np.column_stack([columns[f"g{k}"][i] for k in (1, 2, 3)])
        place = np.column_stack([places[f"m{name}"][i] for name in "xyz"])
        # γ points down.
        assert place[:, 2] == approx(-gamma @ r, abs=1e-3)
        moving = CubicSpline(sign * times, place, axis=0).derivative()(sign * times) * sign
        turning = np.cross(place, moving) @ [0.0, 0.0, -1.0]
        inner = slice(3, -3)
        assert np.linalg.norm(moving, axis=1)[inner] == approx(
            np.linalg.norm(np.cross(omega, r), axis=1)[inner], abs=0.02
        )
        expected = np.sum(omega * gamma, axis=1) - (omega @ r) * (gamma @ r)
        assert turning[inner] == approx(expected[inner], abs=0.02)
    # They start evenly around the vertical.
    around = np.unwrap([np.arctan2(-places["my"][i, 0], places["mx"][i, 0]) for i in range(8)])
    assert np.abs(np.diff(around)) == approx(np.pi / 4, abs=1e-6)


def test_a_table_has_a_row_for_each_bead_at_the_time_of_the_link():
    data = picture_data("scene=suslov-hess&swarm=8&t=2.0", "omega")
    _, part = swarm_of("suslov-hess", swarm="8")
    found = columns_of(data).layer("swarm")
    assert [*found["body"]] == [1, 2, 3, 4, 5, 6, 7, 8]
    sample = int(np.argmin(np.abs(part.motions.times / data.state.body.frequency_unit - 2.0)))
    unit = data.state.body.frequency_unit
    assert found["t"] == approx(part.motions.times[sample] / unit)
    assert found["omega1"] == approx(unit * part.motions.states[:, sample, 0], abs=1e-3)
