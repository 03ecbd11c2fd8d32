"""Numbers in lessons and in the texts of scenes that are results are computed again."""

import math

import numpy as np
import pytest

from hess_explorer.lessons import package_lessons, suggestions
from hess_explorer.lessons.lesson import LessonStep, StateLink
from hess_explorer.lessons.reading import without_suggestions
from hess_explorer.scenes import scenes
from hess_mechanics.chaplygin_ball.ball_scattering import ball_scattering
from hess_mechanics.chaplygin_ball.equations import BallBody
from support import lesson_on_constraints, lesson_on_doubling, lesson_on_evidence, lessons_on_tori, scene_texts
from support.numbers import mistakes

OF_LESSONS = lessons_on_tori.ROWS | {
    one.NAME: one.ROWS for one in (lesson_on_constraints, lesson_on_doubling, lesson_on_evidence)
}
# Of the scenes that measure another one there are two texts.
SCENES = {scene.words: scene for scene in reversed(scenes().values())}.values()


def steps_of(scene):
    """Return the text of a scene as a step with its first state, and what can be tried."""
    lesson = suggestions().get(scene.name)
    words = without_suggestions(scene.words) if lesson else scene.words
    return LessonStep("", words, StateLink(scene.name, scene.defaults())), *(lesson.steps if lesson else ())


STEPS = {name: lesson.steps for name, lesson in package_lessons().items()} | {one.name: steps_of(one) for one in SCENES}
ROWS = OF_LESSONS | scene_texts.ROWS


@pytest.mark.chaotic
@pytest.mark.parametrize(("name", "phrase"), [(name, phrase) for name, rows in ROWS.items() for phrase in rows])
def test_a_number_in_a_text_is_what_it_is_computed_to_be(name, phrase):
    steps = [(step, (step.text, step.question, step.answer)) for step in STEPS[name]]
    wrong, there = zip(*(mistakes(texts, step, phrase, ROWS[name][phrase]) for step, texts in steps), strict=True)
    assert any(there)
    assert not [one for some in wrong for one in some]


# Statements of the lessons in words.


def test_the_ball_of_the_scattering_lesson_gives_no_single_cosine():
    values = package_lessons()["scattering-by-a-nonholonomic-top"].steps[-1].state.values
    body = BallBody(*(values[name] for name in ("I11", "I22", "I13", "I23", "D")))
    phases = np.linspace(-math.pi, math.pi, 16, endpoint=False)
    found = ball_scattering(body, values["theta"], phases, values["h"], 1e-4, "draft")
    assert np.abs(np.fft.rfft(np.cos(found.theta_plus)))[2:].max() > 1e-3 * phases.size
