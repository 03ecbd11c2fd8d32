"""Parsing of lessons, and the messages for mistakes."""

from __future__ import annotations

import pytest

from hess_explorer.lessons import shipped, tries
from hess_explorer.lessons.lesson import Animation, HiddenLayer, LessonError
from hess_explorer.lessons.markdown import to_html
from hess_explorer.lessons.reading import MAX_BYTES, MAX_STEPS, read, read_file, without_tries
from support.board import SCENES

WHOLE = """---
title: Two cycles are born
minutes: 10
---
Words before the first step are for its author.

## Across the line
```step
state: "?scene=suslov-hess&h=0.2&f=0.5"
look: circle
animate: {name: h, from: 0.2, to: 1.5, seconds: 8}
predict: {picture: circle, layer: stable, then: "http://there/?v=1&scene=suslov-hess&h=1.5&f=0.6&t=3&theme=dark"}
```
Text with $a<b$.

### Question
Why?
### Answer
Because.
## Next
It stays.
"""


def test_a_lesson_is_read_as_it_is_written():
    lesson = read(WHOLE, "mine")
    first, second = lesson.steps
    assert (lesson.name, lesson.title, lesson.minutes) == ("mine", "Two cycles are born", 10.0)
    assert (first.title, first.text, first.look) == ("Across the line", "Text with $a<b$.", "circle")
    assert (first.question, first.answer) == ("Why?", "Because.")
    assert first.animation == Animation("h", 0.2, 1.5, 8.0)
    assert first.at.values == SCENES["suslov-hess"].defaults() | {"h": 0.2, "f": 0.5}
    guess = first.prediction
    assert (guess.source, guess.columns, guess.what) == ("circle-stable", ("phi", "theta"), "point")
    assert guess.then.values == SCENES["suslov-hess"].defaults() | {"h": 1.5, "f": 0.6}
    # The control of what is animated is beside the text; another step may name others.
    assert first.controls == ("h",)
    named = "controls: [f, accuracy, f]\nhide: {picture: omega, layer: stable}"
    others = read(WHOLE.replace("look: circle", named), "mine")
    assert others.steps[0].controls == ("f", "accuracy")
    assert others.steps[0].hide == HiddenLayer("omega", "stable", "data-stable")
    assert (second.controls, second.hide) == ((), None)
    # A step without a state is where the last one has come to.
    assert second.at == guess.then


# Faulty text → the line of the mistake, and part of its message.
MISTAKES = [
    ("title: Two cycles are born\n", "", 1, "no title"),
    ("minutes: 10", "minutes: soon", 1, "like minutes: 20"),
    ("minutes: 10", "minutes: 1e9", 1, "up to 600"),
    ("minutes: 10", "author: me", 2, "allowed are title, minutes"),
    ("---\ntitle", "title", 1, "front matter"),
    ("\n## ", "\n# ", 1, "there is no step"),
    ('state: "?scene=suslov-hess&h=0.2&f=0.5"\n', "", 9, "the first step needs a state"),
    ('"?scene=suslov-hess&h=0.2', '"?scene=nowhere&h=0.2', 9, "one of suslov-hess"),
    ("&h=0.2&f=0.5", "&h=1e9&f=0.5", 9, "h must lie between"),
    ("&h=0.2&f=0.5", "&g=0.2", 9, "'g', which the scene suslov-hess does not"),
    ("&h=0.2&f=0.5", "&h=0.2" + "0" * 2000, 9, "longer than 2000"),
    ("look: circle", "look: circel", 9, "look is one of body, omega"),
    ("look: circle", "glance: circle", 9, "allowed are state, example, look, animate, controls, hide, predict"),
    ("look: circle", "controls: h", 9, "a list of at most 6 names"),
    ("look: circle", "controls: [h, nothing]", 9, "a name in controls is one of I22"),
    ("look: circle", "controls: [[h]]", 9, "a name in controls is one of"),
    ("look: circle", "controls: [h, f, I22, I23, b3, phi0, span]", 9, "at most 6"),
    ("look: circle", "hide: {picture: sphere, layer: stable}", 9, "picture of hide is one of omega, bifurcation"),
    ("look: circle", "hide: {picture: [circle], layer: stable}", 9, "picture of hide"),
    ("look: circle", "hide: {picture: bifurcation, layer: rotation}", 9, "layer of hide is one of"),
    ("look: circle", "example: U", 9, "Two limit cycles, No cycle"),
    ("look: circle", "example: S", 9, "just one of the examples"),
    ("look: circle", "look: [circle", 11, "not YAML"),
    ("look: circle", "look: &a circle\nmore: *a", 9, "references"),
    ("name: h,", "name: k,", 9, "name of animate is one of time, I22"),
    ("to: 1.5", "to: 1e9", 9, "numbers from"),
    ("to: 1.5", "to: .nan", 9, "numbers from"),
    ("seconds: 8", "seconds: 0", 9, "up to 600"),
    (", seconds: 8", "", 9, "animate needs"),
    ("{picture: circle", "{picture: sphere", 9, "picture of predict is one of omega, bifurcation, circle"),
    ("layer: stable", "layer: truth", 9, "layer of predict is one of diagonal"),
    ("scene=suslov-hess&h=1.5&f=0.6", "scene=scattering&k=1", 9, "the same scene"),
    ("### Question", "### Quiz", 16, "Question and Answer"),
    ("### Answer\n", "", 16, "a question needs an answer"),
    ("## Next", "##", 20, "no title"),
    ("$a<b$", "$\\frac$", 14, "cannot be set"),
    ("It stays.", "```step\nlook: omega\n```\n```step\n```", 24, "second fence"),
]


