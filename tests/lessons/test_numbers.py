"""Every number in a lesson, and in the text of a scene, is computed: one that has no row fails."""

import math

import numpy as np
import pytest

from hess_explorer.lessons import shipped, tries
from hess_explorer.lessons.lesson import LessonStep, StateLink
from hess_explorer.lessons.reading import without_tries
from hess_explorer.scenes import scenes
from hess_mechanics.chaplygin_ball.ball_scattering import ball_scattering
from hess_mechanics.chaplygin_ball.equations import BallBody
from support import lesson_on_constraints, lesson_on_doubling, lesson_on_evidence, lessons_on_tori, scene_texts
from support.numbers import mistakes, places

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


STEPS = {name: lesson.steps for name, lesson in shipped().items()} | {one.name: steps_of(one) for one in SCENES}
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


def test_the_ball_of_the_scattering_lesson_gives_no_single_cosine():
    values = shipped()["scattering-by-a-nonholonomic-top"].steps[-1].at.values
    body = BallBody(*(values[name] for name in ("I11", "I22", "I13", "I23", "D")))
    phases = np.linspace(-math.pi, math.pi, 16, endpoint=False)
    found = ball_scattering(body, values["theta"], phases, values["h"], 1e-4, "draft")
    assert np.abs(np.fft.rfft(np.cos(found.theta_plus)))[2:].max() > 1e-3 * phases.size
