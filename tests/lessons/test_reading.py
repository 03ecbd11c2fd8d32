"""Parsing of lessons, and the messages for mistakes."""

import base64
import json
import re

import pytest

from hess_explorer.lessons import package_lessons, suggestions
from hess_explorer.lessons.checks import problems_in
from hess_explorer.lessons.images import MAX_ALL, MAX_ONE, Images
from hess_explorer.lessons.lesson import Animation, HiddenLayer, LessonError
from hess_explorer.lessons.markdown import BadFormula, to_html
from hess_explorer.lessons.reading import MAX_BYTES, MAX_STEPS, examine, read, read_file
from hess_explorer.page.lesson_description import describe_lesson
from support.board import SCENES
from support.view import View

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
    assert (first.title, first.text, first.enlarged_picture) == ("Across the line", "Text with $a<b$.", "circle")
    assert (first.question, first.answer) == ("Why?", "Because.")
    assert first.animation == Animation("h", 0.2, 1.5, 8.0)
    assert first.state.values == SCENES["suslov-hess"].defaults() | {"h": 0.2, "f": 0.5}
    guess = first.prediction
    assert (guess.source, guess.columns, guess.kind) == ("circle-stable", ("phi", "theta"), "point")
    assert guess.outcome.values == SCENES["suslov-hess"].defaults() | {"h": 1.5, "f": 0.6}
    # The control of what is animated is beside the text; another step may name others.
    assert first.controls == ("h",)
    named = "controls: [f, accuracy, f]\npictures: [circle, body]\nhide: {picture: omega, layer: stable}"
    others = read(WHOLE.replace("look: circle", named), "mine")
    assert others.steps[0].controls == ("f", "accuracy")
    assert others.steps[0].pictures == ("circle", "body")
    assert others.steps[0].hidden_layer == HiddenLayer("omega", "data-stable")
    assert (second.controls, second.hidden_layer) == ((), None)
    # A step without a state is where the last one has come to.
    assert second.state == guess.outcome