@pytest.mark.parametrize(("written", "instead", "line", "said"), MISTAKES, ids=[one[3] for one in MISTAKES])
def test_a_mistake_is_told_with_its_line_and_what_is_allowed(tmp_path, written, instead, line, said):
    assert written in WHOLE
    path = tmp_path / "wrong.md"
    path.write_text(WHOLE.replace(written, instead), encoding="utf-8")
    with pytest.raises(LessonError) as caught:
        read_file(path)
    assert str(caught.value).startswith(f"wrong.md, line {line}: ")
    assert said in str(caught.value)


def test_a_file_that_is_no_lesson_is_told_of(tmp_path):
    def refused(said, content):
        path = tmp_path / "wrong.md"
        path.write_bytes(content)
        with pytest.raises(LessonError, match=said):
            read_file(path)

    refused("UTF-8", WHOLE.encode("utf-16"))
    refused("front matter", b"")
    refused("more than 256 kB", WHOLE.encode() + b" " * MAX_BYTES)
    refused(f"at most {MAX_STEPS}", (WHOLE + "\n## Again\nx\n" * MAX_STEPS).encode())
    with pytest.raises(LessonError, match="cannot be read"):
        read_file(tmp_path / "nothing.md")


def test_html_of_a_lesson_is_text_and_it_asks_no_other_host():
    html = to_html('<script>a()</script> [x](javascript:a()) ![y](https://there/y.png) <b onclick="a()">z</b> $a<b$')
    assert "<script" not in html
    assert "<img" not in html
    assert "<b " not in html
    assert 'href="javascript' not in html
    assert "<math" in html
    # The library that sets formulas leaves what is in \\text as it is.
    for formula in (
        r"\text{<img src=x onerror=a()>}",
        r"\text{<script>a()</script>}",
        r"\text{</math><b>x</b>}",
        r"\text{<mtext href='javascript:a()'>x</mtext>}",
    ):
        with pytest.raises(LessonError, match="cannot be set"):
            to_html(f"${formula}$")


LESSONS = {lesson.name: lesson for lesson in (*shipped().values(), *tries().values())}
LINKED = [(lesson, step) for lesson in LESSONS.values() for step in lesson.steps]


@pytest.mark.parametrize(("lesson", "step"), LINKED, ids=[f"{one.name}: {step.title}" for one, step in LINKED])
def test_every_step_is_admitted_unchanged_and_drawn(lesson, step):
    for place in (step.at, *([step.prediction.then] if step.prediction else [])):
        scene = SCENES[place.scene]
        assert scene.admit(place.values) == (place.values, [])
    seen = {step.look} if step.look else set(scene.open_pictures)
    seen |= {step.prediction.picture} if step.prediction else set()
    state = scene.compute(place.values, seen, dragging=False)
    for view in scene.views:
        if view.name in seen:
            assert view.said(state).title
    if step.prediction:
        # There is something to reveal.
        plot = next(view for view in scene.views if view.name == step.prediction.picture)
        drawn = state.drawn[step.prediction.source] | plot.framed(state, plot.ranges(state) or plot.first_axes).get(
            step.prediction.source, {}
        )
        assert all(len(drawn[column]) for column in step.prediction.columns)
    if step.animation and step.animation.name != "time":
        for value in (step.animation.start, step.animation.end):
            ends = {**step.at.values, step.animation.name: value}
            assert scene.admit(ends) == (ends, [])


def test_words_of_a_scene_are_whole_without_what_can_be_tried():
    words = "### What you see\na\n\n### Try this\n#### One\nb\n### The equations\nc"
    assert without_tries(words) == "### What you see\na\n\n### The equations\nc"
    assert without_tries("### What you see\na") == "### What you see\na"


def test_the_longest_lesson_comes_first():
    assert [lesson.minutes for lesson in shipped().values()] == [45.0, 20.0, 20.0, 20.0]


def test_a_displayed_formula_can_stand_in_a_line():
    html = to_html("There $$x^2$$ is.")
    assert html.startswith('<p>There <span class="math"><math') and html.endswith("</span> is.</p>\n")
    assert 'display="block"' in html
    assert "$" not in html
