"""The sentence above the pictures: it holds where it is shown, and is not shown where it does not hold."""

import numpy as np
import pytest

from hess_explorer.scenes import scenes
from oracle.closed_forms import cos_chi
from support.suslov_hess import exact_states
from support.view import values_of


def said(name, values):
    """The sentence on a state of a scene."""
    scene = scenes()[name]
    return scene.answer(scene.of(scene.admit({**scene.defaults(), **values})[0]))


def beginning_with(name, words):
    """The sentence on an example."""
    return said(name, values_of(scenes()[name], words))


SHOWN = {
    "suslov-hess": {
        "Two limit": "Two loops",
        "No cycle": "No loop",
        "Smaller a": "No loop",
        "On the boundary": "The two loops have just met",
        "Pendulum": "Two loops",
        "Oscillation": "No loop",
        "Separatrix": "On the separatrix",
        "On the bifurcation": "On this edge",
    },
    "free-suslov": {"γ₁(t)": "No friction", "Γ(t), k = 1:": "A complete reversal", "Γ(t), k = 1.5": "No friction"},
    "suslov": {"A chaotic": "Each dot", "Two attractors": "Each colour", "On a principal": "On a principal axis"},
    "kharlamova": {
        "Periodic": "Nearly every",
        "Fixed point": "A fixed point",
        "Asymptotic": "In this direction",
        "Near the asymptotic orbit": "Nearly every",
    },
    "rotation-number": {"One plateau": "Not locked", "Euler": "Locked"},
    "ball-section": {"Returning orbits": "A symmetry makes", "Mixed": "Each dot"},
    "euler-poisson": {"Two layers": "In the Hess case", "The barrier": "Each dot"},
    "loxodrome": {"High": "The body turns", "Low": "Gravity swings", "Separatrix": "The body climbs"},
}


@pytest.mark.parametrize("name", SHOWN)
def test_each_example_has_the_sentence_that_holds_there(name):
    found = {words: beginning_with(name, words) for words in SHOWN[name]}
    assert {words: sentence for words, sentence in found.items() if not sentence.startswith(SHOWN[name][words])} == {}


BESIDE = {
    "rotation-number": ({"h": 1.0, "f": 0.0}, {"a": 0.5, "h": 0.5, "f": 1.01563456028796105}),
}


@pytest.mark.parametrize("name", [name for name, scene in scenes().items() if scene.origin is None])
def test_each_sentence_of_a_scene_is_shown_in_an_example_or_beside_one(name):
    scene = scenes()[name]
    states = (*(one.values for one in scene.presets), *BESIDE.get(name, ()))
    assert {said(name, values) for values in states} == {one.sentence for one in scene.answers}


def test_every_scene_has_a_sentence_that_fits_on_a_line():
    for name, scene in scenes().items():
        sentences = [one.sentence for one in scene.answers]
        assert all(len(sentence) <= 96 for sentence in sentences), name
        assert scene.origin or sentences, name


def ends(h, f, I23):
    """ω at the times after many returns at which the slow start is on the section, for five starts: (5, n, 2)."""
    values = {"I22": 0.96, "I23": I23, "b3": -1.0, "h": h, "f": f}
    times = np.linspace(110.0, 120.0, 400)
    return np.array([exact_states({**values, "phi0": phi0}, times)[:, :2] for phi0 in (-2.5, -1.0, 0.3, 1.4, 2.6)])


@pytest.mark.parametrize(("h", "f"), [(1.5, 0.6), (2.0, 0.4), (0.2, 0.5), (0.6, 0.3)])
def test_from_all_starts_the_body_ends_on_one_loop_where_it_says_so_and_nowhere_else(h, f):
    """By the general system: with two loops the curves of five starts coincide; without, they stay apart."""
    curves = ends(h, f, 0.28)
    # The starts may follow the loop one after another: compare curves, not moments.
    apart = [max(np.linalg.norm(curve - point, axis=1).min() for point in curves[0]) for curve in curves[1:]]
    is_loop = said("suslov-hess", {"I22": 0.96, "I23": 0.28, "h": h, "f": f}).startswith("Two loops")
    assert is_loop == (max(apart) < 0.05)
    assert is_loop or max(apart) > 0.15


@pytest.mark.parametrize("k", [1.0, 1.5, 2.0, 3.0])
def test_reversal_is_complete_where_it_says_so_and_nowhere_else(k):
    scene = scenes()["scattering"]
    body = scene.of({**scene.defaults(), "k": k}).body
    is_complete = said("scattering", {"k": k}).startswith("A complete reversal")
    assert is_complete == (abs(cos_chi(body.I11, body.I22, body.I13, body.I23) + 1.0) < 1e-9)


def test_orbits_of_a_ball_close_by_symmetry_only_on_a_principal_axis():
    assert said("ball-section", {"b3": 0.0}).startswith("A symmetry makes")
    assert said("ball-section", {"b3": 0.0, "I13": 0.2}).startswith("Each dot")