# Faulty text → the line of the mistake, and part of its message.
MISTAKES = [
    ("title: Two cycles are born\n", "", 1, "no title"),
    ("minutes: 10", "minutes: 1e9", 3, "up to 600"),
    ("\n## ", "\n# ", 1, "there is no step"),
    ('state: "?scene=suslov-hess&h=0.2&f=0.5"\n', "", 9, "the first step needs a state"),
    ('"?scene=suslov-hess&h=0.2', '"?scene=nowhere&h=0.2', 9, "one of suslov-hess"),
    ("&h=0.2&f=0.5", "&h=1e9&f=0.5", 9, "h must lie between"),
    ("look: circle", "look: circel", 10, "look must be one of body, omega"),
    ("look: circle", "controls: h", 10, "a list of at most 6 names"),
    ("look: circle", "hide: {picture: bifurcation, layer: rotation}", 10, "layer of hide must be one of"),
    ("look: circle", "look: [circle", 11, "not YAML"),
    ("look: circle", "look: &a circle\nmore: *a", 9, "references"),
    (", seconds: 8", "", 11, "animate needs"),
    ("scene=suslov-hess&h=1.5&f=0.6", "scene=scattering&k=1", 12, "the same scene"),
    ("### Question", "### Quiz", 16, "Question and Answer"),
    ("$a<b$", "a\n$$\n\\omgea\n$$", 15, "\\omgea is not a known command"),
    ("It stays.", "It\nstays $5", 22, "a dollar sign has no counterpart"),
    ("It stays.", "It\n<b>stays</b>.", 22, "'<b>' is HTML"),
    ("It stays.", "[It](javascript:stays)", 21, "'javascript:stays' has an unknown target"),
    ("It stays.", "[It](circel/stable)", 21, "picture of 'circel/stable' must be one of omega, bifurcation, circle"),
    ("It stays.", "It\n[stays](circle/stabel)", 22, "layer of 'circle/stabel' must be one of"),
    ("It stays.", "It [stays](drag:circle)", 21, "a number to drag must be one of I22"),
    ("It stays.", "```step\nlook: omega\n```\n```step\n```", 24, "two fences named step"),
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
    refused("more than 256 kB", WHOLE.encode() + b" " * MAX_BYTES)
    refused(f"at most {MAX_STEPS}", (WHOLE + "\n## Again\nx\n" * MAX_STEPS).encode())
    with pytest.raises(LessonError, match="cannot be read"):
        read_file(tmp_path / "nothing.md")


def problems(text):
    return [one.message for one in problems_in(text, 1, Images(None), SCENES["suslov-hess"])]


def test_html_of_a_lesson_is_text_and_it_asks_no_other_host():
    text = 'Here <script>a()</script> [x](javascript:a()) ![y](https://there/y.png) <b onclick="a()">z</b> $a<b$'
    html = to_html(text)
    assert "<script" not in html
    assert "<img" not in html
    assert "<b " not in html
    assert 'href="javascript' not in html
    assert "<math" in html
    assert len(problems(text)) == 6
    # The library that sets formulas leaves what is in \\text as it is.
    for formula in (r"$\text{<script>a()</script>}$", r"$\text{<mtext href='javascript:a()'>x</mtext>}$"):
        with pytest.raises(BadFormula):
            to_html(formula)
        assert "cannot be set" in problems(formula)[0]


def test_what_can_be_shown_is_no_problem():
    text = r"""Costs \$5, $x$ and $$y$$, `$z[^1]`, *not* \[^1], [a](https://a.org/b?c=d) <https://a.org>,
and [$d$](omega/orbit) at [0.5](drag:h).

| $a$ | b |
|-----|---|
| 1   | [c](?scene=suslov-hess&h=1.5) |

    $ code <b>
"""
    assert problems(text) == []
    html = to_html(text)
    assert html.count("<td>") == 2
    assert '<a href="?scene=suslov-hess&amp;h=1.5">c</a>' in html
    assert '<a href="https://a.org" target="_blank" rel="noopener">' in html
    assert '<button class="names" value="omega/orbit"><span' in html
    assert '<button class="drag" value="h">0.5</button>.' in html
    # A displayed formula can stand in a line.
    assert ' and <span class="math"><math' in html and 'display="block"' in html


def test_the_mistakes_of_a_file_are_found_and_one_of_the_settings_of_each_step(tmp_path):
    path = tmp_path / "wrong.md"
    text = WHOLE.replace("minutes: 10", "minutes: soon").replace("$a<b$", "$\\frac$ <b>\n\n[x](y)")
    text = text.replace("It stays.", "```step\nlook: circel\nglance: x\n```")
    more = """## Third
```step
state: "?scene=scattering&k=1&k=2&l=1&I22=soon"
```
## Fourth
```step
state: "?scene=suslov-hess&h=0.2&f=5"
```
"""
    path.write_text(text + more, encoding="utf-8")
    assert sorted(one.line for one in examine(path)[1]) == [3, 14, 14, 16, 25, 29, 31]


# The first bytes of a file, by its type.
IMAGES = {"png": b"\x89PNG\r\n\x1a\n", "jpeg": b"\xff\xd8\xff\xe0", "webp": b"RIFF\0\0\0\0WEBP"}


def with_image(folder, markdown):
    path = folder / "lesson.md"
    path.write_text(WHOLE.replace("It stays.", markdown), encoding="utf-8")
    return path


@pytest.mark.parametrize("kind", IMAGES)
def test_an_image_beside_the_lesson_is_part_of_it_whatever_its_name(tmp_path, kind):
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub/a wheel.bin").write_bytes(IMAGES[kind])
    lesson = read_file(with_image(tmp_path, 'A ![A "wheel" <b>](<sub/a wheel.bin>) rolls.'))
    [html] = [step["text"] for step in json.loads(describe_lesson(lesson))["steps"] if step["title"] == "Next"]
    found = re.fullmatch(r'<p>A <img src="data:image/(\w+);base64,([^"]+)" alt="(.*)"> rolls.</p>\n', html)
    assert found[1] == kind
    assert base64.b64decode(found[2]) == IMAGES[kind]
    assert found[3] == "A &quot;wheel&quot; &lt;b&gt;"


def test_other_images_are_refused_with_their_reason(tmp_path):
    folder = tmp_path / "lessons"
    folder.mkdir()
    (tmp_path / "outside.png").write_bytes(IMAGES["png"])
    (folder / "link.png").symlink_to(tmp_path / "outside.png")
    (folder / "large.png").write_bytes(IMAGES["png"] + bytes(MAX_ONE))
    (folder / "drawing.png").write_text('<?xml version="1.0"?><svg xmlns="http://www.w3.org/2000/svg"/>')
    (folder / "text.png").write_text("png")
    (folder / "good.png").write_bytes(IMAGES["png"] + bytes(MAX_ONE - 100))
    for target, why in {
        "link.png": "outside the folder",
        "%2e%2e/outside.png": "outside the folder",
        "/etc/hostname": "a file beside the lesson",
        "https://there/y.png": "a file beside the lesson",
        "large.png": "more than 300 kB",
        "drawing.png": "is an SVG: png, jpeg and webp are allowed",
        "text.png": "in an unknown format: png",
        "none.png": "no such file",
    }.items():
        with pytest.raises(LessonError, match=f"line 21: .*({why})"):
            read_file(with_image(folder, f"![A wheel]({target})"))
    with pytest.raises(LessonError, match="has no alternative text"):
        read_file(with_image(folder, "![](good.png)"))
    # The same image counts again, because the page gets it again.
    most = MAX_ALL // MAX_ONE
    assert read_file(with_image(folder, "![A wheel](good.png) " * most)).images
    with pytest.raises(LessonError, match="at most 2 MB"):
        read_file(with_image(folder, "![A wheel](good.png) " * (most + 1)))
    with pytest.raises(LessonError, match="images are not allowed"):
        read(WHOLE.replace("It stays.", "![A wheel](good.png)"), "mine")


LESSONS = {lesson.name: lesson for lesson in (*package_lessons().values(), *suggestions().values())}
LINKED = [(lesson, step) for lesson in LESSONS.values() for step in lesson.steps]


@pytest.mark.parametrize(("lesson", "step"), LINKED, ids=[f"{one.name}: {step.title}" for one, step in LINKED])
def test_every_step_is_admitted_unchanged_and_drawn(lesson, step):
    for place in (step.state, *([step.prediction.outcome] if step.prediction else [])):
        scene = SCENES[place.scene]
        assert scene.admit(place.values) == (place.values, [])
    seen = {step.enlarged_picture} if step.enlarged_picture else set(scene.open_pictures)
    seen |= {step.prediction.picture} if step.prediction else set()
    state = scene.compute(place.values, seen, is_preview=False)
    for view in scene.views:
        if view.name in seen:
            assert view.full_caption(state).title
    if step.prediction:
        # There is something to reveal, once all is computed.
        few = {"steps": 20.0} if "steps" in place.values else {}
        drawn = View(scene, {**place.values, **few}, seen={step.prediction.picture}).data[step.prediction.source]
        assert all(len(drawn[column]) for column in step.prediction.columns)
    if step.animation and step.animation.name != "time":
        for value in (step.animation.start, step.animation.end):
            ends = {**step.state.values, step.animation.name: value}
            assert scene.admit(ends) == (ends, [])
