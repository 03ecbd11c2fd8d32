"""The scene of orbit diagrams: attractors and repellers, the density, clicks, the way back."""

from dataclasses import dataclass, replace
from math import log
from types import SimpleNamespace

import numpy as np
import pytest
from pytest import approx

from hess_explorer.scenes import scenes
from hess_explorer.scenes.parts.diagrams.ramps import visible_range
from hess_explorer.views.text import digits
from hess_mechanics import check_body, lyapunov_spectrum
from hess_mechanics.dynamics.point_sets import set_distance
from hess_mechanics.suslov.suslov_section import SuslovSection
from support.deviations import deviations
from support.diagrams import crossings, settled
from support.suslov import field
from support.thorough import sample
from support.view import View, values_of

SCENE = scenes()["orbit-diagram"]


def image(body, E, place, count=1):
    """Return the next points (count, 2) of the return map by SciPy."""
    section = SuslovSection(body, E, 3)
    return section.points_of(crossings(lambda _, y: field(body, y), section.state_at(*place), count))


def test_all_examples_are_rigid_bodies_from_one_edge_of_their_diagram_to_the_other():
    for scene in (SCENE, scenes()["ball-diagram"]):
        for state in (scene.of({**scene.defaults(), **preset.values}, (), True) for preset in scene.presets):
            for value in (state.first, state.diagram.value, state.last):
                b = replace(state, **{state.diagram.name: value})
                assert check_body(b.I11, b.I22, b.I13, b.I23).I33 is not None, (b, value)


@dataclass(frozen=True)
class TwoSets:
    """Instead of a ramp: an attractor from 0 to 1, and a repeller as large at some distance."""

    distance: float
    backward: bool = False
    values: tuple = ()
    point: tuple = ()

    def diagram(self, *_):
        return SimpleNamespace(points=[np.array([[0.0], [1.0]]) + self.backward * self.distance])


@pytest.mark.parametrize("distance, highest", [(1.0, 2.0), (5.0, 1.0)])
def test_a_repeller_is_in_sight_only_near_the_attractor(distance, highest):
    # A twentieth of the values need not be in sight.
    assert visible_range(TwoSets(distance), 0, (-10.0, 10.0)) == approx((-0.2, highest + 0.2), abs=0.06)


@pytest.mark.chaotic
@pytest.mark.parametrize(
    "name, verdict",
    sample([("Touching", "mixed"), ("Apart: a strange", "dissipative"), ("A chaotic sea", "mixed")], 1),
)
def test_attractors_and_repellers_are_what_their_examples_say(name, verdict):
    view = View(SCENE, values_of(SCENE, name), seen=("section",))
    state = view.result
    assert f"Chaotic. Looks {verdict}." in view.text["section"]
    known = state.regime.kind
    div, error = known.motion.divergence, known.motion.divergence_error
    assert f"div = {digits(div, 2)} ± " in view.text["section"]
    assert div + 3.0 * error < 0.0
    # One trajectory proves nothing.
    both = [settled(state.poincare, 32, 1500, 500, forward) for forward in (True, False)]
    starts = state.poincare.states_at(*both[0][:16, 0].T)[0]
    assert abs(deviations([lyapunov_spectrum(state.body, y, 8000.0).divergence for y in starts], div, error)) < 5.0
    shared = np.array([set_distance(state.poincare.turns, *pair).overlap for pair in zip(*both, strict=True)])
    if name == "Touching":
        assert deviations(np.log(shared), log(0.005)) > 5.0
    elif verdict == "dissipative":
        assert not shared.any()
    else:
        assert deviations(shared, 0.8) > 5.0


LIGHT = {
    "steps": 30.0,
    "ways": "there and back",
    "transient": 50.0,
    "count": 10.0,
    "along": "I₂₂",
    "first": 2.1,
    "last": 2.4,
    "chosen": "0.8,1.9",
    "I11": 1.0,
    "I22": 2.25,
    "I13": 0.6,
    "I23": 0.6,
    "b1": -1.0,
    "b2": -0.5,
    "b3": 0.7,
    "h": 2.0,
}
"""Few points, of a body whose doublings along I22 are wide apart."""


