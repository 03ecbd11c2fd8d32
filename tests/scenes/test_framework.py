"""Parts of a scene: shared parameters, a scene that studies another one."""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import pytest

from hess_explorer.protocol.specs import ControlSpec
from hess_explorer.scenes.framework.scene import Motion, Scene, State
from hess_explorer.scenes.framework.sliders import accuracy_level, number, redeclare, specs_of
from hess_explorer.scenes.speed_accuracy import speed_and_accuracy
from hess_mechanics import systems
from hess_mechanics.euler_poisson.equations import HeavyBody
from hess_mechanics.suslov_hess.torus import annulus
from support.board import SCENES


@dataclass(frozen=True)
class Base(State):
    """Two parameters to mix in."""

    first: float = number("x", 1.0, (0.0, 2.0), 0.1, bounds=(0.0, 10.0), label="First", doc="The first.")
    second: float = number("y", 2.0, (0.0, 3.0), 0.1, bounds=(0.0, 10.0), label="Second", doc="The second.")


@dataclass(frozen=True)
class Mixed(Base):
    """Another default and another doc."""

    third: float = number("z", 3.0, (0.0, 4.0), 0.1, bounds=(0.0, 10.0), label="Third", doc="The third.")
    second: float = redeclare(Base, "second", 2.5, doc="Another.")
    accuracy: str = accuracy_level()


def test_own_parameters_come_first_and_one_that_is_declared_again_keeps_its_place_and_what_is_not_changed():
    third, accuracy, first, second = specs_of(Mixed)
    assert (first.name, second.name, third.name, accuracy.name) == ("first", "second", "third", "accuracy")
    assert (second.symbol, second.default, second.softbounds, second.label, second.doc) == (
        "y",
        2.5,
        (0.0, 3.0),
        "Second",
        "Another.",
    )
    assert Mixed().second == 2.5
    assert Base().second == specs_of(Base)[1].default == 2.0


@dataclass(frozen=True)
class Shown(Mixed):
    """A state with names that those who look into it use too."""

    @cached_property
    def chosen(self) -> str:
        """Override the member."""
        return "mine"

    def quantities(self) -> list[str]:
        """Override the member."""
        return ["mine"]

    def motion(self) -> Motion:
        """Some motion."""
        return Motion(
            systems()["suslov"], (1.0, 0.0, 0.0, 0.0, 1.0), (1.0, 2.0, 0.0, 0.1, 0.0, 0.0, 0.0), self.first, (1.0,) * 5
        )


def test_no_name_of_a_scene_hides_one_of_the_scene_that_looks_into_it():
    shown = Scene(Shown, "/shown.py", "", "", (), ())
    looking = speed_and_accuracy(shown)
    assert (looking.name, looking.origin, looking.specs) == ("shown-accuracy", "shown", shown.specs)
    assert shown.has_motion
    assert not looking.has_motion
    values = {**looking.defaults(), "first": 1.5, "accuracy": "precise"}
    state = looking.of(values, visible=["a"], is_preview=True)
    assert [*state.status()] == ["precise chosen"]
    assert state.precision.motion.duration == 1.5
    assert (state.base.chosen, state.base.quantities()) == ("mine", ["mine"])
    assert state.work is state.base.work
    assert (state.is_preview, state.visible) == (True, frozenset({"a"}))
    assert looking.admit({**values, "first": 20.0}) == shown.admit({**values, "first": 20.0})


@pytest.mark.parametrize("name", ["loxodrome", "hess-leak", "bridge", "euler-poisson"])
def test_no_slider_of_a_moment_leads_to_a_refusal(name):
    scene = SCENES[name]
    random = np.random.default_rng(3)
    values = {**scene.defaults(), **({"given": "Euler–Poisson"} if name == "bridge" else {})}
    for _ in range(40):
        moment = str(random.choice(["I1", "I2", "I3"]))
        low, high, step = scene.limits(values)[moment]
        values[moment] = float(np.clip(low + step * random.integers(0, 1 + int((high - low) / step)), low, high))
        body = HeavyBody.hess((values["I1"], values["I2"], values["I3"]), 1.0)
        assert sorted((values["I1"], values["I3"]))[0] <= values["I2"] <= sorted((values["I1"], values["I3"]))[1]
        assert math.isfinite(body.hess_a)


@pytest.mark.parametrize("I22", [0.2, 0.96, 3.0])
@pytest.mark.parametrize("I23", [0.28, 2.0])
@pytest.mark.parametrize("h", [-0.99, -0.5, 0.5, 1.5, 3.9, 40.0])
def test_the_ring_of_the_suslov_hess_case_fills_its_frame(I22, I23, h):
    scene = SCENES["suslov-hess"]
    state = scene.of(scene.admit({**scene.defaults(), "I22": I22, "I23": I23, "h": h, "f": 0.1})[0])
    # |w| = √2(h + n3), n3 < 1, and ω2 = w2 √(1 + a²); to a tenth below the least frame, and less than half beyond.
    assert 0.15 < np.max(np.abs(annulus(state.body, state.h, state.turning_points)[1])) / state.half_width <= 1.0


@pytest.mark.parametrize("name", SCENES)
def test_a_cockpit_has_few_controls_outside_computation(name):
    """The choices of a chart show only with the chart."""
    scene = SCENES[name]
    groups = [spec.group for spec in scene.specs if isinstance(spec, ControlSpec)]
    assert sum(group in ("Body", "State") for group in groups) <= 12
    assert {*groups} <= {"Body", "State", "Computation", "Swarm", "Chart"}
