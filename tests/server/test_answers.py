"""Responses of a session, without a server: descriptions, links, changes of scene."""

import pytest

from hess_explorer.page.session import Session
from hess_explorer.protocol.messages import parse
from hess_explorer.scenes import scenes


@pytest.fixture
def session():
    scene = scenes()["suslov-hess"]
    return Session(scene, scene.defaults(), [], {}, pictures=())


def ask(session, **request):
    """The answer to a request for a state, in which no picture is in sight."""
    return session.answer(parse({"requested": 1, "hidden": list(session.scene.pictures), **request}))


def test_a_scene_is_described_once(session):
    assert [bool(ask(session, values={"h": h}).scene) for h in (1.0, 1.1, 1.2)] == [True, False, False]
    ask(session, scene="suslov-hess-accuracy")
    assert not ask(session, scene="suslov-hess").scene


def test_speed_and_accuracy_of_a_scene_is_of_its_very_state(session):
    """Also where the scene has gone back to a default since the other was left."""
    ask(session, values={"h": 1.3})
    ask(session, scene="suslov-hess-accuracy")
    ask(session, scene="suslov-hess")
    first = scenes()["suslov-hess"].defaults()["h"]
    ask(session, values={"h": first})
    ask(session, scene="suslov-hess-accuracy")
    assert (session.scene.name, session.requested.values["h"]) == ("suslov-hess-accuracy", first)


def test_a_scene_is_found_as_it_was_left(session):
    ask(session, scene="suslov-hess")
    ask(session, values={"f": 0.25, "phi0": 2.0})
    ask(session, scene="scattering")
    ask(session, scene="suslov-hess")
    assert (session.values["f"], session.values["phi0"]) == (0.25, 2.0)


def test_mistakes_of_a_link_that_is_restored_are_told(session):
    answer = ask(session, restore="scene=suslov-hess&h=banana&f=0.25")
    assert session.values["f"] == 0.25
    (note,) = session.requested.notes
    assert note.startswith("h must be a finite number") and note in answer.state.tree["texts"]["notes"]


def test_a_state_that_is_impossible_in_the_next_scene_is_its_first_one_there(session):
    """No ξ without I₁₃ and I₂₃, which the Suslov problem with gravity can do without."""
    ask(session, scene="suslov")
    ask(session, values={"I13": 0.0, "I23": 0.0, "b1": 0.4})
    answer = ask(session, scene="scattering")
    assert dict(session.values) == scenes()["scattering"].defaults()
    assert "not possible here" in answer.state.tree["texts"]["notes"]
    # Whoever chooses it there reads why it is refused.
    refused = ask(session, values={"I23": 0.0}, hidden=[])
    assert "there is no ξ" in refused.state.tree["texts"]["status"]