def test_the_density_counts_all_points_and_a_window_counts_them_in_its_own_pixels():
    view = View(SCENE, LIGHT, seen=["diagram"])
    state, found = view.result, view.result.density
    (x0, y0), (x1, y1) = state.diagram.frame
    assert f"{found.points:,} points. " in view.text["diagram"]
    # As many as allowed, in 120 columns forward and back; nearly all lie in the picture.
    asked = 2 * 120 * (20_000 // (2 * 120))
    assert 0.97 * asked < found.points == sum(found.counts(way).sum() for way in found.forward) <= asked
    assert len(view.data["diagram-rising"]["x"]) == 0
    shaded = [np.asarray(view.data[f"diagram-density-{i}"]["image"][0]) for i in range(3)]
    assert np.array_equal(
        np.max(shaded, axis=0).ravel() > 0.0, sum(map(found.counts, state.density.forward)).ravel() > 0
    )
    half = View(SCENE, {**LIGHT, "window": f"{x0},{0.5 * (y0 + y1)};{x1},{y1}"}, seen=["diagram"]).result.density
    assert half.points == sum(found.counts(way)[256:].sum() for way in ("rising", "falling"))
    assert half.counts("rising").sum() > 0
    # The branch of the orbit that doubles goes through the picture, though none is chosen.
    (flip,) = (one for part in state.continuation.branches for one in part.bifurcations)
    assert (flip.value, state.closed_orbit) == (approx(state.diagram.flips[0], abs=1e-8), None)
    # A held slider shows the points themselves.
    held = View(SCENE, LIGHT, True, ["diagram"])
    assert held.result.density.tones == ()
    assert len(held.data["diagram-rising"]["x"]) > 0


def test_a_click_chooses_a_state_that_is_there_and_a_box_looks_closer():
    state = View(SCENE, {**values_of(SCENE, "Period doubling"), "steps": 60.0}, seen=("diagram",)).result
    # The branch of the orbit that doubles is near too, and would be chosen first.
    chosen = state.diagram.choose(0.0501, 0.9)
    assert chosen["I23"] == approx(0.0501, abs=0.005)
    there = SCENE.compute({**SCENE.defaults(), **chosen}, ("section",), True)
    # The motion there is on its attractor from the beginning, at the upper of its two points; of a drag, to 1e-3.
    orbit = there.regime.sets[0]
    assert np.abs(orbit - there.diagram.point).max(axis=1).min() < 1e-4
    assert len(np.unique(np.round(orbit[-20:, 0], 3))) == 2
    assert there.diagram.point[0] == approx(orbit[-20:, 0].max(), abs=1e-3)
    view = next(one for one in SCENE.views if one.name == "diagram")
    box = view.on_box(state, (0.05, 0.6, 0.15, 1.1))
    assert box == {"window": "0.05,0.6;0.15,1.1"}
    closer = SCENE.compute({**SCENE.defaults(), **box}, ("diagram",), True)
    assert (closer.diagram.parameter_values[0], closer.diagram.parameter_values[-1]) == (0.05, 0.15)
    # Edges beyond the bounds are one value there.
    beyond, _ = SCENE.admit({**SCENE.defaults(), "first": 1000.0, "last": 1422.5})
    assert (beyond["first"], beyond["last"]) == (999.0, 1000.0)
    # A window that lies outside the diagram is none.
    assert SCENE.admit({**SCENE.defaults(), "window": "5,0;6,1"})[0]["window"] == ""


def test_the_way_back_begins_where_the_way_there_ended():
    """The orbits keep all points: the first point of the way back is next to the last one of the way there."""
    state = View(SCENE, {**LIGHT, "transient": 0.0}, seen=("diagram",)).result
    there, back = (state.diagram.pieces[way] for way in ("rising", "falling"))
    assert (there[-1].values[-1], back[0].values[0]) == (2.4, 2.4)
    body, E = replace(state, I22=2.4).body, state.poincare.E
    last, first = there[-1].points[-1][-1], back[0].points[0][0]
    assert image(body, E, last)[0] == approx(first, abs=1e-4)
