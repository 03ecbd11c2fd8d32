"""Every number in a lesson, and in the text of a scene, is computed: one that has no row fails."""

import math

import numpy as np
import pytest

from hess_explorer.lessons import package_lessons, tries
from hess_explorer.lessons.lesson import LessonStep, StateLink
from hess_explorer.lessons.reading import without_tries
from hess_explorer.scenes import scenes
from hess_mechanics import circle_map, level
from hess_mechanics.chaplygin_ball.ball_scattering import ball_scattering
from hess_mechanics.chaplygin_ball.equations import BallBody
from support import lesson_on_constraints, lesson_on_doubling, lesson_on_evidence, lessons_on_tori, scene_texts
from support.numbers import mistakes, places

PRECISE = level("precise")
OF_LESSONS = lessons_on_tori.ROWS | {
    one.NAME: one.ROWS for one in (lesson_on_constraints, lesson_on_doubling, lesson_on_evidence)
}
# Of the scenes that measure another one there are two texts.
SCENES = {scene.words: scene for scene in reversed(scenes().values())}.values()


def steps_of(scene):
    """Return the text of a scene as a step with its first state, and what can be tried."""
    lesson = tries().get(scene.name)
    words = without_tries(scene.words) if lesson else scene.words
    return LessonStep("", words, StateLink(scene.name, scene.defaults())), *(lesson.steps if lesson else ())


STEPS = {name: lesson.steps for name, lesson in package_lessons().items()} | {one.name: steps_of(one) for one in SCENES}
ROWS = OF_LESSONS | {one.name: scene_texts.SHARED | scene_texts.ROWS.get(one.name, {}) for one in SCENES}


def texts(step):
    return step.text, step.question, step.answer


@pytest.mark.chaotic
@pytest.mark.parametrize("name", STEPS)
def test_every_number_of_a_text_is_what_it_is_computed_to_be(name):
    wrong = [one for step in STEPS[name] for one in mistakes(texts(step), step, ROWS[name])]
    assert not wrong, "\n".join(wrong)


def test_every_row_is_about_a_text():
    whole = {name: "\n".join(text for step in steps for text in texts(step)) for name, steps in STEPS.items()}
    for name, rows in ROWS.items():
        assert not [one for one in rows.keys() - scene_texts.SHARED.keys() if not places(one, whole[name])]
    assert not [one for one in scene_texts.SHARED if not any(places(one, text) for text in whole.values())]


# Statements of the lessons in words.


def test_for_f_0_the_map_is_the_same_at_every_energy_over_the_separatrix():
    phases = np.linspace(-3.0, 3.0, 41)
    first, *others = (circle_map(0.3, h, 0.0, PRECISE).theta(phases) for h in (1.2, 1.5, 3.0, 20.0))
    for other in others:
        np.testing.assert_allclose(np.exp(1j * other), np.exp(1j * first), atol=1e-10)


def test_the_ball_of_the_scattering_lesson_gives_no_single_cosine():
    values = package_lessons()["scattering-by-a-nonholonomic-top"].steps[-1].at.values
    assert values["D"] == 2.0
    phases = np.linspace(-math.pi, math.pi, 16, endpoint=False)

    def beside_a_cosine(D):
        body = BallBody(values["I11"], values["I22"], values["I13"], values["I23"], D)
        found = ball_scattering(body, values["theta"], phases, values["h"], 1e-4, level("draft"))
        return np.abs(np.fft.rfft(np.cos(found.theta_plus)))[2:].max() / phases.size

    assert beside_a_cosine(2.0) > 1e-3
    assert beside_a_cosine(0.0) < 1e-5
